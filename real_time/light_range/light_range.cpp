// SPDX-License-Identifier: Apache-2.0
#include "real_time/light_range/light_range.h"

#include <algorithm>

#include "base/fold_seed.h"
#include "base/isa.h"
#include "base/parallel.h"
#include "equations/cpp/float.h"

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

// Lights by subset, in their order within each. The subset is that of the key, never of the place in a compacted list:
// a light that is lost elsewhere must not move all others to other pixels.
std::vector<std::vector<std::uint32_t>> lights_by_subset(const AlignedVector<std::uint32_t>& key,
                                                         std::uint32_t subsets) {
  std::vector<std::vector<std::uint32_t>> lists(subsets);
  for (std::vector<std::uint32_t>& list : lists) list.reserve(key.size() / subsets + 1);
  for (std::uint32_t i = 0; i < key.size(); ++i) lists[key[i] % subsets].push_back(i);
  return lists;
}

// Lays out the subsets, then lets fill(piece, emitters, bounds) write 16 entries at a time, on all threads.
template <class Emitter, class Fill>
ReachingLights<Emitter> by_subset(const AlignedVector<std::uint32_t>& key, std::uint32_t interleave, const Fill& fill) {
  const std::uint32_t subsets = interleave * interleave;
  const std::vector<std::vector<std::uint32_t>> lists = lights_by_subset(key, subsets);
  ReachingLights<Emitter> out;
  std::vector<SubsetPiece> pieces;
  std::vector<std::uint32_t> entry_of_piece;
  std::uint32_t entries = 0;
  for (std::uint32_t s = 0; s < subsets; ++s) {
    const auto count = static_cast<std::uint32_t>(lists[s].size());
    out.begin.push_back(entries);
    out.count.push_back(count);
    for (std::uint32_t offset = 0; offset < count; offset += 16) {
      pieces.push_back({lists[s].data() + offset, std::min(16u, count - offset), s, subsets});
      entry_of_piece.push_back(entries + offset);
    }
    entries += (count + 15) / 16 * 16;
  }
  out.emitters.resize(entries);
  out.bounds.resize(entries / 16);
  parallel_for(pieces.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      fill(pieces[i], &out.emitters[entry_of_piece[i]], out.bounds[entry_of_piece[i] / 16]);
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
