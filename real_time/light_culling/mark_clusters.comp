// SPDX-License-Identifier: Apache-2.0
// Conservative rasterisation of icosahedra at the resolution of tiles: a light and 32 rows of tiles per workgroup, an
// edge of the light's proxy per invocation. The text follows cluster_kernel.cpp, which says why the depths that are visited are enough; a workgroup
// keeps those of 16x16 tiles at a time. Bits are set by atomics, so that the order of lights does not show.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "real_time/light_culling/proxy.glsl"

layout(local_size_x = 32) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Proxy { IcosahedronProxy value; };

const uint kThreads = 32u, kVertices = 12u, kEdges = 30u, kSlabs = 10u;
const float kOverlap = 1.0 / 64.0;  // as cluster_kernel.cpp
const int kSide = 16;               // tiles along a side of a block
const int kRowsOfGroup = 32;        // of tiles: what bounds the loops of an invocation

shared int column_begin, column_end, row_begin, row_end;  // tiles that the proxy may cover
shared uint low[kSide * kSide], high[kSide * kSide];      // depths of the proxy in a block's tiles, their bits

struct Block {
  int column_begin, column_end, row_begin, row_end;
};

vec3 edge_end(Light light, bool second) {
  const uint i = gl_LocalInvocationIndex;
  Proxy proxy = Proxy(push.proxy);
  vec3 p;
  for (int axis = 0; axis < 3; ++axis) {
    p[axis] = second ? proxy.value.edge_to[axis][i] : proxy.value.edge_from[axis][i];
  }
  return to_view(light, p);
}

vec3 vertex(Light light) {
  const uint i = gl_LocalInvocationIndex % kVertices;
  Proxy proxy = Proxy(push.proxy);
  return to_view(light, vec3(proxy.value.vertex[0][i], proxy.value.vertex[1][i], proxy.value.vertex[2][i]));
}

// In units of tiles.
vec2 tile_of(Band band, vec2 slope) {
  return vec2((slope.x - band.x_first) * (1.0 / band.x_step), (slope.y - band.y_first) * (1.0 / band.y_step));
}

void grow_rectangle(Band band, vec2 slope) {
  const vec2 tile = tile_of(band, slope);
  atomicMin(column_begin, whole_below(tile.x - kOverlap));
  atomicMax(column_end, whole_below(tile.x + kOverlap) + 1);
  atomicMin(row_begin, whole_below(tile.y - kOverlap));
  atomicMax(row_end, whole_below(tile.y + kOverlap) + 1);
}

// The tiles of what lies at the nearest surface's depth or beyond it.
void find_rectangle(Band band, vec3 corner, vec3 from, vec3 to) {
  const float nearest = depth_of_slice(band.slices, 0u) * (1.0 - 1e-5);
  if (gl_LocalInvocationIndex < kVertices && corner.z >= nearest) grow_rectangle(band, corner.xy * (1.0 / corner.z));
  if (gl_LocalInvocationIndex < kEdges && (from.z >= nearest) != (to.z >= nearest)) {
    const float t = (nearest - from.z) / (to.z - from.z);
    grow_rectangle(band, (from.xy + (to.xy - from.xy) * t) * (1.0 / nearest));
  }
}

// Depths are not negative, but may be -0.
void add_depths(Block block, int column, int row, float low_depth, float high_depth) {
  if (column < block.column_begin || column >= block.column_end) return;
  if (row < block.row_begin || row >= block.row_end) return;
  const int i = (row - block.row_begin) * kSide + column - block.column_begin;
  atomicMin(low[i], floatBitsToUint(low_depth) & 0x7fffffffu);
  atomicMax(high[i], floatBitsToUint(high_depth) & 0x7fffffffu);
}

void add_vertex(Band band, Block block, vec3 v) {
  if (gl_LocalInvocationIndex >= kVertices || !(v.z > 0.0)) return;
  const vec2 tile = tile_of(band, v.xy * (1.0 / v.z));
  for (int c = whole_below(tile.x - kOverlap); c <= whole_below(tile.x + kOverlap); ++c) {
    for (int r = whole_below(tile.y - kOverlap); r <= whole_below(tile.y + kOverlap); ++r) {
      add_depths(block, c, r, v.z, v.z);
    }
  }
}

// Where this invocation's edge crosses the borders between columns (axis 0) or rows (axis 1).
void add_border_crossings(Band band, Block block, vec3 a, vec3 b, int axis) {
  if (gl_LocalInvocationIndex >= kEdges) return;
  const int other = 1 - axis;
  const float first = axis == 0 ? band.x_first : band.y_first, step = axis == 0 ? band.x_step : band.y_step;
  const float other_first = axis == 0 ? band.y_first : band.x_first;
  const float per_other = 1.0 / (axis == 0 ? band.y_step : band.x_step);
  const int begin = axis == 0 ? block.column_begin : block.row_begin;
  const int end = axis == 0 ? block.column_end : block.row_end;
  for (int border = begin; border <= end; ++border) {
    const float slope = first + float(border) * step;
    const float from = a[axis] - slope * a.z, to = b[axis] - slope * b.z;
    if (!((from <= 0.0 && to >= 0.0) || (from >= 0.0 && to <= 0.0))) continue;
    const float share = from / (from - to);  // no number if the edge lies in the border: its ends are vertices
    const float z = a.z + (b.z - a.z) * share;
    if (!(z > 0.0)) continue;
    const float place = ((a[other] + (b[other] - a[other]) * share) / z - other_first) * per_other;
    for (int tile = whole_below(place - kOverlap); tile <= whole_below(place + kOverlap); ++tile) {
      for (int side = border - 1; side <= border; ++side) {
        add_depths(block, axis == 0 ? side : tile, axis == 0 ? tile : side, z, z);
      }
    }
  }
}

// Where rays through the corners of tiles enter and leave the slabs that the polyhedron is the meeting of.
void add_corners(Light light, Band band, Block block) {
  Proxy proxy = Proxy(push.proxy);
  const TriangularFactor m = light.test.factor;
  const int columns = block.column_end - block.column_begin + 1, rows = block.row_end - block.row_begin + 1;
  for (int i = int(gl_LocalInvocationIndex); i < columns * rows; i += int(kThreads)) {
    const int column = block.column_begin + i % columns, row = block.row_begin + i / columns;
    const float x = band.x_first + float(column) * band.x_step, y = band.y_first + float(row) * band.y_step;
    const vec3 direction = vec3(m.m00 * x + (m.m01 * y + m.m02), m.m11 * y + m.m12, m.m22);
    float enters = 0.0, leaves = kFar;
    for (uint s = 0u; s < kSlabs; ++s) {
      const vec3 normal =
          vec3(proxy.value.slab_normal[0][s], proxy.value.slab_normal[1][s], proxy.value.slab_normal[2][s]);
      const float middle = dot(normal, light.test.stretched), slope = dot(normal, direction);
      if (slope == 0.0) {  // along the slab: no quotient tells on which side of it
        leaves = abs(middle) <= proxy.value.distance ? leaves : -1.0;
        continue;
      }
      const float first = (middle - proxy.value.distance) / slope, second = (middle + proxy.value.distance) / slope;
      enters = max(min(first, second), enters);
      leaves = min(max(first, second), leaves);
    }
    if (!(enters <= leaves)) continue;
    add_depths(block, column - 1, row - 1, enters, leaves);
    add_depths(block, column, row - 1, enters, leaves);
    add_depths(block, column - 1, row, enters, leaves);
    add_depths(block, column, row, enters, leaves);
  }
}

uint slices_of(Band band, float low_depth, float high_depth) {
  const float nearer = low_depth * (1.0 - 1e-5), farther = high_depth * (1.0 + 1e-5);
  if (!(nearer <= farther) || farther < depth_of_slice(band.slices, 0u)) return 0u;
  if (nearer > depth_of_slice(band.slices, kSlices)) return 0u;
  const uint first = cluster_slice_of(band.slices, nearer), last = cluster_slice_of(band.slices, farther);
  return (0xffffffffu << first) & (0xffffffffu >> (kSlices - 1u - last));
}

// Of the slices of a tile, those that pass the tile test as well.
uint slices_touched(Light light, Band band, int column, int row, uint slices) {
  Tile tile;
  tile.x_low = band.x_first + (float(column) - kOverlap) * band.x_step;
  tile.x_high = band.x_first + (float(column + 1) + kOverlap) * band.x_step;
  tile.y_low = band.y_first + (float(row + 1) + kOverlap) * band.y_step;
  tile.y_high = band.y_first + (float(row) - kOverlap) * band.y_step;
  tile.far_low = 1.0;  // an empty half
  tile.far_high = 0.0;
  uint touched = 0u;
  for (uint left = slices; left != 0u; left &= left - 1u) {
    const uint slice = uint(findLSB(left));
    tile.near_low = depth_of_slice(band.slices, slice) * (1.0 - 1e-5);
    tile.near_high = depth_of_slice(band.slices, slice + 1u) * (1.0 + 1e-5);
    const bool touches = kTileTest == 1u ? ellipsoid_touches_tile_exactly(light.test, tile).near_half
                                         : ellipsoid_touches_tile(light.test, tile).near_half;
    touched |= touches ? 1u << slice : 0u;
  }
  return touched;
}

void list_in_tiles(Light light, Band band, Block block) {
  const int columns = block.column_end - block.column_begin, rows = block.row_end - block.row_begin;
  for (int i = int(gl_LocalInvocationIndex); i < columns * rows; i += int(kThreads)) {
    const int at = i / columns * kSide + i % columns;
    const int column = block.column_begin + i % columns, row = block.row_begin + i / columns;
    const uint tile = tile_at(band, column, row);
    atomicAdd(Counts(push.counts).value[tile].tests, 1u);
    uint slices = slices_of(band, uintBitsToFloat(low[at]), uintBitsToFloat(high[at]));
    slices &= Occupied(push.occupied).value[tile];
    // The paper's lists are those of the proxies.
    if (kTileTest != 0u) slices = slices_touched(light, band, column, row, slices);
    for (uint left = slices; left != 0u; left &= left - 1u) list_light(tile * kSlices + uint(findLSB(left)));
  }
}

void list_in_block(Light light, Band band, Block block, vec3 corner, vec3 from, vec3 to) {
  for (uint i = gl_LocalInvocationIndex; i < uint(kSide * kSide); i += kThreads) {
    low[i] = floatBitsToUint(kFar);
    high[i] = 0u;
  }
  barrier();
  add_vertex(band, block, corner);
  add_border_crossings(band, block, from, to, 0);
  add_border_crossings(band, block, from, to, 1);
  add_corners(light, band, block);
  barrier();
  list_in_tiles(light, band, block);
  barrier();  // the next block writes the depths anew
}

void main() {
  if (!shows_a_surface()) return;
  const Band band = read_band();
  const Light light = read_light(band);
  if (!light.exists) return;
  if (gl_LocalInvocationIndex == 0u) {
    column_begin = row_begin = 0x7fffffff;
    column_end = row_end = 0;
    if (gl_WorkGroupID.z == 0u) atomicAdd(Counts(push.counts).value[tile_at(band, 0, 0)].tests, 2u * kSlabs);
  }
  barrier();
  const vec3 corner = vertex(light), from = edge_end(light, false), to = edge_end(light, true);
  find_rectangle(band, corner, from, to);
  barrier();
  const int first_row = int(gl_WorkGroupID.z) * kRowsOfGroup;
  const int last_column = min(column_end, band.columns);
  const int last_row = min(min(row_end, band.rows), first_row + kRowsOfGroup);
  for (int row = max(row_begin, first_row); row < last_row; row += kSide) {
    for (int column = max(column_begin, 0); column < last_column; column += kSide) {
      const Block block = Block(column, min(column + kSide, last_column), row, min(row + kSide, last_row));
      list_in_block(light, band, block, corner, from, to);
    }
  }
}
