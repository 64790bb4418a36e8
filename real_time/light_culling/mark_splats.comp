// SPDX-License-Identifier: Apache-2.0
// Rasterisation of geodesic spheres at full resolution: a light and four rows of tiles per workgroup; an invocation
// sets up triangles, then takes cells of 4x4 pixels. The text follows splat_kernel.cpp, which says why each pixel is covered
// once. Bits and counts are changed by atomics, so that the order of lights does not show.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "real_time/light_culling/proxy.glsl"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Proxy { GeodesicProxy value; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Cells { SplatCell value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Covering { uint word[]; };

const uint kThreads = 64u, kTriangles = 80u;
const int kCells = 4;                // per side of a tile
const float kOverlap = 1.0 / 16.0;   // of a cell's side, as splat_kernel.cpp
const int kRowsOfGroup = 4;          // of tiles: what bounds the loops of an invocation
const float kReach = 1.25;           // no corner of the proxy is farther away than this many radii of the sphere

// The triangles. Functions of a ray's slopes: x * ray.x + y * ray.y + z.
shared vec3 edge[3][kTriangles];       // not negative inside
shared vec4 plane[kTriangles];         // its depth along the ray is w over the function; w > 0: seen from inside
shared vec4 extent[kTriangles];        // left, right, top, bottom of the part beyond the nearest surface [cells]
shared float farthest_of[kTriangles];  // depth of the farthest corner, with what rounding may lose [m]
shared int column_begin, column_end, row_begin, row_end;  // cells that they may cover
shared uint farthest;                                     // bits of the depth of all, not negative

// ray -> v . (factor * ray), and a bound of what is lost by rounding for slopes up to 2.
vec3 of_ray(TriangularFactor m, vec3 v) {
  return vec3(m.m00 * v.x, m.m01 * v.x + m.m11 * v.y, m.m02 * v.x + m.m12 * v.y + m.m22 * v.z);
}
float rounding(TriangularFactor m, vec3 v) {
  const vec3 a = abs(v);
  return 1e-6 * ((m.m00 + abs(m.m01) + abs(m.m02)) * a.x + (m.m11 + abs(m.m12)) * a.y + m.m22 * a.z);
}

vec4 grown(Band band, vec4 e, vec2 slope) {
  const float x = (slope.x - band.x_first) * (float(kCells) / band.x_step);
  const float y = (slope.y - band.y_first) * (float(kCells) / band.y_step);
  return vec4(min(x, e.x), max(x, e.y), min(y, e.z), max(y, e.w));
}

// Only what lies beyond the nearest surface can cover a pixel.
vec4 extent_of(Band band, vec3 corner[3]) {
  const float nearest = depth_of_slice(band.slices, 0u) * (1.0 - 1e-5);
  vec4 e = vec4(kFar, -kFar, kFar, -kFar);
  for (int k = 0; k < 3; ++k) {
    const vec3 a = corner[k], b = corner[(k + 1) % 3];
    if (a.z >= nearest) e = grown(band, e, a.xy / a.z);
    if ((a.z >= nearest) == (b.z >= nearest)) continue;
    const float t = (nearest - a.z) / (b.z - a.z);
    e = grown(band, e, (a.xy + (b.xy - a.xy) * t) / nearest);
  }
  return e;
}

void set_up_triangle(Light light, Band band, uint i) {
  Proxy proxy = Proxy(push.proxy);
  const vec3 normal = vec3(proxy.value.normal[0][i], proxy.value.normal[1][i], proxy.value.normal[2][i]);
  const float limit = proxy.value.distance[i] + dot(normal, light.test.stretched);
  vec3 stretched_corner[3], corner[3];
  for (int k = 0; k < 3; ++k) {
    stretched_corner[k] =
        vec3(proxy.value.corner[k][0][i], proxy.value.corner[k][1][i], proxy.value.corner[k][2][i]);
    corner[k] = to_view(light, stretched_corner[k]);
  }
  for (int k = 0; k < 3; ++k) {
    const vec3 p = stretched_corner[k], q = stretched_corner[(k + 1) % 3];
    const vec3 side = cross(p, q) + cross(light.test.stretched, q - p);  // (p + stretched) x (q + stretched)
    edge[k][i] = of_ray(light.test.factor, side);
    edge[k][i].z += rounding(light.test.factor, side);  // no pixel falls between two triangles
  }
  plane[i] = vec4(of_ray(light.test.factor, normal), limit);
  const vec4 e = limit > 0.0 ? extent_of(band, corner) : vec4(kFar, -kFar, kFar, -kFar);
  extent[i] = e;
  farthest_of[i] = max(max(corner[0].z, corner[1].z), corner[2].z) +
                   4e-6 * (abs(light.test.centre.z) + light.inverse.m22);
  atomicMax(farthest, floatBitsToUint(max(farthest_of[i], 1e-30)));
  atomicMin(column_begin, whole_below(e.x - kOverlap));
  atomicMax(column_end, whole_below(e.y + kOverlap) + 1);
  atomicMin(row_begin, whole_below(e.z - kOverlap));
  atomicMax(row_end, whole_below(e.w + kOverlap) + 1);
}

// Which triangles reach a cell: a bit each. Those that end before the cell's nearest pixel are left out, as
// hierarchical depth tests do.
uint[3] triangles_of(int column, int row, float nearest) {
  const float left = float(column) - kOverlap, right = float(column + 1) + kOverlap;
  const float top = float(row) - kOverlap, bottom = float(row + 1) + kOverlap;
  uint bits[3] = uint[3](0u, 0u, 0u);
  for (uint i = 0u; i < kTriangles; ++i) {
    const vec4 e = extent[i];
    const bool meets = e.x <= right && e.y >= left && e.z <= bottom && e.w >= top && farthest_of[i] >= nearest;
    bits[i / 32u] |= meets ? 1u << (i % 32u) : 0u;
  }
  return bits;
}

vec4 four(float v[16], uint first) { return vec4(v[first], v[first + 1u], v[first + 2u], v[first + 3u]); }
uint bits_of(bvec4 b) { return (b.x ? 1u : 0u) | (b.y ? 2u : 0u) | (b.z ? 4u : 0u) | (b.w ? 8u : 0u); }

vec4 along(vec3 f, vec4 x, vec4 y) { return f.x * x + (f.y * y + f.z); }

// Which of four pixels a triangle covers, and which lie above the light's surface.
uint four_covered(SplatCell cell, uint first, uint i) {
  const vec4 x = four(cell.x, first), y = four(cell.y, first), depth = four(cell.depth, first);
  const vec4 edges = min(min(along(edge[0][i], x, y), along(edge[1][i], x, y)), along(edge[2][i], x, y));
  return bits_of(greaterThanEqual(edges, vec4(0.0))) & bits_of(greaterThan(depth, vec4(0.0))) &
         bits_of(lessThanEqual(depth * along(plane[i].xyz, x, y), vec4(plane[i].w)));
}
uint four_above(SurfacePlane surface, SplatCell cell, uint first) {
  const vec4 x = four(cell.x, first), y = four(cell.y, first), depth = four(cell.depth, first);
  const vec4 height = (surface.normal.x * x + surface.normal.y * y + surface.normal.z) * depth;
  return bits_of(greaterThanEqual(height, vec4(surface.offset)));
}

// A bit per pixel that a triangle covers; each is covered once, so that a full cell ends the search.
uint covered_pixels(SplatCell cell, uint triangles[3], inout uint tests) {
  uint covered = 0u;
  for (uint word = 0u; word < 3u; ++word) {
    for (uint left = triangles[word]; left != 0u && covered != 0xffffu; left &= left - 1u) {
      const uint i = 32u * word + uint(findLSB(left));
      ++tests;
      covered |= four_covered(cell, 0u, i) | four_covered(cell, 4u, i) << 4u | four_covered(cell, 8u, i) << 8u |
                 four_covered(cell, 12u, i) << 12u;
    }
  }
  return covered;
}

void list_in_cell(Light light, uint tile, uint cell, int column, int row) {
  const uint at = tile * 16u + cell;
  const float nearest = Cells(push.cells).value[at].nearest;
  if (nearest > uintBitsToFloat(farthest)) return;
  const uint triangles[3] = triangles_of(column, row, nearest);
  if ((triangles[0] | triangles[1] | triangles[2]) == 0u) return;
  const SplatCell pixels = Cells(push.cells).value[at];
  uint tests = 0u;
  uint covered = covered_pixels(pixels, triangles, tests);
  atomicAdd(Counts(push.counts).value[tile].tests, tests);
  if (kTileTest != 0u && covered != 0u) {
    const SurfacePlane s = light.test.surface;
    covered &= four_above(s, pixels, 0u) | four_above(s, pixels, 4u) << 4u | four_above(s, pixels, 8u) << 8u |
               four_above(s, pixels, 12u) << 12u;
  }
  if (covered == 0u) return;
  list_light(at);
  for (uint pair = 0u; pair < 8u; ++pair) {
    const uint two = covered >> (2u * pair) & 3u;
    if (two != 0u) atomicAdd(Covering(push.covering).word[at * 8u + pair], (two & 1u) | (two >> 1u) << 16u);
  }
}

void main() {
  if (!shows_a_surface()) return;
  const Band band = read_band();
  const Light light = read_light(band);
  if (!light.exists) return;
  const int first_row = int(gl_WorkGroupID.z) * kRowsOfGroup;
  const bool first_group = gl_LocalInvocationIndex == 0u && gl_WorkGroupID.z == 0u;
  if (first_group) atomicAdd(Counts(push.counts).value[tile_at(band, 0, 0)].tests, kTriangles);
  const float margin = 1.0 / 32.0;
  if (!is_near(band, light.entry, float(first_row) - margin, float(first_row + kRowsOfGroup) + margin, kReach)) return;
  if (gl_LocalInvocationIndex == 0u) {
    column_begin = row_begin = 0x7fffffff;
    column_end = row_end = 0;
    farthest = 0u;
  }
  barrier();
  for (uint i = gl_LocalInvocationIndex; i < kTriangles; i += kThreads) set_up_triangle(light, band, i);
  barrier();
  const int columns_begin = max(column_begin, 0) / kCells, rows_begin = max(max(row_begin, 0) / kCells, first_row);
  const int columns = (min(column_end, band.columns * kCells) + kCells - 1) / kCells - columns_begin;
  const int rows_end = min((min(row_end, band.rows * kCells) + kCells - 1) / kCells, first_row + kRowsOfGroup);
  if (columns <= 0 || rows_end <= rows_begin) return;
  const int cell = int(gl_LocalInvocationIndex % 16u);
  for (int i = int(gl_LocalInvocationIndex / 16u); i < columns * (rows_end - rows_begin); i += int(kThreads / 16u)) {
    const int column = columns_begin + i % columns, row = rows_begin + i / columns;
    const uint tile = tile_at(band, column, row);
    if ((Occupied(push.occupied).value[tile] >> cell & 1u) == 0u) continue;
    list_in_cell(light, tile, uint(cell), column * kCells + cell % kCells, row * kCells + cell / kCells);
  }
}
