// SPDX-License-Identifier: Apache-2.0
// Rays against a hierarchy (hierarchy.h): what they meet first, or whether anything is in the way. Both sides of a
// triangle are met. Whoever includes this defines which points of triangles that have holes stop a ray:
//   bool stops_ray(uint mesh, uint triangle, vec2 uv)
//
// Precision. Corners are moved into the ray's frame, where each is the same two numbers for all triangles that share
// it; from there on the signs that say on which side of its edges a ray passes are exact or zero, and zero counts as
// inside (`precise` keeps products and sums apart). So no ray slips between triangles that share corners: I. Woop,
// C. Benthin, I. Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013 [WBW13].
// Boxes are widened by what the quotients and products of their planes can be rounded.
//
// One loop does all: a turn is a node, a triangle or a reference that waited in vain. It ends after kMostTurns, as
// software Vulkan ends all loops of an invocation after 65,535 turns together, and silently; then `complete` is false.
#include "base/vectors.glsl"
#include "ray_tracing/hierarchy_records.h"

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer HierarchyNodes { HierarchyNode value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer HierarchyTriangles {
  HierarchyTriangle value[];
};

const uint kMostTurns = 60000u;

struct HierarchyAddress {
  uint64_t nodes, triangles;
  uint root;  // reference
};

struct Ray {
  vec3 origin;              // [m]
  vec3 direction;           // any length but 0
  float nearest, farthest;  // hits count strictly between these, in units of the direction's length; not below 0
};

struct Hit {
  uint mesh, triangle;  // kNothing: nothing met
  vec2 uv;              // barycentric: point = (1-u-v) a + u b + v c
  float distance;       // in units of the direction's length
  bool complete;        // false: there were too many nodes and triangles on the way
  uint turns;
};

bool stops_ray(uint mesh, uint triangle, vec2 uv);

vec4 lanes(float v[4]) { return vec4(v[0], v[1], v[2], v[3]); }

// The ray's own frame: its direction lies along z, so that what a ray passes is told in two dimensions [WBW13].
struct RayFrame {
  uint axis;   // of the longest part of the direction
  vec2 slope;  // of the other two parts to it
};

vec3 turned(vec3 v, uint axis) { return axis == 0u ? v.yzx : axis == 1u ? v.zxy : v; }

RayFrame frame_of(vec3 direction) {
  const vec3 size = abs(direction);
  RayFrame frame;
  frame.axis = size.x > size.y ? (size.x > size.z ? 0u : 2u) : (size.y > size.z ? 1u : 2u);
  const vec3 d = turned(direction, frame.axis);
  frame.slope = d.xy / d.z;
  return frame;
}

// How far a point, relative to the ray's origin, lies beside the ray.
vec2 beside(vec3 point, RayFrame frame) {
  const vec3 p = turned(point, frame.axis);
  precise vec2 at = p.xy - frame.slope * p.z;
  return at;
}

// On which side the ray passes an edge from p to q: each product rounds to where the exact one does, or to the same as
// the other, so that the sign is right or the number is 0.
float side_of_edge(vec2 p, vec2 q) {
  precise float doubled_area = p.x * q.y - p.y * q.x;
  return doubled_area;
}

struct TriangleHit {
  bool met;
  float distance;
  vec2 uv;
};

TriangleHit meet(HierarchyTriangle t, Ray ray, RayFrame frame) {
  const vec3 a = vector(t.a), b = vector(t.b), c = vector(t.c);
  const vec2 at_a = beside(a - ray.origin, frame), at_b = beside(b - ray.origin, frame),
             at_c = beside(c - ray.origin, frame);
  // The weights of the corners, not yet divided.
  const float of_a = side_of_edge(at_b, at_c), of_b = side_of_edge(at_c, at_a), of_c = side_of_edge(at_a, at_b);
  const float sum = of_a + of_b + of_c;
  const vec3 normal = cross(b - a, c - a);
  const float approach = dot(ray.direction, normal);
  const float least = min(min(of_a, of_b), of_c), most = max(max(of_a, of_b), of_c);
  TriangleHit hit;
  hit.met = (least >= 0.0 || most <= 0.0) && sum != 0.0 && approach != 0.0;
  hit.distance = dot(a - ray.origin, normal) / approach;
  hit.uv = vec2(of_b, of_c) / sum;
  return hit;
}

// 1 / direction, large where that would be infinite: the ray is bent by less than its own rounding.
vec3 inverse_direction(vec3 direction) {
  const vec3 size = abs(direction);
  const float least = max(max(size.x, size.y), size.z) * 1e-18;
  return 1.0 / mix(direction, mix(vec3(least), vec3(-least), lessThan(direction, vec3(0.0))), lessThan(size, vec3(least)));
}

struct Entries {
  vec4 distance;  // where the ray enters each child's box; kMissed where it does not
  uvec4 child;
};
#define kMissed uintBitsToFloat(0x7f800000u)

void exchange(inout Entries e, int i, int j) {
  if (e.distance[j] < e.distance[i]) {
    const float distance = e.distance[i];
    const uint child = e.child[i];
    e.distance[i] = e.distance[j];
    e.child[i] = e.child[j];
    e.distance[j] = distance;
    e.child[j] = child;
  }
}

// The children whose boxes the ray meets before `farthest`, nearest first.
Entries enter(HierarchyNode node, vec3 origin, vec3 inverse_d, float nearest, float farthest) {
  const vec4 low_x = (lanes(node.low_x) - origin.x) * inverse_d.x, high_x = (lanes(node.high_x) - origin.x) * inverse_d.x;
  const vec4 low_y = (lanes(node.low_y) - origin.y) * inverse_d.y, high_y = (lanes(node.high_y) - origin.y) * inverse_d.y;
  const vec4 low_z = (lanes(node.low_z) - origin.z) * inverse_d.z, high_z = (lanes(node.high_z) - origin.z) * inverse_d.z;
  const vec4 enters = max(max(min(low_x, high_x), min(low_y, high_y)), max(min(low_z, high_z), vec4(nearest)));
  const vec4 leaves = min(min(max(low_x, high_x), max(low_y, high_y)), min(max(low_z, high_z), vec4(farthest)));
  // Difference 1/2, quotient 2 1/2 (Vulkan allows that), product 1/2 unit in the last place, for both ends: below 2^-20.
  const bvec4 met = lessThanEqual(enters, leaves * (1.0 + 1.0 / 1048576.0));
  Entries e;
  e.child = uvec4(node.child[0], node.child[1], node.child[2], node.child[3]);
  e.distance = mix(vec4(kMissed), mix(vec4(kMissed), enters, met), notEqual(e.child, uvec4(kNothing)));
  exchange(e, 0, 1);
  exchange(e, 2, 3);
  exchange(e, 0, 2);
  exchange(e, 1, 3);
  exchange(e, 1, 2);
  return e;
}

// Of two triangles at the same distance the one with the lower number is met, however the hierarchy is built.
bool is_nearer(float distance, HierarchyTriangle t, Hit than) {
  const bool before = t.mesh < than.mesh || (t.mesh == than.mesh && t.triangle < than.triangle);
  return distance < than.distance || (distance == than.distance && than.mesh != kNothing && before);
}

// Written out, as a loop would count among the turns that software Vulkan allows.
#define LET_WAIT(i)                              \
  if (e.distance[i] < kMissed) {                 \
    waiting[filled] = e.child[i];                \
    waiting_distance[filled] = e.distance[i];    \
    ++filled;                                    \
  }

//   any  a hit is enough, not the nearest; a constant
Hit trace(HierarchyAddress hierarchy, Ray ray, bool any) {
  Hit hit;
  hit.mesh = hit.triangle = kNothing;
  hit.uv = vec2(0.0);
  hit.distance = ray.farthest;
  hit.turns = 0u;
  const vec3 inverse_d = inverse_direction(ray.direction);
  const RayFrame frame = frame_of(ray.direction);
  uint waiting[kTraceStack];
  float waiting_distance[kTraceStack];
  uint filled = 0u, current = hierarchy.root;
  for (; (current != kNothing || filled > 0u) && hit.turns < kMostTurns; ++hit.turns) {
    if (current == kNothing) {
      --filled;
      if (waiting_distance[filled] <= hit.distance) current = waiting[filled];
    } else if ((current & kLeaf) != 0u) {
      const HierarchyTriangle t = HierarchyTriangles(hierarchy.triangles).value[current & kLeafFirstMask];
      const TriangleHit met = meet(t, ray, frame);
      // The next triangle of the leaf, if there is one.
      current = ((current >> kLeafCountShift) & 7u) == 0u ? kNothing : current - (1u << kLeafCountShift) + 1u;
      if (met.met && met.distance > ray.nearest && is_nearer(met.distance, t, hit) &&
          (t.has_holes == 0u || stops_ray(t.mesh, t.triangle, met.uv))) {
        hit.mesh = t.mesh;
        hit.triangle = t.triangle;
        hit.uv = met.uv;
        hit.distance = met.distance;
        if (any) {
          current = kNothing;
          filled = 0u;
        }
      }
    } else {
      const Entries e = enter(HierarchyNodes(hierarchy.nodes).value[current], ray.origin, inverse_d, ray.nearest, hit.distance);
      LET_WAIT(3)
      LET_WAIT(2)
      LET_WAIT(1)
      current = e.distance[0] < kMissed ? e.child[0] : kNothing;
    }
  }
  hit.complete = current == kNothing && filled == 0u;
  return hit;
}
