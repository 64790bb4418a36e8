// SPDX-License-Identifier: Apache-2.0
// Surfaces on the device are those of evaluate_surface, over random triangles, materials and textures with every
// combination of what they may have.
#include "real_time/device_scene/device_scene_probe.h"
#include "scene/random_surfaces.h"
#include "scene/surface.h"

namespace luciole::test {
namespace {

std::vector<SurfaceQuery> random_queries(Dice& dice, const Scene& scene) {
  std::vector<SurfaceQuery> queries;
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    for (int i = 0; i < 64; ++i) {
      const float a = std::sqrt(dice.unit()), b = dice.unit();
      const Vec3 direction = dice.direction();
      queries.push_back({mesh,
                         dice.below(kRandomTriangles),
                         a * (1 - b),
                         a * b,
                         {direction.x, direction.y, direction.z},
                         dice.below(8) == 0 ? 0.0f : std::exp2(dice.within(-12, 2))});
    }
  }
  return queries;
}

SurfacePoint expected_of(const Scene& scene, const SurfaceQuery& q, float cone_scale) {
  return evaluate_surface(scene, {q.mesh, q.triangle, q.u, q.v}, Vec3(q.direction[0], q.direction[1], q.direction[2]),
                          q.cone_width * cone_scale);
}

// Largest difference of any answer to evaluate_surface.
float difference(const SurfacePoint& point, const SurfaceAnswer& found) {
  float largest = 0;
  // Not-a-number counts as far apart.
  const auto apart = [&](float a, float b) {
    const float by = std::abs(a - b);
    largest = by <= largest ? largest : std::isnan(by) ? 9e9f : by;
  };
  const auto compare = [&](Vec3 expected, const float(&answer)[3]) {
    apart(expected.x, answer[0]), apart(expected.y, answer[1]), apart(expected.z, answer[2]);
  };
  compare(point.position, found.position);
  compare(point.geometric_normal, found.geometric_normal);
  compare(point.shading_normal, found.shading_normal);
  compare(point.diffuse_albedo, found.diffuse_albedo);
  compare(point.f0, found.f0);
  compare(point.emission, found.emission);
  apart(point.f90, found.f90), apart(point.ggx_alpha, found.ggx_alpha);
  return largest;
}

struct Agreement {
  float largest = 0;     // difference of any surface
  double agreeing = 0;   // share of surfaces within kRounding
  double same_side = 0;  // share of those that stop rays alike
};

// As in scene/surface_kernel_test.cpp: a coordinate of size 10 in an image of 40 texels carries roundings of
// 10 * 2^-24 * 40 texels, and neighbouring texels may be black and white; a few of them.
constexpr float kRounding = 2e-4f;

Scene scene_with_masks(Dice& dice, bool smooth) {
  Scene scene = random_scene(dice, smooth);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    scene.materials[i].alpha_mode = static_cast<AlphaMode>(i % 3);
    scene.materials[i].alpha_cutoff = dice.unit();
    scene.materials[i].base_colour.w = dice.within(0.5f, 1);
  }
  for (Mesh& mesh : scene.meshes) {
    for (Vec4& colour : mesh.colours) colour.w = dice.unit();
  }
  return scene;
}

Agreement agreement(Probe& probe, bool smooth, float cone_scale) {
  Dice dice(smooth ? 15u : 16u);
  const Scene scene = scene_with_masks(dice, smooth);
  const std::vector<SurfaceQuery> queries = random_queries(dice, scene);
  const std::vector<SurfaceAnswer> answers = probe.evaluate(probe.place(scene, Hierarchy{}), queries);
  Agreement found;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const SurfaceQuery& q = queries[i];
    const float apart = difference(expected_of(scene, q, cone_scale), answers[i]);
    found.largest = std::max(found.largest, apart);
    found.agreeing += apart < kRounding;
    found.same_side += alpha_passes(scene, {q.mesh, q.triangle, q.u, q.v}) == (answers[i].stops_ray != 0);
  }
  found.agreeing /= double(queries.size()), found.same_side /= double(queries.size());
  return found;
}

TEST(SurfaceOnTheDevice, agrees_with_evaluate_surface) {
  Probe probe;
  const Agreement smooth = agreement(probe, true, 1);
  EXPECT_LT(smooth.largest, kRounding);
  EXPECT_GT(smooth.same_side, 0.9995);  // alpha may lie within a rounding of the cutoff
  const Agreement any = agreement(probe, false, 1);
  EXPECT_GT(any.agreeing, 0.9995);  // a rounding may choose the next texel
  EXPECT_GT(any.same_side, 0.9995);
  EXPECT_LT(agreement(probe, true, 1.01f).agreeing, 0.9);  // the control: one per cent off is noticed
  std::printf("largest difference of smooth surfaces %.2g; of any, %.5f agree\n", double(smooth.largest), any.agreeing);
}

// Triangles without area, and coordinates that are not numbers, give finite surfaces.
TEST(SurfaceOnTheDevice, survives_what_is_not_a_surface) {
  Dice dice(7);
  const Scene scene = broken_scene(dice);
  std::vector<SurfaceQuery> queries = random_queries(dice, scene);
  for (SurfaceQuery& query : queries) query.triangle %= 2;
  Probe probe;
  for (const SurfaceAnswer& a : probe.evaluate(probe.place(scene, Hierarchy{}), queries)) {
    EXPECT_NEAR(length(Vec3(a.shading_normal[0], a.shading_normal[1], a.shading_normal[2])), 1, 1e-5f);
    EXPECT_TRUE(a.ggx_alpha >= kLeastGgxAlpha && a.ggx_alpha <= 1);
    EXPECT_TRUE(a.diffuse_albedo[0] >= 0 && a.diffuse_albedo[0] <= 1);
  }
}

}  // namespace
}  // namespace luciole::test
