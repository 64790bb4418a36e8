// SPDX-License-Identifier: Apache-2.0
// Which point of a triangle a pixel shows that a rasteriser gave to it: where the pixel's ray meets the triangle, in the
// arithmetic of trace.glsl. Rasterisers move corners to a grid, so a ray may pass beside the triangle by a part of a
// pixel; then it is the point of the edges that lies nearest to the ray. Included behind scene.glsl.

HierarchyTriangle triangle_of(uint mesh_index, uint triangle) {
  const MeshRecord mesh = MeshRecords(scene().meshes).value[mesh_index];
  const Corners c = corners_of(mesh, triangle, vec2(0.0));
  const vec3 a = floats3(mesh.positions, c.index.x), b = floats3(mesh.positions, c.index.y),
             d = floats3(mesh.positions, c.index.z);
  HierarchyTriangle t;
  t.a = float[3](a.x, a.y, a.z);
  t.b = float[3](b.x, b.y, b.z);
  t.c = float[3](d.x, d.y, d.z);
  t.mesh = mesh_index;
  t.triangle = triangle;
  t.has_holes = 0u;
  return t;
}

// Where the segment from p to q comes nearest to the ray, beside which both lie: the part of the way, and the squared
// distance there.
vec2 nearest_along(vec2 p, vec2 q) {
  const vec2 way = q - p;
  const float length_sq = dot(way, way);
  const float part = length_sq > 0.0 ? clamp(-dot(p, way) / length_sq, 0.0, 1.0) : 0.0;
  const vec2 there = p + part * way;
  return vec2(part, dot(there, there));
}

// Barycentric, of the point of the edges that lies nearest to the ray.
vec2 nearest_on_edges(HierarchyTriangle t, Ray ray, RayFrame frame) {
  const vec2 a = beside(vector(t.a) - ray.origin, frame), b = beside(vector(t.b) - ray.origin, frame),
             c = beside(vector(t.c) - ray.origin, frame);
  const vec2 ab = nearest_along(a, b), bc = nearest_along(b, c), ca = nearest_along(c, a);
  if (ab.y <= bc.y && ab.y <= ca.y) return vec2(ab.x, 0.0);
  return bc.y <= ca.y ? vec2(1.0 - bc.x, bc.x) : vec2(0.0, 1.0 - ca.x);
}

Hit shown_point(uint mesh, uint triangle, Ray ray) {
  const HierarchyTriangle t = triangle_of(mesh, triangle);
  const RayFrame frame = frame_of(ray.direction);
  const TriangleHit met = meet(t, ray, frame);
  Hit hit;
  hit.mesh = mesh;
  hit.triangle = triangle;
  hit.uv = met.uv;
  hit.distance = met.distance;
  hit.complete = true;
  hit.turns = 0u;
  if (!met.met || met.distance <= ray.nearest) {
    hit.uv = nearest_on_edges(t, ray, frame);
    const vec3 point =
        vector(t.a) * (1.0 - hit.uv.x - hit.uv.y) + vector(t.b) * hit.uv.x + vector(t.c) * hit.uv.y - ray.origin;
    hit.distance = dot(point, ray.direction) / dot(ray.direction, ray.direction);
  }
  return hit;
}
