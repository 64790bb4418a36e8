// SPDX-License-Identifier: Apache-2.0
// Renders a yard under thousands of lamps three times on the GPU: with clamped lights, with stochastic ones, and
// exactly. The stochastic frames must agree with the exact sum by the image z-test; the clamped ones, at the same
// number of lights per pixel, must not.       tiled_lighting [SIDE FRAMES LIGHTS]
#include <image/metrics.h>
#include <image/png.h>
#include <image/z_test.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "compute.h"
#include "yard.h"

namespace {

using luciole::Vec3;

const std::vector<std::uint32_t> kClampedSpirv = {
#include "clamped.inc"
};
const std::vector<std::uint32_t> kStochasticSpirv = {
#include "stochastic.inc"
};
const std::vector<std::uint32_t> kExactSpirv = {
#include "exact_sum.inc"
};

// One frame as a shader left it.
struct Picture {
  std::vector<Vec3> radiance;
  std::vector<float> lights;  // shaded per pixel
  double mean_lights() const {
    double sum = 0;
    for (const float count : lights) sum += double(count);
    return sum / double(lights.size());
  }
};

class Yard {
 public:
  Yard(Device& device, std::uint32_t side, const std::vector<Light>& lights)
      : constants_{side, side, std::uint32_t(lights.size()), 0},
        lights_(device, lights.size() * sizeof(Light)),
        surfaces_(device, pixel_count() * sizeof(Surface)),
        picture_(device, pixel_count() * sizeof(float[4])),
        variance_(device, pixel_count() * sizeof(float[4])),
        clamped_(device, kClampedSpirv, {&lights_, &surfaces_, &picture_}),
        stochastic_(device, kStochasticSpirv, {&lights_, &surfaces_, &picture_}),
        exact_(device, kExactSpirv, {&lights_, &surfaces_, &picture_, &variance_}) {
    std::memcpy(lights_.as<void>(), lights.data(), lights.size() * sizeof(Light));
    std::memcpy(surfaces_.as<void>(), see_yard(side, side).data(), pixel_count() * sizeof(Surface));
  }

  // All ranges as if their lights had drawn the same number xi for ever.
  Picture render_clamped(float xi) {
    for (std::uint32_t i = 0; i < constants_.light_count; ++i) {
      Light& light = lights_.as<Light>()[i];
      light.range = 1 / std::sqrt(light.falloff_floor * xi);
    }
    clamped_.run(constants_);
    return read_picture();
  }
  Picture render_stochastic(std::uint32_t frame) {
    FrameConstants constants = constants_;
    constants.frame = frame;
    stochastic_.run(constants);
    return read_picture();
  }
  luciole::FrameExpectation render_exactly() {
    exact_.run(constants_);
    Picture picture = read_picture();
    return {constants_.width, constants_.height, picture.radiance, colours(variance_), picture.lights};
  }

 private:
  std::size_t pixel_count() const { return std::size_t(constants_.width) * constants_.height; }
  std::vector<Vec3> colours(const Buffer& buffer) const {
    std::vector<Vec3> values;
    const float* source = buffer.as<float>();
    for (std::size_t i = 0; i < pixel_count(); ++i, source += 4)
      values.push_back(Vec3(source[0], source[1], source[2]));
    return values;
  }
  Picture read_picture() const {
    Picture picture{colours(picture_), {}};
    for (std::size_t i = 0; i < pixel_count(); ++i) picture.lights.push_back(picture_.as<float>()[4 * i + 3]);
    return picture;
  }

  FrameConstants constants_;
  Buffer lights_, surfaces_, picture_, variance_;
  Kernel clamped_, stochastic_, exact_;
};

double mean_luminance(const std::vector<Vec3>& pixels) {
  double sum = 0;
  for (const Vec3& pixel : pixels) sum += double(luciole::luminance(pixel));
  return sum / double(pixels.size());
}

// The clamped frame that shades as many lights per pixel as are wanted: bisection over the logarithm of xi.
Picture clamped_at_equal_cost(Yard& yard, double wanted_lights) {
  float low = std::log(1e-4f), high = 0;
  Picture picture;
  for (int step = 0; step < 12; ++step) {
    const float middle = 0.5f * (low + high);
    picture = yard.render_clamped(std::exp(middle));
    (picture.mean_lights() > wanted_lights ? low : high) = middle;
  }
  return picture;
}

void save(const char* path, const std::vector<Vec3>& radiance, std::uint32_t side, double exposure) {
  const auto display = luciole::to_display(radiance, float(exposure), luciole::ToneCurve::pbr_neutral);
  const auto status = luciole::write_png(display, side, side, path);
  if (!status) std::fprintf(stderr, "%s\n", status.error().message.c_str());
}

std::uint32_t positive(const char* text, std::uint32_t multiple_of) {
  const long value = std::strtol(text, nullptr, 10);
  if (value > 0 && value <= 65536 && value % long(multiple_of) == 0) return std::uint32_t(value);
  std::fprintf(stderr, "\"%s\" is not a multiple of %u up to 65536.\n", text, multiple_of);
  std::exit(2);
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint32_t side = argc > 1 ? positive(argv[1], 16) : 256;
  const std::uint32_t frames = argc > 2 ? positive(argv[2], 1) : 128;
  const std::uint32_t light_count = argc > 3 ? positive(argv[3], 1) : 4096;
  Device device;
  Yard yard(device, side, hang_lamps(light_count, 0.006f));
  std::printf("%s, %u x %u pixels, %u lights\n", device.name().c_str(), side, side, light_count);

  const luciole::FrameExpectation exact = yard.render_exactly();
  luciole::EstimatorStatistics statistics(exact, frames);
  double lights = 0;
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    const Picture picture = yard.render_stochastic(frame);
    lights += picture.mean_lights() / frames;
    statistics.add(picture.radiance);
  }
  const Picture clamped = clamped_at_equal_cost(yard, lights);

  const luciole::ZTestReport after = luciole::image_z_test(statistics);
  luciole::EstimatorStatistics clamped_statistics(exact, 2);  // frames do not differ
  for (int frame = 0; frame < 2; ++frame) clamped_statistics.add(clamped.radiance);
  const luciole::ZTestReport before = luciole::image_z_test(clamped_statistics);
  const double truth = mean_luminance(exact.mean);
  const double clamped_ratio = mean_luminance(clamped.radiance) / truth;
  const double stochastic_ratio = mean_luminance(statistics.mean()) / truth;
  std::printf("before, clamped:    %.1f lights per pixel, %.4f of the exact mean, z-test %s\n", clamped.mean_lights(),
              clamped_ratio, before.passed ? "passes" : "fails");
  std::printf("after,  stochastic: %.1f lights per pixel, %.4f of the exact mean, z-test %s", lights, stochastic_ratio,
              after.passed ? "passes" : "fails: ");
  std::printf("%s (%llu values, largest deviation %.2f, mean t = %.2f, variance ratio %.3f)\n", after.reason.c_str(),
              static_cast<unsigned long long>(after.values), after.largest_deviation, after.picture_t,
              after.variance_ratio);
  save("before.png", clamped.radiance, side, 0.18 / truth);
  save("after_one_frame.png", yard.render_stochastic(0).radiance, side, 0.18 / truth);
  save("after_mean.png", statistics.mean(), side, 0.18 / truth);
  save("exact.png", exact.mean, side, 0.18 / truth);
  return after.passed && !before.passed && clamped_ratio < 1 ? 0 : 1;
}
