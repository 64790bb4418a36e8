// SPDX-License-Identifier: Apache-2.0
#include "offline/light_sample/spherical_triangle.h"

#include <gtest/gtest.h>

#include <random>

namespace luciole {
namespace {

using Vector = SphericalTriangle::Vector;

Vector unit(double x, double y, double z) { return f64::normalize(Vector(x, y, z)); }

struct Case {
  Vector a, b, c;
};

std::vector<Case> cases() {
  return {{unit(1, 0, 0), unit(0, 1, 0), unit(0, 0, 1)},
          {unit(1, 0.1, 0), unit(1, -0.1, 0.05), unit(1, 0, -0.2)},
          {unit(1, 0, 0), unit(-0.9, 0.4, 0.1), unit(-0.3, -0.2, 1)},
          {unit(0.3, 1, 0), unit(0.31, 1, 0.2), unit(0.3, 1, 0.5)}};
}

// Moments of the solid angle by a fine rule over the plane triangle: cos / l^2 dA.
void integrate(const Case& t, double& solid_angle, Vector& mean) {
  constexpr int kCells = 700;
  const Vector ab = t.b - t.a, ac = t.c - t.a, normal = f64::cross(ab, ac);
  solid_angle = 0, mean = Vector(0, 0, 0);
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      const double s = (i + 0.5) / kCells, v = (j + 0.5) / kCells;
      const Vector y = t.a + ab * (s * (1 - v)) + ac * (s * v);  // Jacobian s
      const double l_sq = f64::dot(y, y), l = std::sqrt(l_sq);
      const double weight = s * std::abs(f64::dot(normal, y)) / (l * l_sq) / (kCells * kCells);
      solid_angle += weight;
      mean += y * (weight / l);
    }
  }
  mean = mean / solid_angle;
}

TEST(SphericalTriangle, has_the_solid_angle_of_the_plane_triangle_and_its_mean_direction) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Case& t : cases()) {
    double solid_angle = 0;
    Vector mean;
    integrate(t, solid_angle, mean);
    const SphericalTriangle triangle(t.a, t.b, t.c);
    EXPECT_NEAR(triangle.solid_angle(), solid_angle, 2e-4 * solid_angle);
    constexpr int kSamples = 200000;
    Vector sum(0, 0, 0);
    for (int i = 0; i < kSamples; ++i) {
      const Vector d = triangle.sample(uniform(engine), uniform(engine));
      ASSERT_NEAR(f64::dot(d, d), 1, 1e-9);
      sum += d;
    }
    // Components of unit vectors deviate by less than 1.
    EXPECT_LT(f64::length(sum / kSamples - mean), 4 * std::sqrt(1.0 / kSamples));
  }
}

TEST(SphericalTriangle, points_uniform_in_area_are_told_apart) {
  const Case t = cases()[2];
  double solid_angle = 0;
  Vector mean;
  integrate(t, solid_angle, mean);
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  Vector sum(0, 0, 0);
  constexpr int kSamples = 200000;
  for (int i = 0; i < kSamples; ++i) {
    const double root = std::sqrt(uniform(engine)), v = uniform(engine);
    sum += f64::normalize(t.a * (1 - root) + t.b * (root * (1 - v)) + t.c * (root * v));
  }
  EXPECT_GT(f64::length(sum / kSamples - mean), 10 * std::sqrt(1.0 / kSamples));
}

}  // namespace
}  // namespace luciole
