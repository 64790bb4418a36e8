// SPDX-License-Identifier: Apache-2.0
// Section numbers are those of the paper named in flip.h. All its filters are sums of products of a function of x and
// one of y, so that each is applied as rows, then columns.
#include "image/flip.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace luciole {
namespace {

constexpr double kPi = 3.14159265358979323846;
using Plane = std::vector<float>;
using Kernel = std::vector<float>;  // odd length, centre in the middle

struct Size {
  int width, height;
};

// CIE XYZ of linear Rec. 709, white at D65 (rows sum to the white point), and the inverse.
constexpr double kXyz[3][3] = {{0.412386563, 0.357591067, 0.180450915},
                               {0.212636821, 0.715182134, 0.072180364},
                               {0.019330620, 0.119197098, 0.950372710}};
constexpr double kRgb[3][3] = {{3.241003275, -1.537398934, -0.498615861},
                               {-0.969224334, 1.875930071, 0.041554224},
                               {0.055639423, -0.204011202, 1.057148933}};
constexpr double kWhite[3] = {0.950428545, 1.0, 1.088900371};

Vec3 transform(const double (&m)[3][3], Vec3 v) {
  const auto row = [&](int i) { return static_cast<float>(m[i][0] * v.x + m[i][1] * v.y + m[i][2] * v.z); };
  return Vec3(row(0), row(1), row(2));
}

Vec3 relative_to_white(Vec3 xyz) {
  return Vec3(float(xyz.x / kWhite[0]), float(xyz.y / kWhite[1]), float(xyz.z / kWhite[2]));
}

// Lightness and two opponent colours of values that are already linear (Y C_x C_z, section 4.1) or compressed (L* a*
// b*).
Vec3 opponent(Vec3 v) { return Vec3(116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)); }

Vec3 rgb_from_opponent(Vec3 o) {
  const float y = (o.x + 16) / 116;
  return transform(kRgb, Vec3(float((y + o.y / 500) * kWhite[0]), y, float((y - o.z / 200) * kWhite[2])));
}

float cube_root_of_lab(float t) {
  constexpr float kKnee = 6.0f / 29.0f;
  return t > kKnee * kKnee * kKnee ? std::cbrt(t) : t / (3 * kKnee * kKnee) + 4.0f / 29.0f;
}

// L* a* b* with the chroma scaled by lightness (Hunt effect), section 4.1.2.
Vec3 hunt_lab_from_rgb(Vec3 rgb) {
  const Vec3 t = relative_to_white(transform(kXyz, rgb));
  const Vec3 lab = opponent(Vec3(cube_root_of_lab(t.x), cube_root_of_lab(t.y), cube_root_of_lab(t.z)));
  return Vec3(lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z);
}

// HyAB distance: city block between lightness and chroma, Euclidean within chroma.
float hyab(Vec3 a, Vec3 b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

// Rows, then columns; the border's pixels are repeated outwards. Adds `weight` times the result to `sum`.
void add_filtered(const Plane& plane, Size size, const Kernel& along_x, const Kernel& along_y, float weight,
                  Plane& sum) {
  const int radius_x = static_cast<int>(along_x.size()) / 2, radius_y = static_cast<int>(along_y.size()) / 2;
  const auto width = static_cast<std::size_t>(size.width);
  Plane rows(plane.size());
  parallel_for(static_cast<std::size_t>(size.height), 8, [&](std::size_t begin, std::size_t end) {
    std::vector<float> padded(width + 2 * static_cast<std::size_t>(radius_x));
    for (std::size_t y = begin; y < end; ++y) {
      for (int x = 0; x < static_cast<int>(padded.size()); ++x) {
        const int clamped = std::clamp(x - radius_x, 0, size.width - 1);
        padded[static_cast<std::size_t>(x)] = plane[y * width + static_cast<std::size_t>(clamped)];
      }
      for (std::size_t tap = 0; tap < along_x.size(); ++tap) {
        for (std::size_t x = 0; x < width; ++x) rows[y * width + x] += along_x[tap] * padded[x + tap];
      }
    }
  });
  parallel_for(static_cast<std::size_t>(size.height), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) {
      for (std::size_t tap = 0; tap < along_y.size(); ++tap) {
        const int row = std::clamp(static_cast<int>(y + tap) - radius_y, 0, size.height - 1);
        const float* source = rows.data() + static_cast<std::size_t>(row) * width;
        for (std::size_t x = 0; x < width; ++x) sum[y * width + x] += weight * along_y[tap] * source[x];
      }
    }
  });
}

template <class Function>
Kernel sampled_kernel(int radius, Function value) {
  Kernel kernel;
  for (int x = -radius; x <= radius; ++x) kernel.push_back(static_cast<float>(value(double(x))));
  return kernel;
}

// Divides the positive weights by their sum, the negative ones by theirs.
Kernel normalised(Kernel kernel) {
  double positive = 0, negative = 0;
  for (const float weight : kernel) (weight > 0 ? positive : negative) += std::abs(weight);
  for (float& weight : kernel) {
    if (weight != 0) weight = static_cast<float>(weight / (weight > 0 ? positive : negative));
  }
  return kernel;
}

// One term a sqrt(pi/b) exp(-pi^2 x^2 / b) of a contrast sensitivity in space, x in degrees; section 4.1.1, Table 1.
struct SensitivityTerm {
  double a, b;
};

Plane filter_by_sensitivity(const Plane& plane, Size size, const std::vector<SensitivityTerm>& terms,
                            double pixels_per_degree) {
  constexpr double kWidest = 0.04;  // b of the blue-yellow sensitivity: three standard deviations serve all channels
  const int radius = static_cast<int>(std::ceil(3 * std::sqrt(kWidest / (2 * kPi * kPi)) * pixels_per_degree));
  std::vector<Kernel> kernels;
  std::vector<double> volumes;
  double total = 0;
  for (const auto& [a, b] : terms) {
    const double fall_off = kPi * kPi / (b * pixels_per_degree * pixels_per_degree);
    const Kernel kernel = sampled_kernel(radius, [&](double x) { return std::exp(-fall_off * x * x); });
    double sum = 0;
    for (const float weight : kernel) sum += weight;
    kernels.push_back(normalised(kernel));
    volumes.push_back(a * std::sqrt(kPi / b) * sum * sum);
    total += volumes.back();
  }
  Plane filtered(plane.size());
  for (std::size_t i = 0; i < terms.size(); ++i) {
    add_filtered(plane, size, kernels[i], kernels[i], static_cast<float>(volumes[i] / total), filtered);
  }
  return filtered;
}

// The picture as an observer's eye blurs it, in a space where distances are seen differences.
std::vector<Vec3> perceived(const std::vector<Plane>& channels, Size size, double pixels_per_degree) {
  const Plane lightness = filter_by_sensitivity(channels[0], size, {{1, 0.0047}}, pixels_per_degree);
  const Plane red_green = filter_by_sensitivity(channels[1], size, {{1, 0.0053}}, pixels_per_degree);
  const Plane blue_yellow = filter_by_sensitivity(channels[2], size, {{34.1, 0.04}, {13.5, 0.025}}, pixels_per_degree);
  std::vector<Vec3> pixels(lightness.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Vec3 rgb = rgb_from_opponent(Vec3(lightness[i], red_green[i], blue_yellow[i]));
    const auto clamped = [](float x) { return std::clamp(x, 0.0f, 1.0f); };
    pixels[i] = hunt_lab_from_rgb(Vec3(clamped(rgb.x), clamped(rgb.y), clamped(rgb.z)));
  }
  return pixels;
}

// Strength of edges and points per pixel, section 4.2: gradient and second derivative of a Gaussian as wide as the
// peak-to-trough distance of the eye's edge detectors (0.082 degrees).
struct Features {
  Plane edges, points;
};

Features features(const Plane& lightness, Size size, double pixels_per_degree) {
  const double deviation = 0.5 * 0.082 * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * deviation));
  const auto gauss = [&](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
  const Kernel smooth = normalised(sampled_kernel(radius, gauss));
  const Kernel edge = normalised(sampled_kernel(radius, [&](double x) { return -x * gauss(x); }));
  const Kernel point =
      normalised(sampled_kernel(radius, [&](double x) { return (x * x / (deviation * deviation) - 1) * gauss(x); }));
  const auto strength = [&](const Kernel& kernel) {
    Plane along_x(lightness.size()), along_y(lightness.size());
    add_filtered(lightness, size, kernel, smooth, 1, along_x);
    add_filtered(lightness, size, smooth, kernel, 1, along_y);
    for (std::size_t i = 0; i < along_x.size(); ++i) along_x[i] = std::hypot(along_x[i], along_y[i]);
    return along_x;
  };
  return {strength(edge), strength(point)};
}

struct Analysed {
  std::vector<Vec3> colours;
  Features features;
};

Analysed analyse(const std::vector<Vec3>& pixels, Size size, double pixels_per_degree) {
  std::vector<Plane> channels(3, Plane(pixels.size()));
  Plane lightness(pixels.size());  // Y relative to white
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Vec3 xyz = relative_to_white(transform(kXyz, pixels[i]));
    const Vec3 o = opponent(xyz);
    channels[0][i] = o.x, channels[1][i] = o.y, channels[2][i] = o.z;
    lightness[i] = xyz.y;
  }
  return {perceived(channels, size, pixels_per_degree), features(lightness, size, pixels_per_degree)};
}

// Section 4.1.3: distances to the power 0.7, so spread that 0.4 of the largest possible one (green against blue)
// becomes 0.95.
float colour_difference(Vec3 a, Vec3 b) {
  constexpr float kExponent = 0.7f, kKnee = 0.4f, kKneeValue = 0.95f;
  static const float largest =
      std::pow(hyab(hunt_lab_from_rgb(Vec3(0, 1, 0)), hunt_lab_from_rgb(Vec3(0, 0, 1))), kExponent);
  const float relative = std::pow(hyab(a, b), kExponent) / largest;
  if (relative < kKnee) return relative * (kKneeValue / kKnee);
  return kKneeValue + (relative - kKnee) / (1 - kKnee) * (1 - kKneeValue);
}

}  // namespace

std::vector<float> flip_map(const std::vector<Vec3>& a, const std::vector<Vec3>& b, std::uint32_t width,
                            std::uint32_t height, float pixels_per_degree) {
  const Size size{static_cast<int>(width), static_cast<int>(height)};
  const Analysed seen_a = analyse(a, size, pixels_per_degree), seen_b = analyse(b, size, pixels_per_degree);
  std::vector<float> map(a.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    const float edges = std::abs(seen_a.features.edges[i] - seen_b.features.edges[i]);
    const float points = std::abs(seen_a.features.points[i] - seen_b.features.points[i]);
    const float feature_difference = std::sqrt(std::max(edges, points) / std::sqrt(2.0f));
    // Section 4.3: features, where they differ, raise the colour difference.
    map[i] = std::pow(colour_difference(seen_a.colours[i], seen_b.colours[i]), 1 - feature_difference);
  }
  return map;
}

}  // namespace luciole
