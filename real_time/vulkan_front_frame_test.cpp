// SPDX-License-Identifier: Apache-2.0
// A frame whose front half the device makes is the CPU's frame.
#include <algorithm>
#include <cmath>

#include "real_time/vulkan_test_front.h"

namespace luciole::test {
namespace {

constexpr double kU = 0x1p-24;

const char* const kViews[] = {"recipe:cornell?glossy=0.1", "recipe:ring?alpha=0.1", "recipe:gallery?detail=0.05"};

double scatter(Vec3 a, Vec3 b) { return double(length(a - b)); }

Result<Renderer> renderer_of(const Front& front, const Settings& settings) {
  return Renderer::create(front.scene, front.scene->cameras.at(0), front.primaries, settings);
}

// Squared error relative to the reference's square, of pixels that show the same surface in both; and how many do not.
struct FrameDifference {
  double error = 0;
  std::size_t apart = 0;
};

FrameDifference difference(const Frame& a, const Frame& b) {
  FrameDifference d;
  double square = 0;
  const auto value = [](const Frame& f, const std::string& name, std::size_t i) {
    return double(f.layers.channels.at(name)[i]);
  };
  for (std::size_t i = 0; i < a.picture.size(); ++i) {
    double off = 0;
    for (const char* axis : {"normal.R", "normal.G", "normal.B"})
      off += std::abs(value(a, axis, i) - value(b, axis, i));
    const double depth = value(b, "depth.V", i);
    if (std::isfinite(depth)) off += std::abs(value(a, "depth.V", i) / depth - 1);
    if (!(off < 1e-3)) {
      ++d.apart;
      continue;
    }
    d.error += std::pow(scatter(a.picture[i], b.picture[i]), 2), square += double(dot(b.picture[i], b.picture[i]));
  }
  d.error /= std::max(square, 1e-30);
  return d;
}

// Kinds of ranges that look at all lights first, and layers that look at them again, need the view on the CPU.
TEST(FrameOfTheDevicesFront, is_the_cpus) {
  for (const char* address : kViews) {
    for (const auto& [ranges, by] :
         {std::pair(Ranges::stochastic, luciole::Front::rays), std::pair(Ranges::stochastic, luciole::Front::raster),
          std::pair(Ranges::clamped, luciole::Front::raster)}) {
      Settings settings = small_settings();
      settings.ranges = ranges;
      const Front front(address, settings);
      const std::vector<std::string> layers = {"normal", "depth", "reference"};
      const Result<Frame> cpu = renderer_of(front, settings)->render(0, layers);
      const Result<Frame> other = renderer_of(front, settings)->render(1, layers);
      settings.engine = Engine::vulkan, settings.front = by;
      Result<Renderer> renderer = renderer_of(front, settings);
      ASSERT_TRUE(renderer.has_value()) << renderer.error().message;
      const Result<Frame> device = renderer->render(0, layers);
      ASSERT_TRUE(device.has_value()) << device.error().message;
      const FrameDifference d = difference(*device, *cpu);
      EXPECT_LE(d.apart, cpu->picture.size() / 100) << address;
      EXPECT_LT(d.error, 0.02 * difference(*other, *cpu).error) << address << " " << to_string(ranges);
      EXPECT_NEAR(double(device->statistics.virtual_point_lights), double(cpu->statistics.virtual_point_lights),
                  1 + 0.01 * double(cpu->statistics.virtual_point_lights));
    }
  }
}

double largest_difference(const Frame& a, const Frame& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.picture.size(); ++i) {
    most = std::max(most, scatter(a.picture[i], b.picture[i]) / std::max(double(length(b.picture[i])), 1e-30));
  }
  return most;
}

// With layers the view comes to the CPU, which composes the picture; without, the device does all.
TEST(FrameOfTheDevicesFront, is_one_picture_with_and_without_layers) {
  for (const char* address : {"recipe:lights?count=500", "recipe:gallery?detail=0.05"}) {
    for (const Filter filter : {Filter::bilateral, Filter::none}) {
      Settings settings = small_settings();
      settings.engine = Engine::vulkan, settings.front = luciole::Front::rays, settings.filter = filter;
      const Front front(address, settings);
      Result<Renderer> renderer = renderer_of(front, settings);
      ASSERT_TRUE(renderer.has_value()) << renderer.error().message;
      const Frame alone = *renderer->render(0), with_layers = *renderer->render(0, {"albedo"});
      // Four products and five sums of numbers that are not negative.
      EXPECT_LE(largest_difference(alone, with_layers), 16 * kU) << address;
      EXPECT_GT(largest_difference(*renderer->render(1), alone), 0.01) << "the control";
      EXPECT_EQ(alone.layers.width, with_layers.layers.width);
      EXPECT_EQ(alone.statistics.accepted.total(), with_layers.statistics.accepted.total());
      EXPECT_EQ(alone.statistics.virtual_point_lights, with_layers.statistics.virtual_point_lights);
    }
  }
}

// Codes beside those that the CPU makes of the same linear picture.
struct CodesApart {
  std::size_t values = 0;  // whose code differs
  int most = 0;
};

CodesApart codes_apart(const Frame& frame, float exposure, ToneCurve curve) {
  const std::vector<std::uint8_t> right = srgb_codes(to_display(frame.picture, exposure, curve));
  EXPECT_EQ(frame.shown.size(), right.size());
  CodesApart apart;
  for (std::size_t i = 0; i < std::min(right.size(), frame.shown.size()); ++i) {
    apart.values += frame.shown[i] != right[i];
    apart.most = std::max(apart.most, std::abs(frame.shown[i] - right[i]));
  }
  return apart;
}

// Where rounding decides, a code may be the next one: rarely, as edges of codes are thin.
TEST(FrameOfTheDevicesFront, has_what_a_screen_shows_of_it) {
  Settings settings = small_settings();
  settings.engine = Engine::vulkan, settings.front = luciole::Front::rays, settings.exposure = 1.5f;
  const Front front("recipe:gallery?detail=0.05", settings);
  Result<Renderer> renderer = renderer_of(front, settings);
  ASSERT_TRUE(renderer.has_value()) << renderer.error().message;
  for (const ToneCurve curve : {ToneCurve::pbr_neutral, ToneCurve::linear}) {
    const Frame on_device = *renderer->render(0, {}, curve);
    const std::size_t values = 3 * on_device.picture.size();
    const CodesApart apart = codes_apart(on_device, settings.exposure, curve);
    EXPECT_LE(apart.values, values / 1000);
    EXPECT_LE(apart.most, 1);
    EXPECT_GT(codes_apart(on_device, 1.0f, curve).values, values / 2) << "the control: another exposure";
    EXPECT_EQ(codes_apart(*renderer->render(0, {"albedo"}, curve), settings.exposure, curve).most, 0) << "by the CPU";
  }
  EXPECT_TRUE(renderer->render(0)->shown.empty());
}

// The third frame of a moving camera. Pixels at edges may show the other surface, so that the picture is held to what
// other random numbers make.
Frame third_of_walk(const Front& front, const Settings& settings, std::uint64_t first) {
  Result<Renderer> renderer = renderer_of(front, settings);
  EXPECT_TRUE(renderer.has_value()) << renderer.error().message;
  Camera camera = front.scene->cameras.at(0);
  for (std::uint64_t frame = first; frame < first + 2; ++frame) {
    EXPECT_TRUE(renderer->render(frame).has_value());
    camera.eye.x += 0.02f;
    renderer->set_camera(camera);
  }
  return *renderer->render(first + 2);
}

double squared_difference(const Frame& a, const Frame& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.picture.size(); ++i) sum += std::pow(scatter(a.picture[i], b.picture[i]), 2);
  return sum;
}

TEST(FrameOfTheDevicesFront, is_accumulated_on_the_device_as_by_the_cpu) {
  for (const Filter filter : {Filter::none, Filter::bilateral}) {
    Settings settings = small_settings();
    settings.temporal = 8, settings.filter = filter;
    const Front front("recipe:lights?count=500", settings);
    const Frame cpu = third_of_walk(front, settings, 0), other = third_of_walk(front, settings, 8);
    settings.temporal = 1;
    const Frame alone = third_of_walk(front, settings, 0);
    settings.temporal = 8, settings.engine = Engine::vulkan, settings.front = luciole::Front::raster;
    const Frame device = third_of_walk(front, settings, 0);
    EXPECT_LT(squared_difference(device, cpu), 0.05 * squared_difference(other, cpu));
    EXPECT_GT(squared_difference(alone, cpu), 0.2 * squared_difference(other, cpu)) << "the control: no mean";
    const auto& passes = device.statistics.passes_ms;
    EXPECT_TRUE(std::any_of(passes.begin(), passes.end(),
                            [](const auto& pass) { return pass.first == "temporal_accumulation"; }));
  }
}

// From what a renderer keeps, and made anew.
TEST(FrameOfTheDevicesFront, alone_is_that_of_a_sequence) {
  Settings settings = small_settings();
  settings.engine = Engine::vulkan, settings.front = luciole::Front::rays;
  Front front("recipe:cornell?glossy=0.1", settings);
  Scene under_sky = *front.scene;  // whose image's suns move with jitter
  under_sky.environment.radiance = Vec3(1, 1, 1);
  under_sky.environment.width = 4, under_sky.environment.height = 2;
  under_sky.environment.pixels = {{1, 2, 3}, {3, 1, 1}, {0, 1, 4}, {2, 2, 2},
                                  {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  front.scene = std::make_shared<const Scene>(std::move(under_sky));
  for (const bool jitter : {false, true}) {
    settings.jitter = jitter;
    Result<Renderer> sequence = renderer_of(front, settings);
    ASSERT_TRUE(sequence.has_value()) << sequence.error().message;
    ASSERT_TRUE(sequence->render(0).has_value());
    Camera moved = front.scene->cameras.at(0);
    moved.eye.x += 0.3f;
    const Frame second = *sequence->render(1);
    sequence->set_camera(moved);
    const Frame third = *sequence->render(2);
    Result<Renderer> alone = renderer_of(front, settings);
    const Frame again = *alone->render(1);
    EXPECT_TRUE(std::equal(second.picture.begin(), second.picture.end(), again.picture.begin(),
                           [](Vec3 a, Vec3 b) { return scatter(a, b) == 0; }));
    alone->set_camera(moved);
    const Frame third_again = *alone->render(2);
    EXPECT_TRUE(std::equal(third.picture.begin(), third.picture.end(), third_again.picture.begin(),
                           [](Vec3 a, Vec3 b) { return scatter(a, b) == 0; }));
    EXPECT_GT(scatter(third.picture[1000], second.picture[1000]), 0) << "the control: the camera moved";
  }
}

TEST(FrameOfTheDevicesFront, is_of_the_scene_that_was_set_last) {
  Settings settings = small_settings();
  settings.engine = Engine::vulkan, settings.front = luciole::Front::rays;
  Front front("recipe:cornell?glossy=0.1", settings);
  Result<Renderer> renderer = renderer_of(front, settings);
  ASSERT_TRUE(renderer.has_value()) << renderer.error().message;
  const Frame before = *renderer->render(0);
  Scene moved = *front.scene;
  for (Vec3& corner : moved.meshes.back().positions) corner.y += 0.1f;
  front.scene = std::make_shared<const Scene>(std::move(moved));
  front.primaries[0].intensity.x *= 2;
  ASSERT_TRUE(renderer->set_scene(front.scene, front.primaries).has_value());
  const Frame after = *renderer->render(0), alone = *renderer_of(front, settings)->render(0);
  EXPECT_EQ(largest_difference(after, alone), 0);
  EXPECT_GT(largest_difference(after, before), 0.1) << "the control";
}

TEST(FrameOfTheDevicesFront, outlives_the_loss_of_its_device) {
  Settings settings = small_settings();
  const Front front("recipe:cornell?glossy=0.1", settings);
  const Frame cpu = *renderer_of(front, settings)->render(0);
  settings.engine = Engine::vulkan, settings.front = luciole::Front::rays;
  const Frame device = *renderer_of(front, settings)->render(0);
  settings.lost_from_submission = 6;  // each device: uploads of codes' edges, scene, maps and sources, the view, ...
  Result<Renderer> renderer = renderer_of(front, settings);
  ASSERT_TRUE(renderer.has_value()) << renderer.error().message;
  const Result<Frame> by_cpu = renderer->render(0);
  ASSERT_TRUE(by_cpu.has_value()) << by_cpu.error().message;
  EXPECT_EQ(by_cpu->statistics.engine, "cpu");
  EXPECT_EQ(by_cpu->statistics.notes.size(), 2u);
  for (std::size_t i = 0; i < cpu.picture.size(); ++i) ASSERT_EQ(scatter(by_cpu->picture[i], cpu.picture[i]), 0) << i;
}

TEST(FrameOfTheDevicesFront, is_asked_for_with_the_vulkan_engine_only) {
  Settings settings = small_settings();
  const Front front("recipe:cornell", settings);
  settings.front = luciole::Front::rays;
  EXPECT_EQ(renderer_of(front, settings).error().kind, ErrorKind::usage);
}

}  // namespace
}  // namespace luciole::test
