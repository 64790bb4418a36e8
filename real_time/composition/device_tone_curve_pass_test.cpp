// SPDX-License-Identifier: Apache-2.0
// What a device shows of a picture has the codes of the CPU's PNG files.
#include "real_time/composition/device_tone_curve_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>

#include "equations/cpp/double.h"
#include "gpu/test_device.h"

#define LUCIOLE_FN inline
namespace luciole::f64 {
#include "image/pbr_neutral.h"
}
#undef LUCIOLE_FN

namespace luciole::test {
namespace {

constexpr std::uint32_t kWidth = 257, kHeight = 61;  // neither divides by a workgroup
constexpr float kExposure = 1.7f;
constexpr ToneCurve kCurves[] = {ToneCurve::pbr_neutral, ToneCurve::linear};

// Colours from dark to far beyond white, saturated and grey, each decade alike.
std::vector<Vec3> colours() {
  std::mt19937 random(11);
  const auto uniform = [&] { return float(random() >> 8) * 0x1p-24f; };
  std::vector<Vec3> out(std::size_t(kWidth) * kHeight);
  for (Vec3& colour : out) {
    const float size = std::pow(10.0f, -3.0f + 5.0f * uniform());
    colour = Vec3(uniform(), uniform(), uniform()) * size;
  }
  return out;
}

using Codes = std::array<int, 3>;

std::vector<Codes> codes_on_device(const std::vector<Vec3>& picture, float exposure, ToneCurve curve,
                                   bool validated = false) {
  namespace t = gpu::test;
  const auto device = validated ? t::open_validated_device() : t::open_device();
  const Result<DeviceToneCurvePass> pass = DeviceToneCurvePass::create(*device);
  EXPECT_TRUE(pass.has_value()) << pass.error().message;
  const gpu::Buffer from = t::upload_of(*device, picture);
  const gpu::Buffer to = t::make_buffer(*device, 4 * picture.size(), gpu::BufferUse::readback);
  gpu::CommandList list = t::make_list(*device);
  list.begin_pass("tone_curve");
  pass->record(list, from, to, kWidth, kHeight, exposure, curve);
  const Status done = list.run();
  EXPECT_TRUE(done.has_value()) << done.error().message;
  std::vector<Codes> codes;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const std::uint8_t* const rgba = to.as<std::uint8_t>() + 4 * i;
    EXPECT_EQ(rgba[3], 255);
    codes.push_back({rgba[0], rgba[1], rgba[2]});
  }
  return codes;
}

Codes codes_on_cpu(Vec3 colour, float exposure, ToneCurve curve) {
  const Vec3 display = to_display({colour}, exposure, curve)[0];
  return {srgb_code(display.x), srgb_code(display.y), srgb_code(display.z)};
}

using Channels = std::array<double, 3>;

// The curve in double precision.
Channels exact_display(Vec3 colour, float exposure, ToneCurve curve) {
  const double e = exposure;
  f64::real3 v = f64::above_zero3({double(colour.x) * e, double(colour.y) * e, double(colour.z) * e});
  if (curve == ToneCurve::pbr_neutral) v = f64::pbr_neutral(v);
  v = f64::within_unit3(v);
  return {v.x, v.y, v.z};
}

// How far a device's display-linear values may be from exact ones: SPIR-V allows no chain of operations more than five
// times what C++ errs to first order (gpu/equations_device_test.cpp), and how much that is at most the colours tell.
double tolerance(const std::vector<Vec3>& picture, ToneCurve curve) {
  double largest = 0;
  for (const Vec3& colour : picture) {
    const Vec3 found = to_display({colour}, kExposure, curve)[0];
    const Channels right = exact_display(colour, kExposure, curve);
    largest = std::max({largest, std::abs(double(found.x) - right[0]), std::abs(double(found.y) - right[1]),
                        std::abs(double(found.z) - right[2])});
  }
  return 5 * largest;
}

struct Comparison {
  std::size_t values = 0, other = 0;  // values whose code is not the CPU's
  std::size_t at_an_edge = 0;         // rounding may decide their code
  std::size_t wrong = 0;              // of the others, or by more than one
};

Comparison compare_codes(const std::vector<Vec3>& picture, const std::vector<Codes>& found, ToneCurve curve) {
  const auto edges = srgb_code_edges();
  const double allowed = tolerance(picture, curve);
  Comparison c;
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const Codes right = codes_on_cpu(picture[i], kExposure, curve);
    const Channels exact = exact_display(picture[i], kExposure, curve);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto above = std::lower_bound(edges.begin(), edges.end(), float(exact[k] - allowed));
      const bool at_an_edge = above != edges.end() && double(*above) <= exact[k] + allowed;
      const int apart = std::abs(found[i][k] - right[k]);
      ++c.values, c.other += apart != 0, c.at_an_edge += at_an_edge;
      c.wrong += apart > (at_an_edge ? 1 : 0);
    }
  }
  return c;
}

TEST(ToneCurveOnTheDevice, gives_the_codes_of_png_files) {
  const std::vector<Vec3> picture = colours();
  const auto edges = srgb_code_edges();
  for (const ToneCurve curve : kCurves) {
    const Comparison c = compare_codes(picture, codes_on_device(picture, kExposure, curve), curve);
    std::printf("%s: %zu values, %zu at an edge, %zu have another code\n", std::string(tone_curve_name(curve)).c_str(),
                c.values, c.at_an_edge, c.other);
    EXPECT_EQ(c.wrong, 0u);
    // Edges are nowhere closer than the first two, so no more of the values than this are at one; twice for chance.
    EXPECT_LE(double(c.at_an_edge),
              2 * double(c.values) * 2 * tolerance(picture, curve) / double(edges[1] - edges[0]) + 1);
  }
}

TEST(ToneCurveOnTheDevice, of_another_exposure_or_curve_is_caught) {
  const std::vector<Vec3> picture = colours();
  const auto wrong = [&](float exposure, ToneCurve curve) {
    const Comparison c = compare_codes(picture, codes_on_device(picture, exposure, curve), ToneCurve::pbr_neutral);
    return double(c.wrong) / double(c.values);
  };
  EXPECT_EQ(wrong(kExposure, ToneCurve::pbr_neutral), 0.0);
  EXPECT_GT(wrong(1.0f, ToneCurve::pbr_neutral), 0.5) << "the exposure forgotten";
  EXPECT_GT(wrong(kExposure * 1.01f, ToneCurve::pbr_neutral), 0.1);
  EXPECT_GT(wrong(kExposure, ToneCurve::linear), 0.5);
}

// Every edge, and the values beside it: which code they get no rounding can change.
TEST(ToneCurveOnTheDevice, has_its_edges_where_the_cpu_has_them) {
  std::vector<Vec3> picture(std::size_t(kWidth) * kHeight);
  std::size_t i = 0;
  for (const float edge : srgb_code_edges())
    picture[i++] = Vec3(std::nextafter(edge, 0.0f), edge, std::nextafter(edge, 1.0f));
  const std::vector<Codes> codes = codes_on_device(picture, 1, ToneCurve::linear);
  for (std::size_t k = 0; k < i; ++k) {
    const int code = static_cast<int>(k) + 1;
    EXPECT_EQ(codes[k], (Codes{code - 1, code, code})) << k;
    EXPECT_EQ(codes[k], codes_on_cpu(picture[k], 1, ToneCurve::linear)) << k;
  }
}

TEST(ToneCurveOnTheDevice, keeps_odd_values_on_the_screen) {
  constexpr float kInfinite = std::numeric_limits<float>::infinity();
  std::vector<Vec3> picture(std::size_t(kWidth) * kHeight, Vec3(0, 0, 0));
  const float odd[] = {kInfinite, -kInfinite, std::numeric_limits<float>::quiet_NaN(), 3e38f, -1.0f, 0.0f, -0.0f};
  std::size_t count = 0;
  for (const float a : odd) {
    for (const float b : odd) picture[count++] = Vec3(a, 0.5f, b);
  }
  for (const ToneCurve curve : kCurves) {
    const std::vector<Codes> codes = codes_on_device(picture, kExposure, curve);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(codes[i], codes_on_cpu(picture[i], kExposure, curve)) << i;
  }
}

TEST(ToneCurveOnTheDevice, gives_validation_nothing_to_say) {
  codes_on_device(colours(), kExposure, ToneCurve::pbr_neutral, /*validated=*/true);  // a message fails the run
}

}  // namespace
}  // namespace luciole::test
