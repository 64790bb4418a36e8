// SPDX-License-Identifier: Apache-2.0
#include "real_time/light_range/light_range.h"

#include <algorithm>

#include "base/fold_seed.h"
#include "base/isa.h"
#include "base/parallel.h"
#include "equations/cpp/float.h"
#include "real_time/light_range/subset_layout.h"

namespace luciole {
namespace {

constexpr std::uint32_t kDimensionSubset = 2, kDimensionStratum = 3;

std::uint32_t frame_bits(const FrameKey& key, std::uint32_t dimension) {
  return f32::random_words(folded(key.seed), folded(key.frame_index), 0u, dimension).first;
}

void copy(Vec3 from, float (&to)[3]) { to[0] = from.x, to[1] = from.y, to[2] = from.z; }

void point_to(const float* (&to)[3], const Plane3& from) {
  for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis].data();
}

// Lays out the subsets, then lets fill(piece, emitters, bounds) write 16 entries at a time, on all threads.
template <class Emitter, class Fill>
ReachingLights<Emitter> by_subset(const AlignedVector<std::uint32_t>& key, std::uint32_t interleave, const Fill& fill) {
  const SubsetLayout layout = subset_layout(key, interleave);
  ReachingLights<Emitter> out;
  std::vector<SubsetPiece> pieces;
  for (std::uint32_t s = 0; s < layout.begin.size(); ++s) {
    for (std::uint32_t offset = 0; offset < layout.count[s]; offset += 16) {
      pieces.push_back({layout.light.data() + layout.begin[s] + offset, std::min(16u, layout.count[s] - offset), s,
                        interleave * interleave});
    }
  }
  out.begin = layout.begin, out.count = layout.count;
  out.emitters.resize(layout.light.size());
  out.bounds.resize(layout.light.size() / 16);
  parallel_for(pieces.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::ptrdiff_t entry = pieces[i].lights - layout.light.data();
      fill(pieces[i], out.emitters.data() + entry, out.bounds.data()[entry / 16]);
    }
  });
  return out;
}

VplPlanes planes_of(const VirtualPointLights& lights) {
  VplPlanes planes;
  point_to(planes.position, lights.position);
  point_to(planes.normal, lights.normal);
  point_to(planes.geometric_normal, lights.geometric_normal);
  point_to(planes.incident, lights.incident);
  point_to(planes.flux, lights.flux);
  point_to(planes.diffuse_albedo, lights.diffuse_albedo);
  point_to(planes.f0, lights.f0);
  planes.f90 = lights.f90.data();
  planes.ggx_alpha = lights.ggx_alpha.data();
  planes.area = lights.area.data();
  planes.key = lights.key.data();
  return planes;
}

ManyPlanes planes_of(const ManyLights& lights) {
  ManyPlanes planes;
  point_to(planes.position, lights.position);
  point_to(planes.axis, lights.axis);
  point_to(planes.intensity, lights.intensity);
  planes.scale = lights.scale.data();
  planes.offset = lights.offset.data();
  planes.two_sided = lights.two_sided.data();
  planes.squared = lights.squared.data();
  planes.area = lights.area.data();
  planes.key = lights.key.data();
  return planes;
}

}  // namespace

std::uint32_t subset_shift(const FrameKey& key, std::uint32_t interleave) {
  return frame_bits(key, kDimensionSubset) % (interleave * interleave);  // n^2 is a power of two: exactly uniform
}

RangeParameters range_parameters(const Settings& settings, const Camera& camera, const FrameKey& key,
                                 float constant_xi) {
  RangeParameters p{};
  p.exposure_over_delta = settings.exposure / settings.delta;
  p.seed = folded(key.seed);
  p.frame = folded(key.frame_index);
  p.constant_xi = constant_xi;
  p.stratified = settings.stratified_ranges;
  p.stratum_shift = frame_bits(key, kDimensionStratum);
  p.disc = settings.near_field == NearField::disc;
  p.bounds = settings.bounds;
  p.paper_rows = settings.culling == Culling::tiled && settings.tile_test == TileTest::paper;
  copy(camera.eye, p.eye), copy(camera.right, p.right), copy(camera.up, p.up), copy(camera.forward, p.forward);
  return p;
}

ReachingLights<DiffuseEmitter> reach_diffuse_lobes(const VirtualPointLights& lights, const RangeParameters& parameters,
                                                   std::uint32_t interleave, Isa isa) {
  const VplPlanes planes = planes_of(lights);
  return by_subset<DiffuseEmitter>(lights.key, interleave,
                                   [&](const SubsetPiece& piece, DiffuseEmitter* emitters, BoundBlock& bounds) {
                                     LUCIOLE_FOR_ISA(isa, reach_diffuse(planes, parameters, piece, emitters, bounds));
                                   });
}

ReachingLights<GlossyEmitter> reach_glossy_lobes(const VirtualPointLights& lights, const RangeParameters& parameters,
                                                 std::uint32_t interleave, Isa isa) {
  const VplPlanes planes = planes_of(lights);
  return by_subset<GlossyEmitter>(lights.key, interleave,
                                  [&](const SubsetPiece& piece, GlossyEmitter* emitters, BoundBlock& bounds) {
                                    LUCIOLE_FOR_ISA(isa, reach_glossy(planes, parameters, piece, emitters, bounds));
                                  });
}

ReachingLights<ManyEmitter> reach_many_lights(const ManyLights& lights, const RangeParameters& parameters,
                                              std::uint32_t interleave, Isa isa) {
  const ManyPlanes planes = planes_of(lights);
  return by_subset<ManyEmitter>(lights.key, interleave,
                                [&](const SubsetPiece& piece, ManyEmitter* emitters, BoundBlock& bounds) {
                                  LUCIOLE_FOR_ISA(isa, reach_many(planes, parameters, piece, emitters, bounds));
                                });
}

}  // namespace luciole
