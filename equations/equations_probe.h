// SPDX-License-Identifier: Apache-2.0
// One call through every equation, from a few numbers: what the instantiations (scalar, wide, shader) are compared by.
#ifndef LUCIOLE_EQUATIONS_PROBE_H
#define LUCIOLE_EQUATIONS_PROBE_H
#include "equations/depth_mask.h"
#include "equations/exact_tile_test.h"
#include "equations/interleaving.h"
#include "equations/paper_tile_test.h"
#include "equations/random_number.h"
#include "equations/shading_normal.h"
#include "equations/stochastic_range.h"
#include "equations/texture_level_of_detail.h"
#include "equations/tight_bound.h"

struct ProbeInput {
  real3 incident;  // w_i, unit, above n = +z
  real3 outgoing;  // w_o, unit
  real ggx_alpha;
  real f0;
  uint_ index;  // of the light
};

struct ProbeOutput {
  real xi;
  real stratified_xi;
  real specular;  // along w_o
  real diffuse;
  real probability;  // of acceptance at distance 2
  real range_sq;
  real spheroid_r_u;
  real fitted_r_w;
  real tight_r_u;
  real tight_r_w;
  real box_distance_sq;  // of a tile
  real exact_distance_sq;
  real touches;  // bits: ours, paper's, exact, sphere, depth mask
  real level_of_detail;
  real shading_normal;  // along a direction
};

LUCIOLE_FN Tile probe_tile() {
  Tile tile;
  tile.x_low = -0.1f;
  tile.x_high = 0.15f;
  tile.y_low = -0.2f;
  tile.y_high = 0.1f;
  tile.near_low = 3.0f;
  tile.near_high = 4.0f;
  tile.far_low = 6.0f;
  tile.far_high = 7.0f;
  return tile;
}

LUCIOLE_FN ViewFrame probe_view() {
  ViewFrame view;
  view.eye = real3(0.0f, 0.0f, 4.0f);
  view.right = real3(1.0f, 0.0f, 0.0f);
  view.up = real3(0.0f, -1.0f, 0.0f);
  view.forward = real3(0.0f, 0.0f, -1.0f);
  return view;
}

// The tile tests of a tight ellipsoid and of the sphere around it.
LUCIOLE_FN ProbeOutput probe_tile_tests(ProbeOutput result, BoundingEllipsoid e) {
  const ViewFrame view = probe_view();
  const Tile tile = probe_tile();
  const SurfacePlane surface = surface_plane(view, real3(0.0f, 0.0f, 0.0f), real3(0.0f, 0.0f, 1.0f));
  const TileTestEllipsoid t = prepare_ellipsoid(view, e, surface);
  const HalfMasks ours = ellipsoid_touches_tile(t, tile);
  const HalfMasks as_paper = touches_tile_as_paper(prepare_ellipsoid_as_paper(view, e), tile);
  const HalfMasks exact = ellipsoid_touches_tile_exactly(t, tile);
  const HalfMasks sphere = sphere_touches_tile(prepare_sphere(view, sphere_around(e), surface), tile);
  const DepthSlices slices = depth_slices(3.0f, 7.0f);
  const mask meets = ellipsoid_meets_depths(t, slices, surface_depth_mask(slices, 3.3f));
  const StretchedSlopes slopes = stretched_slopes(t.factor, tile);
  result.box_distance_sq = stretched_distance_sq(t.stretched, t.factor.m22, slopes, tile.near_low, tile.near_high);
  result.exact_distance_sq = exact_distance_sq(t, tile, tile.near_low, tile.near_high);
  const real zero = 0.0f;
  result.touches = select(ours.near_half, real(1.0f), zero) + select(as_paper.near_half, real(2.0f), zero) +
                   select(exact.near_half, real(4.0f), zero) + select(sphere.near_half, real(8.0f), zero) +
                   select(meets, real(16.0f), zero) + select(ours.far_half, real(32.0f), zero);
  return result;
}

LUCIOLE_FN real probe_shading_normal(ProbeInput i) {
  const real3 normal = real3(0.0f, 0.0f, 1.0f);
  const real3 bent = mapped_normal(normal, i.outgoing, -1.0f, real3(i.f0, i.ggx_alpha, 0.9f), 0.2f);
  return dot(kept_visible(bent, normal, i.incident), real3(0.3f, 0.4f, 2.0f));
}

LUCIOLE_FN ProbeOutput probe_equations(ProbeInput i) {
  ProbeOutput result;
  const uint_ bits = random_words(1u, 2u, i.index, 0u).first;
  result.xi = unit_real(bits);
  result.stratified_xi = unit_real(complement_bits(stratified_bits(morton_code(i.index, 3u, 5u), 77u)));
  SurfaceBrdf brdf =
      metallic_roughness_brdf(real3(i.f0, i.f0, i.f0), 1.0f, real3(0.04f, 0.04f, 0.04f), 1.0f, i.ggx_alpha);
  const real3 normal = real3(0.0f, 0.0f, 1.0f);
  const Reflection r = reflection(fix_direction(brdf, normal, i.incident), i.outgoing);
  result.specular = r.specular.x;
  result.diffuse = r.diffuse;
  const real delta = delta_of_error(0.001f);
  result.probability = acceptance_probability(0.02f * r.specular.x, delta, 4.0f);
  result.range_sq = directional_range_sq(r.specular.x, delta, result.xi);
  const GlossyLobe lobe = glossy_lobe(real3(0.0f, 0.0f, 0.0f), normal, i.incident, i.ggx_alpha);
  const real threshold = flux_over_threshold(0.02f, delta, 0.5f);
  const real size = lobe_size(lobe, i.f0, 1.0f, threshold);
  result.spheroid_r_u = bounding_spheroid(lobe, size).r_u;
  result.fitted_r_w = fitted_ellipsoid(lobe, size).r_w;
  const BoundingEllipsoid tight = tight_ellipsoid(lobe, i.f0, 1.0f, threshold);
  result.tight_r_u = tight.r_u;
  result.tight_r_w = tight.r_w;
  result.level_of_detail = texture_level_of_detail(1.0f, 65536.0f, i.ggx_alpha, abs(i.outgoing.z));
  result.shading_normal = probe_shading_normal(i);
  return probe_tile_tests(result, tight);
}

#endif
