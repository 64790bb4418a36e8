// SPDX-License-Identifier: Apache-2.0
// What is fitted to a scene: ranges that let so many lights be accepted as were asked for, random or clamped.
#include "offline/light_sample/make_light_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "equations/cpp/double.h"
#include "offline/light_tree/range_tree.h"
#include "scene/recipes/recipes.h"

namespace luciole {
namespace {

class FittedRanges : public testing::Test {
 protected:
  // Surface points all over the floor of the hall.
  void SetUp() override {
    for (int i = 0; i < 256; ++i) {
      Receiver receiver{};
      const double turn = i * 2.399963, distance = 0.5 * std::sqrt(i + 0.5);  // a sunflower's
      receiver.position[0] = static_cast<float>(distance * std::cos(turn));
      receiver.position[2] = static_cast<float>(distance * std::sin(turn));
      receiver.geometric_normal[1] = receiver.shading_normal[1] = receiver.to_eye[1] = 1;
      receivers_.push_back(receiver);
    }
  }

  struct Accepted {
    double random = 0, clamped = 0;  // lights per receiver
  };
  Accepted accepted(double floor, double clamp_xi) const {
    Accepted sum;
    for (const Receiver& receiver : receivers_) {
      for (const LightRecord& light : lights_.records()) {
        const f64::real3 apart(double(light.x) - receiver.position[0], double(light.y) - receiver.position[1],
                               double(light.z) - receiver.position[2]);
        if (apart.y + light.radius <= 0) continue;
        const double distance_sq = std::max(f64::dot(apart, apart), double(light.radius) * light.radius);
        const double cos_axis = -(apart.x * light.axis_x + apart.y * light.axis_y + apart.z * light.axis_z);
        const double probability = light.intensity *
                                   directional_factor(light, static_cast<float>(cos_axis / std::sqrt(distance_sq))) /
                                   (floor * distance_sq);
        sum.random += std::min(probability, 1.0), sum.clamped += probability > clamp_xi ? 1 : 0;
      }
    }
    const auto count = static_cast<double>(receivers_.size());
    return {sum.random / count, sum.clamped / count};
  }

  Result<Scene> scene_ = make_recipe("lamps", {{"count", "4000"}});
  LightSet lights_{*scene_};
  std::vector<Receiver> receivers_;
};

TEST_F(FittedRanges, accept_as_many_lights_as_wanted) {
  ASSERT_LT(lights_.size(), 4097u);  // all of them are probed
  for (const double wanted : {4.0, 16.0, 200.0}) {
    const float floor = fitted_radiance_floor(lights_, receivers_, wanted);
    const double found = accepted(floor, 1).random;
    EXPECT_GE(found, wanted * 0.999);
    EXPECT_LE(found, wanted * 1.03) << "a floor is one of 32 steps per octave";
  }
}

TEST_F(FittedRanges, clamped_cost_what_random_ones_cost) {
  const float floor = fitted_radiance_floor(lights_, receivers_, 16);
  const Accepted fitted = accepted(floor, fitted_clamp(lights_, receivers_, floor));
  EXPECT_NEAR(fitted.clamped / fitted.random, 1, 0.02);
  const Accepted at_the_median = accepted(floor, 0.5);
  EXPECT_GT(std::abs(at_the_median.clamped / at_the_median.random - 1), 0.02);
}

TEST_F(FittedRanges, weigh_no_more_lights_than_asked_for) {
  PathSettings settings;
  settings.isa = *choose_isa(Isa::automatic);
  const SamplerInputs inputs{*scene_, lights_, settings, receivers_, 70};
  struct Spread {
    double mean = 0, deviation = 0;  // from pass to pass
  };
  const auto weighed = [&](float floor) {
    constexpr std::uint64_t kPasses = 16;
    RangeTree tree(lights_, inputs.scene_diagonal);
    double sum = 0, squares = 0;
    for (std::uint64_t pass = 0; pass < kPasses; ++pass) {
      tree.draw(settings.seed, pass, settings.range_samples, floor);
      const double mean = mean_weighed(tree, receivers_, settings.isa);
      sum += mean / kPasses, squares += mean * mean / kPasses;
    }
    return Spread{sum, std::sqrt(std::max(squares - sum * sum, 0.0))};
  };
  const float generous = fitted_radiance_floor(lights_, receivers_, 200);
  const float fitted = affordable_radiance_floor(inputs, generous);
  EXPECT_GT(weighed(generous).mean, 2 * kMostWeighed);
  // It was fitted in one pass, to a twentieth.
  const Spread found = weighed(fitted);
  EXPECT_LT(found.mean, 1.05 * kMostWeighed + 4 * found.deviation);
  EXPECT_GT(weighed(fitted / 2).mean, kMostWeighed) << "and was raised no more than it had to be";
  const float modest = fitted_radiance_floor(lights_, receivers_, 4);
  EXPECT_EQ(affordable_radiance_floor(inputs, modest), modest);
}

}  // namespace
}  // namespace luciole
