// SPDX-License-Identifier: Apache-2.0
// Directions from a point to a triangle, uniform in solid angle. In double: the angles of slim triangles cancel.
//   J. Arvo, "Stratified Sampling of Spherical Triangles", SIGGRAPH 1995.
#pragma once
#include <algorithm>
#include <cmath>

#include "equations/cpp/double.h"

namespace luciole {

class SphericalTriangle {
 public:
  using Vector = f64::real3;

  // a, b, c: unit directions to the corners.
  SphericalTriangle(Vector a, Vector b, Vector c) : a_(a), b_(b), c_(c) {
    // A. Van Oosterom, J. Strackee, "The Solid Angle of a Plane Triangle", 1983.
    const double triple = std::abs(f64::dot(a, f64::cross(b, c)));
    solid_angle_ = 2 * std::atan2(triple, 1 + f64::dot(a, b) + f64::dot(b, c) + f64::dot(c, a));
    const Vector ab = f64::cross(a, b), ac = f64::cross(a, c);
    cos_at_a_ = std::clamp(f64::dot(ab, ac) / std::sqrt(f64::dot(ab, ab) * f64::dot(ac, ac)), -1.0, 1.0);
    angle_at_a_ = std::acos(cos_at_a_);
  }

  double solid_angle() const { return solid_angle_; }  // [sr]

  Vector sample(double u, double v) const {
    const double area = u * solid_angle_, sin_at_a = std::sin(angle_at_a_);
    const double s = std::sin(area - angle_at_a_), t = std::cos(area - angle_at_a_);
    const double p = t - cos_at_a_, q = s + sin_at_a * f64::dot(a_, b_);
    const double cos_side = std::clamp(((q * t - p * s) * cos_at_a_ - q) / ((q * s + p * t) * sin_at_a), -1.0, 1.0);
    const Vector edge = a_ * cos_side + across(c_, a_) * std::sqrt(1 - cos_side * cos_side);
    const double z = std::clamp(1 - v * (1 - f64::dot(edge, b_)), -1.0, 1.0);
    return b_ * z + across(edge, b_) * std::sqrt(1 - z * z);
  }

 private:
  // The unit vector perpendicular to `axis` in the plane of both.
  static Vector across(Vector v, Vector axis) { return f64::normalize(v - axis * f64::dot(v, axis)); }

  Vector a_, b_, c_;
  double solid_angle_, cos_at_a_, angle_at_a_;
};

}  // namespace luciole
