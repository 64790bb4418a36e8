// SPDX-License-Identifier: Apache-2.0
// What the kernels of proxies share: the tiles that a light may be in, and its ellipsoid. The text follows proxy.inc
// and light_lists.cpp. A workgroup is a light of a window: number in the window, sub-region.
#include "equations/exact_tile_test.h"
#include "real_time/light_culling/list_records.h"
#include "real_time/light_culling/sphere_proxy.h"
#include "real_time/shading/shading_records.h"

layout(constant_id = 0) const uint kTileTest = 2u;  // TileTest: 0 paper, 1 exact, 2 tight
layout(push_constant, scalar) uniform Push { MarkPush push; };
#include "real_time/light_culling/cluster_slices.glsl"
#include "real_time/light_range/bounds.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Subsets { SubsetRange value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Occupied { uint value[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Lists { uint word[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counts { PartCounts value[]; };

const float kFar = 1e30;

// The tiles of this workgroup's sub-region: TileBand.
struct Band {
  float x_first, x_step;
  float y_first, y_step;
  int columns, rows;
  ClusterSlices slices;
};

Band read_band() {
  const uint region = gl_WorkGroupID.y, side = 16u * push.interleave;
  const float n = float(push.interleave), border = 0.5 - 0.5 * n;
  Band band;
  band.x_first = (float(region % push.interleave) + border - 0.5 * float(push.width)) * push.pixel;
  band.y_first = (0.5 * float(push.height) - float(region / push.interleave) - border) * push.pixel;
  band.x_step = 16.0 * n * push.pixel;
  band.y_step = -band.x_step;
  band.columns = int((push.width + side - 1u) / side);
  band.rows = int((push.height + side - 1u) / side);
  band.slices = read_slices();
  return band;
}

uint tile_at(Band band, int column, int row) {
  return (gl_WorkGroupID.y * uint(band.rows) + uint(row)) * uint(band.columns) + uint(column);
}

// This workgroup's light.
struct Light {
  bool exists;
  uint entry;  // of bounds
  TileTestEllipsoid test;    // as tiles are tested against; in its stretched space it is the unit sphere
  TriangularFactor inverse;  // of test.factor
};

TriangularFactor inverse_of(TriangularFactor m) {
  TriangularFactor i;
  i.m00 = 1.0 / m.m00;
  i.m11 = 1.0 / m.m11;
  i.m22 = 1.0 / m.m22;
  i.m01 = -m.m01 * i.m00 * i.m11;
  i.m12 = -m.m12 * i.m11 * i.m22;
  i.m02 = -(m.m02 * i.m00 + m.m12 * i.m01) * i.m22;
  return i;
}

// May a sphere round the bound, `reach` times as large, touch the rows?
bool is_near(Band band, uint entry, float row_begin, float row_end, float reach) {
  Tile frustum;
  frustum.x_low = band.x_first - 0.01 * band.x_step;
  frustum.x_high = band.x_first + (float(band.columns) + 0.01) * band.x_step;
  frustum.y_low = band.y_first + row_end * band.y_step;
  frustum.y_high = band.y_first + row_begin * band.y_step;
  frustum.near_low = depth_of_slice(band.slices, 0u) * (1.0 - 1e-5);
  frustum.near_high = depth_of_slice(band.slices, kSlices) * (1.0 + 1e-5);
  frustum.far_low = 1.0;  // an empty half
  frustum.far_high = 0.0;
  const float radius = bound_row(entry, kRadius);
  return radius >= 0.0 && sphere_may_touch(side_planes(frustum), bound_rows(entry, kCentreX), radius * reach);
}

Light read_light(Band band) {
  const uint subsets = push.interleave * push.interleave;
  const SubsetRange subset = Subsets(push.subsets).value[(gl_WorkGroupID.y + push.shift) % subsets];
  const uint number = push.first_light + gl_WorkGroupID.x;
  Light light;
  light.entry = subset.begin + number;
  light.exists = number < subset.count && is_near(band, light.entry, -0.01, float(band.rows) + 0.01, 1.0);
  if (light.exists) {
    light.test = load_ellipsoid(light.entry);
    light.inverse = inverse_of(light.test.factor);
  }
  return light;
}

// A point of the stretched space, relative to the sphere's centre, in view space [m].
vec3 to_view(Light light, vec3 p) {
  const TriangularFactor i = light.inverse;
  return light.test.centre +
         vec3(i.m00 * p.x + i.m01 * p.y + i.m02 * p.z, i.m11 * p.y + i.m12 * p.z, i.m22 * p.z);
}

// Largest whole number below, within what any picture has.
int whole_below(float x) {
  const float bounded = x < -1.0 ? -1.0 : x > 1e6 ? 1e6 : x;
  return int(bounded + 1.0) - 1;
}

// Puts this workgroup's light into the list of a part.
void list_light(uint part) {
  atomicOr(Lists(push.lists).word[part * push.words + gl_WorkGroupID.x / 32u], 1u << gl_WorkGroupID.x % 32u);
}
