// SPDX-License-Identifier: Apache-2.0
#include "real_time/light_range/light_range_kernel.h"

#include "equations/cpp/wide.h"

namespace luciole::LUCIOLE_ISA {
#include "equations/cpp/wide_lists.inc"
namespace {

constexpr std::uint32_t kDimensionVpl = 0, kDimensionMany = 1;

// Which lights of the planes stand in the lanes; lanes past the last repeat it.
struct Lanes {
  alignas(64) std::uint32_t index[16];
};

LUCIOLE_FN Lanes lanes_of(const SubsetPiece& piece, std::uint32_t lane) {
  Lanes lanes;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(kLanes); ++i) {
    lanes.index[i] = piece.lights[lane + i < piece.count ? lane + i : piece.count - 1];
  }
  return lanes;
}

LUCIOLE_FN real gather1(const float* plane, const Lanes& lanes) { return gather(plane, lanes.index); }
LUCIOLE_FN real3 gather3(const float* const (&planes)[3], const Lanes& lanes) {
  return real3(gather1(planes[0], lanes), gather1(planes[1], lanes), gather1(planes[2], lanes));
}
LUCIOLE_FN real3 broadcast3(const float (&v)[3]) { return real3(real(v[0]), real(v[1]), real(v[2])); }

// Random bits of each lane's light. Stratified ones are stratified within each interleaving subset, as a pixel sees
// only one: neighbours along the curve of keys belong to different subsets, so the subset's part of the key is dropped,
// and each subset gets a shift of its own.
LUCIOLE_FN uint_ light_bits(const RangeParameters& p, const std::uint32_t* key, const Lanes& lanes,
                            const SubsetPiece& piece, std::uint32_t dimension) {
  alignas(64) std::uint32_t keys[16];
  for (int i = 0; i < kLanes; ++i) keys[i] = p.stratified ? key[lanes.index[i]] / piece.subsets : key[lanes.index[i]];
  if (p.stratified) return stratified_bits(load(keys), uint_(p.stratum_shift + piece.subset * 0x9e3779b9u));
  return random_words(uint_(p.seed), uint_(p.frame), load(keys), uint_(dimension)).first;
}

LUCIOLE_FN real xi_of(const RangeParameters& p, uint_ bits) {
  return p.constant_xi >= 0.0f ? real(p.constant_xi) : unit_real(bits);
}

LUCIOLE_FN ViewFrame view_frame(const RangeParameters& p) {
  ViewFrame view;
  view.eye = broadcast3(p.eye);
  view.right = broadcast3(p.right);
  view.up = broadcast3(p.up);
  view.forward = broadcast3(p.forward);
  return view;
}

LUCIOLE_FN void store_row(BoundBlock& block, int row, int lane, real value) { store(block.row[row] + lane, value); }
LUCIOLE_FN void store_rows(BoundBlock& block, int row, int lane, real3 value) {
  store_row(block, row, lane, value.x), store_row(block, row + 1, lane, value.y),
      store_row(block, row + 2, lane, value.z);
}

LUCIOLE_FN void store_paper_rows(const ViewFrame& view, BoundingEllipsoid e, BoundBlock& block, int lane) {
  const PaperTestEllipsoid t = prepare_ellipsoid_as_paper(view, e);
  store_rows(block, BoundBlock::kPaper, lane, t.row_x), store_rows(block, BoundBlock::kPaper + 3, lane, t.row_y);
  store_rows(block, BoundBlock::kPaper + 6, lane, t.row_z),
      store_rows(block, BoundBlock::kPaper + 9, lane, t.stretched);
}

LUCIOLE_FN void store_test_rows(const TileTestEllipsoid& t, BoundBlock& block, int lane) {
  store_rows(block, BoundBlock::kM00, lane, real3(t.factor.m00, t.factor.m01, t.factor.m02));
  store_rows(block, BoundBlock::kM11, lane, real3(t.factor.m11, t.factor.m12, t.factor.m22));
  store_rows(block, BoundBlock::kStretchedX, lane, t.stretched);
  store_rows(block, BoundBlock::kNormalX, lane, t.surface.normal);
  // A light at the eye without a plane has offset 0, and must pass.
  store_row(block, BoundBlock::kNormalOffset, lane, t.surface.offset - 1e-30f);
  store_rows(block, BoundBlock::kSxx, lane, real3(t.sxx, t.sxz, t.syy));
  store_row(block, BoundBlock::kSyz, lane, t.syz), store_row(block, BoundBlock::kSzz, lane, t.szz);
}

LUCIOLE_FN void store_bound(const RangeParameters& p, const ViewFrame& view, BoundingEllipsoid unlimited,
                            real3 position, real3 normal, mask reaches, BoundBlock& block, int lane) {
  const BoundingEllipsoid e = bound_within_float(unlimited, position);
  const real3 centre = view_from_world(view, e.centre);
  const real radius = max(max(e.r_u, e.r_v), e.r_w) * 1.0001f + 4e-6f * length(centre);
  store_rows(block, BoundBlock::kCentreX, lane, centre);
  store_row(block, BoundBlock::kRadius, lane, select(reaches, radius, real(-1.0f)));
  if (p.paper_rows) return store_paper_rows(view, e, block, lane);
  store_test_rows(prepare_ellipsoid(view, e, surface_plane(view, position, normal)), block, lane);
}

// One value per lane, to be written into structures one light at a time.
struct Column {
  alignas(64) float lane[16];
  LUCIOLE_FN explicit Column(real value) { store(lane, value); }
};
struct Column3 {
  Column x, y, z;
  LUCIOLE_FN explicit Column3(real3 value) : x(value.x), y(value.y), z(value.z) {}
  LUCIOLE_FN void put(int lane, float (&to)[3]) const {
    to[0] = x.lane[lane], to[1] = y.lane[lane], to[2] = z.lane[lane];
  }
};

LUCIOLE_FN real disc_of(const RangeParameters& p, real area) {
  return p.disc ? near_field_distance_sq(real(0.0f), area) : real(0.0f);
}

// Largest channel of the photon's flux in display units, over delta.
LUCIOLE_FN real peak_over_delta(const RangeParameters& p, real3 rgb) {
  return largest_channel(rgb) * p.exposure_over_delta;
}

// How many lanes from `lane` on hold one of `count` lights.
LUCIOLE_FN int lanes_in_use(int lane, std::uint32_t count) {
  const int left = static_cast<int>(count) - lane;
  return left < 0 ? 0 : left < kLanes ? left : kLanes;
}

LUCIOLE_FN BoundingEllipsoid diffuse_bound(const RangeParameters& p, real3 position, real3 normal, real reach_flux) {
  const real reach = diffuse_reach(reach_flux);
  return ellipsoid_of(p.bounds == BoundingVolume::sphere_at_light ? sphere_at_light(position, reach)
                                                                  : diffuse_bounding_sphere(position, normal, reach));
}

LUCIOLE_FN BoundingEllipsoid glossy_bound(const RangeParameters& p, GlossyLobe lobe, real3 flux, real3 f0, real f90,
                                          real xi) {
  const real flux_per_threshold = peak_over_delta(p, flux) / xi;
  const real f0_bound = bounding_f0(flux, f0);
  const real size = lobe_size(lobe, f0_bound, f90, flux_per_threshold);
  switch (p.bounds) {
    case BoundingVolume::sphere_at_light:
      return ellipsoid_of(sphere_at_light(lobe.position, glossy_reach(lobe, size)));
    case BoundingVolume::sphere:
      return ellipsoid_of(sphere_around(bounding_spheroid(lobe, size)));
    case BoundingVolume::spheroid:
      return bounding_spheroid(lobe, size);
    default:
      return tight_ellipsoid(lobe, f0_bound, f90, flux_per_threshold);
  }
}

}  // namespace

void reach_diffuse(const VplPlanes& lights, const RangeParameters& p, const SubsetPiece& piece,
                   DiffuseEmitter* emitters, BoundBlock& bounds) {
  const ViewFrame view = view_frame(p);
  for (int lane = 0; lane < 16; lane += kLanes) {
    const Lanes lanes = lanes_of(piece, static_cast<std::uint32_t>(lane));
    const real3 position = gather3(lights.position, lanes), normal = gather3(lights.normal, lanes);
    const real3 geometric_normal = gather3(lights.geometric_normal, lanes), incident = gather3(lights.incident, lanes);
    const real3 intensity = gather3(lights.flux, lanes) * gather3(lights.diffuse_albedo, lanes);
    const real f0_max = largest_channel(gather3(lights.f0, lanes)), f90 = gather1(lights.f90, lanes);
    const real xi = xi_of(p, light_bits(p, lights.key, lanes, piece, kDimensionVpl));
    const real scale = peak_over_delta(p, intensity);
    const mask reaches = first_lanes(static_cast<std::uint32_t>(lanes_in_use(lane, piece.count))) && scale > 0.0f;
    store_bound(p, view, diffuse_bound(p, position, normal, diffuse_peak_flux(scale, f0_max, f90) / xi), position,
                geometric_normal, reaches, bounds, lane);
    const Column3 c_position(position), c_normal(normal), c_geometric(geometric_normal), c_incident(incident);
    const Column3 c_intensity(intensity);
    const Column c_scale(scale), c_xi(xi), c_f0(f0_max), c_f90(f90), c_disc(disc_of(p, gather1(lights.area, lanes)));
    for (int i = 0; i < lanes_in_use(lane, piece.count); ++i) {
      DiffuseEmitter& e = emitters[lane + i];
      c_position.put(i, e.position), c_normal.put(i, e.normal), c_geometric.put(i, e.geometric_normal);
      c_incident.put(i, e.incident), c_intensity.put(i, e.intensity);
      e.probability_scale = c_scale.lane[i], e.xi = c_xi.lane[i], e.disc = c_disc.lane[i];
      e.f0_max = c_f0.lane[i], e.f90 = c_f90.lane[i];
    }
  }
}

void reach_glossy(const VplPlanes& lights, const RangeParameters& p, const SubsetPiece& piece, GlossyEmitter* emitters,
                  BoundBlock& bounds) {
  const ViewFrame view = view_frame(p);
  for (int lane = 0; lane < 16; lane += kLanes) {
    const Lanes lanes = lanes_of(piece, static_cast<std::uint32_t>(lane));
    const real3 position = gather3(lights.position, lanes), normal = gather3(lights.normal, lanes);
    const real3 geometric_normal = gather3(lights.geometric_normal, lanes), incident = gather3(lights.incident, lanes);
    const real3 flux = gather3(lights.flux, lanes), f0 = gather3(lights.f0, lanes);
    const real f90 = gather1(lights.f90, lanes), alpha = gather1(lights.ggx_alpha, lanes);
    // The second lobe takes the complement of the first one's bits: xi = 1 - xi, the least variance of the sum.
    const real xi = xi_of(p, complement_bits(light_bits(p, lights.key, lanes, piece, kDimensionVpl)));
    const GlossyLobe lobe = glossy_lobe(position, normal, incident, alpha);
    const mask reaches = first_lanes(static_cast<std::uint32_t>(lanes_in_use(lane, piece.count))) &&
                         largest_channel(flux) * max(largest_channel(f0), f90) > 0.0f;
    store_bound(p, view, glossy_bound(p, lobe, flux, f0, f90, xi), position, geometric_normal, reaches, bounds, lane);
    SurfaceBrdf surface;
    surface.f0 = f0, surface.f90 = f90, surface.ggx_alpha = alpha;
    const FixedDirectionBrdf fixed = fix_direction(surface, normal, incident);
    const Column3 c_position(position), c_normal(normal), c_geometric(geometric_normal), c_incident(incident);
    const Column3 c_flux(flux), c_f0(f0);
    const Column c_xi(xi), c_f90(f90), c_alpha_sq(fixed.alpha_sq), c_cos(fixed.cos_fixed), c_masking(fixed.masking);
    const Column c_disc(disc_of(p, gather1(lights.area, lanes)));
    for (int i = 0; i < lanes_in_use(lane, piece.count); ++i) {
      GlossyEmitter& e = emitters[lane + i];
      c_position.put(i, e.position), c_normal.put(i, e.normal), c_geometric.put(i, e.geometric_normal);
      c_incident.put(i, e.incident), c_flux.put(i, e.flux), c_f0.put(i, e.f0);
      e.probability_scale = p.exposure_over_delta, e.xi = c_xi.lane[i], e.disc = c_disc.lane[i];
      e.f90 = c_f90.lane[i], e.alpha_sq = c_alpha_sq.lane[i], e.cos_incident = c_cos.lane[i];
      e.masking = c_masking.lane[i];
    }
  }
}

void reach_many(const ManyPlanes& lights, const RangeParameters& p, const SubsetPiece& piece, ManyEmitter* emitters,
                BoundBlock& bounds) {
  const ViewFrame view = view_frame(p);
  for (int lane = 0; lane < 16; lane += kLanes) {
    const Lanes lanes = lanes_of(piece, static_cast<std::uint32_t>(lane));
    const real3 position = gather3(lights.position, lanes), axis = gather3(lights.axis, lanes);
    const real3 intensity = gather3(lights.intensity, lanes);
    const real scale = gather1(lights.scale, lanes), offset = gather1(lights.offset, lanes);
    const real two_sided = gather1(lights.two_sided, lanes), squared = gather1(lights.squared, lanes);
    const real xi = xi_of(p, light_bits(p, lights.key, lanes, piece, kDimensionMany));
    const real peak = peak_over_delta(p, intensity);
    const real reach = sqrt(peak / xi);
    const mask reaches = first_lanes(static_cast<std::uint32_t>(lanes_in_use(lane, piece.count))) && peak > 0.0f;
    // One-sided emitters are Lambert lobes; others shine as far in all directions that they shine in.
    const mask lambert = scale > 0.0f && offset >= 0.0f && two_sided <= 0.0f;
    const mask one_sided = scale > 0.0f && offset <= 0.0f && two_sided <= 0.0f;
    const BoundingSphere tight = diffuse_bounding_sphere(position, axis, reach);
    BoundingSphere sphere = sphere_at_light(position, reach);
    if (p.bounds != BoundingVolume::sphere_at_light) {
      sphere.centre = select(lambert, tight.centre, sphere.centre);
      sphere.radius = select(lambert, tight.radius, sphere.radius);
    }
    const real3 plane = select(one_sided, axis, real3(0.0f, 0.0f, 0.0f));
    store_bound(p, view, ellipsoid_of(sphere), position, plane, reaches, bounds, lane);
    const Column3 c_position(position), c_axis(axis), c_intensity(intensity);
    const Column c_peak(peak), c_xi(xi), c_scale(scale), c_offset(offset), c_two(two_sided), c_squared(squared);
    const Column c_disc(disc_of(p, gather1(lights.area, lanes)));
    for (int i = 0; i < lanes_in_use(lane, piece.count); ++i) {
      ManyEmitter& e = emitters[lane + i];
      c_position.put(i, e.position), c_axis.put(i, e.axis), c_intensity.put(i, e.intensity);
      e.probability_scale = c_peak.lane[i], e.xi = c_xi.lane[i], e.disc = c_disc.lane[i];
      e.scale = c_scale.lane[i], e.offset = c_offset.lane[i];
      e.two_sided = c_two.lane[i], e.squared = c_squared.lane[i];
    }
  }
}

}  // namespace luciole::LUCIOLE_ISA
