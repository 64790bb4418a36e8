// SPDX-License-Identifier: Apache-2.0
// The surface kernels of every instruction set against evaluate_surface, over random triangles, materials and textures
// with every combination of what they may have.
#include "scene/surface_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "equations/cpp/instruction_set.h"
#include "scene/make_surface_tables.h"
#include "scene/random_surfaces.h"
#include "scene/surface.h"

namespace luciole::test {
namespace {

using Kernel = void (*)(const SurfaceMesh&, const SurfaceQueries&, SurfaceAnswers&);

SurfaceQueries random_queries(Dice& dice) {
  SurfaceQueries queries;
  for (int i = 0; i < kSurfaceLanes; ++i) {
    queries.triangle[i] = dice.below(kRandomTriangles);
    const float a = std::sqrt(dice.unit()), b = dice.unit();
    queries.u[i] = a * (1 - b), queries.v[i] = a * b;
    const Vec3 direction = dice.direction() * dice.within(0.5f, 3);
    queries.ray_direction[0][i] = direction.x, queries.ray_direction[1][i] = direction.y;
    queries.ray_direction[2][i] = direction.z;
    queries.cone_width[i] = dice.below(8) == 0 ? 0.0f : std::exp2(dice.within(-12, 2));
  }
  return queries;
}

// Largest difference of any answer of one lane to evaluate_surface, `cone_scale` times as far away.
float difference(const Scene& scene, std::uint32_t mesh, const SurfaceQueries& in, const SurfaceAnswers& out, int i,
                 float cone_scale) {
  const Vec3 direction(in.ray_direction[0][i], in.ray_direction[1][i], in.ray_direction[2][i]);
  const SurfacePoint point = evaluate_surface(scene, {mesh, in.triangle[i], in.u[i], in.v[i]}, normalize(direction),
                                              in.cone_width[i] * cone_scale);
  float largest = std::max(std::abs(point.f90 - out.f90[i]), std::abs(point.ggx_alpha - out.ggx_alpha[i]));
  const auto compare = [&](Vec3 expected, const float(&planes)[3][kSurfaceLanes]) {
    const Vec3 apart = abs(expected - Vec3(planes[0][i], planes[1][i], planes[2][i]));
    // Not-a-number counts as far apart.
    for (float part : {apart.x, apart.y, apart.z}) largest = part <= largest ? largest : std::isnan(part) ? 9e9f : part;
  };
  compare(point.position, out.position);
  compare(point.geometric_normal, out.geometric_normal);
  compare(point.shading_normal, out.shading_normal);
  compare(point.diffuse_albedo, out.diffuse_albedo);
  compare(point.f0, out.f0);
  compare(point.emission, out.emission);
  return largest;
}

struct Agreement {
  float largest = 0;    // difference of any lane
  double agreeing = 0;  // share of lanes within kRounding
};

// A coordinate of size 10 in an image of 40 texels carries roundings of 10 * 2^-24 * 40 texels, and neighbouring texels
// may be black and white; a few of them.
constexpr float kRounding = 2e-4f;

Agreement agreement(Kernel kernel, bool smooth, float cone_scale) {
  Dice dice(smooth ? 5u : 6u);
  const Scene scene = random_scene(dice, smooth);
  const SurfaceTables tables(scene);
  Agreement found;
  double lanes = 0;
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    for (int repetition = 0; repetition < 8; ++repetition) {
      const SurfaceQueries queries = random_queries(dice);
      SurfaceAnswers answers;
      kernel(tables.mesh(mesh), queries, answers);
      for (int i = 0; i < kSurfaceLanes; ++i, ++lanes) {
        const float apart = difference(scene, mesh, queries, answers, i, cone_scale);
        found.largest = std::max(found.largest, apart);
        found.agreeing += apart < kRounding;
      }
    }
  }
  found.agreeing /= lanes;
  return found;
}

void expect_agreement(InstructionSet set, Kernel kernel) {
  if (!supports(set)) GTEST_SKIP() << "this processor has no " << name_of(set);
  EXPECT_LT(agreement(kernel, true, 1).largest, kRounding);
  EXPECT_GT(agreement(kernel, false, 1).agreeing, 0.9995);  // a rounding may choose the next texel
  EXPECT_LT(agreement(kernel, true, 1.01f).agreeing, 0.9);  // the control: one per cent off is noticed
}

TEST(SurfaceKernel, agrees_with_evaluate_surface_on_avx512) {
  expect_agreement(InstructionSet::avx512, avx512::evaluate_surfaces);
}
TEST(SurfaceKernel, agrees_with_evaluate_surface_on_avx2) {
  expect_agreement(InstructionSet::avx2, avx2::evaluate_surfaces);
}
TEST(SurfaceKernel, agrees_with_evaluate_surface_on_the_baseline) {
  expect_agreement(InstructionSet::baseline, baseline::evaluate_surfaces);
}

// A point that a triangle of no area is asked for, and coordinates that are not numbers, give finite surfaces.
TEST(SurfaceKernel, survives_what_is_not_a_surface) {
  Dice dice(7);
  const Scene scene = broken_scene(dice);
  const SurfaceTables tables(scene);
  for (std::uint32_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
    SurfaceQueries queries = random_queries(dice);
    for (std::uint32_t& triangle : queries.triangle) triangle %= 2;
    SurfaceAnswers answers;
    baseline::evaluate_surfaces(tables.mesh(mesh), queries, answers);
    for (int i = 0; i < kSurfaceLanes; ++i) {
      const Vec3 normal(answers.shading_normal[0][i], answers.shading_normal[1][i], answers.shading_normal[2][i]);
      EXPECT_NEAR(length(normal), 1, 1e-5f);
      EXPECT_TRUE(answers.ggx_alpha[i] >= kLeastGgxAlpha && answers.ggx_alpha[i] <= 1);
      EXPECT_TRUE(answers.diffuse_albedo[0][i] >= 0 && answers.diffuse_albedo[0][i] <= 1);
    }
  }
}

}  // namespace
}  // namespace luciole::test
