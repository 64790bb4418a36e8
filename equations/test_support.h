// SPDX-License-Identifier: Apache-2.0
// What the tests of the equations share: random geometry in double, and z-tests of means.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "equations/cpp/double.h"
#include "equations/cpp/float.h"

namespace luciole::test {

using f64::real3;
inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kSigmas = 4.0;  // with fixed seeds: a right estimator passes for good

// Fixed-seed source of random geometry.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return uniform_(engine_); }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double log_uniform(double low, double high) { return low * std::pow(high / low, uniform()); }
  std::uint32_t bits() { return static_cast<std::uint32_t>(engine_() >> 32); }
  real3 direction() {
    const double z = uniform(-1, 1), phi = uniform(0, 2 * kPi), s = std::sqrt(1 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
  }

 private:
  std::mt19937_64 engine_;
  std::uniform_real_distribution<double> uniform_{0.0, 1.0};
};

inline f32::real3 rounded(real3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline real3 widened(f32::real3 v) { return {v.x, v.y, v.z}; }

// How many standard deviations a sum over `count` samples is from its expectation.
inline double z_of_mean(double sum, double count, double mean, double variance) {
  return (sum / count - mean) / std::sqrt(variance / count);
}

// A random view: eye at `eye`, any orientation.
inline f64::ViewFrame random_view(Dice& dice, real3 eye) {
  f64::ViewFrame view;
  view.eye = eye;
  view.forward = dice.direction();
  view.right = f64::perpendicular(view.forward);
  view.up = f64::cross(view.right, view.forward);
  return view;
}
inline f32::ViewFrame rounded(const f64::ViewFrame& view) {
  f32::ViewFrame r;
  r.eye = rounded(view.eye), r.right = rounded(view.right), r.up = rounded(view.up), r.forward = rounded(view.forward);
  return r;
}

// GGX reflection by the textbook, in angles to nobody's liking but independent of the code under test. n = +z.
struct TextbookLobe {
  real3 incident;
  double alpha, f0, f90;
  double lambda(double z) const { return (std::sqrt(1 + alpha * alpha * (1 / (z * z) - 1)) - 1) / 2; }
  double fresnel(real3 outgoing) const {
    const real3 h = f64::normalize(incident + outgoing);
    return f0 + (f90 - f0) * std::pow(1 - f64::dot(h, incident), 5);
  }
  double distribution(real3 outgoing) const {
    const real3 h = f64::normalize(incident + outgoing);
    const double d = alpha * alpha * h.z * h.z + h.x * h.x + h.y * h.y;
    return alpha * alpha / (kPi * d * d);
  }
  // G2: height-correlated or separable; intensity per flux, F D G2 / (4 c).
  double intensity(real3 outgoing, bool correlated) const {
    const double li = lambda(incident.z), lo = lambda(outgoing.z);
    const double g2 = correlated ? 1 / (1 + li + lo) : 1 / ((1 + li) * (1 + lo));
    return fresnel(outgoing) * distribution(outgoing) * g2 / (4 * incident.z);
  }
};

// A direction above the surface n = +z: uniform, inside the lobe, in the plane of incidence, or near the horizon.
inline real3 outgoing_direction(Dice& dice, const TextbookLobe& lobe) {
  for (;;) {
    real3 out = dice.direction();
    const double kind = dice.uniform();
    if (kind < 0.5) {
      const real3 h = f64::normalize(dice.direction() * (lobe.alpha * dice.log_uniform(0.02, 50)) + real3(0, 0, 1));
      out = h * (2 * f64::dot(h, lobe.incident)) - lobe.incident;
    } else if (kind < 0.7) {
      const double s = std::sqrt(1 - lobe.incident.z * lobe.incident.z);
      const real3 across = s > 0 ? real3(lobe.incident.x / s, lobe.incident.y / s, 0) : real3(1, 0, 0);
      const double theta = dice.uniform(-kPi / 2, kPi / 2);
      out = across * std::sin(theta) + real3(0, 0, std::cos(theta));
    } else if (kind < 0.8) {
      out.z = dice.log_uniform(1e-9, 0.1);
      out = f64::normalize(out);
    }
    if (out.z > 0) return out;
  }
}

inline TextbookLobe random_lobe(Dice& dice, double least_alpha) {
  TextbookLobe lobe;
  const double c = dice.uniform() < 0.5 ? 1 - dice.uniform() : dice.log_uniform(1e-4, 1);
  const double phi = dice.uniform(0, 2 * kPi), s = std::sqrt(1 - c * c);
  lobe.incident = {s * std::cos(phi), s * std::sin(phi), c};
  lobe.alpha = dice.log_uniform(least_alpha, 1);
  const double kind = dice.uniform();
  lobe.f0 = kind < 0.3 ? 0.04 : kind < 0.5 ? 1 : dice.uniform();
  lobe.f90 = dice.uniform() < 0.8 ? 1 : dice.uniform(lobe.f0, 1);
  return lobe;
}

}  // namespace luciole::test
