// SPDX-License-Identifier: Apache-2.0
// What the three range kernels share: this frame's random number, and the bound as culling reads it. One light per
// invocation; the text follows light_range_kernel.cpp.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "base/vectors.glsl"
#include "equations/light_emission.h"
#include "equations/paper_tile_test.h"
#include "equations/random_number.h"
#include "equations/tight_bound.h"
#include "real_time/light_range/emitters.h"
#include "real_time/light_range/range_records.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kBounds = 3u;     // BoundingVolume
layout(constant_id = 1) const uint kPaperRows = 0u;  // prepare bounds for the paper's tile test
const uint kSphereAtLight = 0u, kSphere = 1u, kSpheroid = 2u;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Frame { RangeFrame value; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer Bounds { BoundBlock block[]; };
layout(push_constant, scalar) uniform Push { RangePush push; };

// Stratified numbers are stratified within each interleaving subset: light_range_kernel.cpp says why.
uint light_bits(RangeFrame f, uint key, uint dimension) {
  const uint subset = key % f.subsets;
  return f.stratified != 0u ? stratified_bits(key / f.subsets, f.stratum_shift + subset * 0x9e3779b9u)
                            : random_words(f.seed, f.frame, key, dimension).first;
}
float xi_of(RangeFrame f, uint bits) { return f.constant_xi >= 0.0 ? f.constant_xi : unit_real(bits); }

// Largest channel of the photon's flux in display units, over delta.
float peak_over_delta(RangeFrame f, vec3 rgb) { return largest_channel(rgb) * f.exposure_over_delta; }
float disc_of(RangeFrame f, float area) { return f.disc != 0u ? near_field_distance_sq(0.0, area) : 0.0; }

ViewFrame view_frame(RangeFrame f) {
  return ViewFrame(vector(f.eye), vector(f.right), vector(f.up), vector(f.forward));
}

void store_row(uint entry, int row, float value) { Bounds(push.bounds).block[entry / 16u].row[row][entry % 16u] = value; }
void store_rows(uint entry, int row, vec3 value) {
  store_row(entry, row, value.x);
  store_row(entry, row + 1, value.y);
  store_row(entry, row + 2, value.z);
}

void store_paper_rows(uint entry, ViewFrame view, BoundingEllipsoid e) {
  const PaperTestEllipsoid t = prepare_ellipsoid_as_paper(view, e);
  store_rows(entry, kPaper, t.row_x);
  store_rows(entry, kPaper + 3, t.row_y);
  store_rows(entry, kPaper + 6, t.row_z);
  store_rows(entry, kPaper + 9, t.stretched);
}

void store_test_rows(uint entry, TileTestEllipsoid t) {
  store_rows(entry, kM00, vec3(t.factor.m00, t.factor.m01, t.factor.m02));
  store_rows(entry, kM11, vec3(t.factor.m11, t.factor.m12, t.factor.m22));
  store_rows(entry, kStretchedX, t.stretched);
  store_rows(entry, kNormalX, t.surface.normal);
  store_row(entry, kNormalOffset, t.surface.offset - 1e-30);  // a light at the eye without a plane must pass
  store_rows(entry, kSxx, vec3(t.sxx, t.sxz, t.syy));
  store_row(entry, kSyz, t.syz);
  store_row(entry, kSzz, t.szz);
}

void store_no_bound(uint entry) { store_row(entry, kRadius, -1.0); }

void store_bound(RangeFrame f, uint entry, BoundingEllipsoid unlimited, vec3 position, vec3 normal) {
  const ViewFrame view = view_frame(f);
  const BoundingEllipsoid e = bound_within_float(unlimited, position);
  const vec3 centre = view_from_world(view, e.centre);
  store_rows(entry, kCentreX, centre);
  store_row(entry, kRadius, max(max(e.r_u, e.r_v), e.r_w) * 1.0001 + 4e-6 * length(centre));
  if (kPaperRows != 0u) {
    store_paper_rows(entry, view, e);
  } else {
    store_test_rows(entry, prepare_ellipsoid(view, e, surface_plane(view, position, normal)));
  }
}
