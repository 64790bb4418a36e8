// SPDX-License-Identifier: Apache-2.0
// The Vulkan engine makes the CPU engine's frame; it refuses what it cannot do, and outlives the loss of its device.
#include "image/metrics.h"
#include "real_time/vulkan_test_front.h"

namespace luciole::test {
namespace {

Result<Frame> render(const Front& front, const Settings& settings, std::uint64_t index = 0) {
  Result<Renderer> renderer = Renderer::create(front.scene, front.scene->cameras.at(0), front.primaries, settings);
  if (!renderer) return renderer.error();
  return renderer->render(index, Renderer::layer_names());
}

Image image_of(const Frame& frame) {
  Image image;
  image.width = frame.width, image.height = frame.height;
  image.set_colours("", frame.picture);
  return image;
}

double relmse(const Frame& picture, const Frame& reference) {
  return compare(image_of(picture), image_of(reference))->relmse;
}

TEST(VulkanFrame, is_the_cpus_frame_with_the_same_layers_and_counts) {
  for (const char* address : kScenes) {
    for (const Ranges ranges : {Ranges::stochastic, Ranges::clamped}) {
      Settings settings = small_settings();
      settings.ranges = ranges, settings.filter = Filter::bilateral;
      settings.tile_test = TileTest::paper;  // without the CPU's second test, of 16 pixels
      const Front front(address, settings);
      const Result<Frame> cpu = render(front, settings);
      Settings other_seed = settings;
      other_seed.seed = 2;
      const Result<Frame> another = render(front, other_seed);
      settings.engine = Engine::vulkan;
      const Result<Frame> device = render(front, settings);
      ASSERT_TRUE(device.has_value()) << device.error().message;
      // What a light more or less does to a pixel or two, against what other random numbers do to all.
      EXPECT_LT(relmse(*device, *cpu), 1e-3 * relmse(*another, *cpu)) << address;
      ASSERT_EQ(device->layers.channels.size(), cpu->layers.channels.size());
      for (const auto& [name, values] : cpu->layers.channels)
        EXPECT_EQ(device->layers.channels.count(name), 1u) << name;
      EXPECT_NEAR(device->statistics.accepted.total() / cpu->statistics.accepted.total(), 1.0, 1e-3) << address;
      EXPECT_EQ(device->statistics.tests.total(), cpu->statistics.tests.total()) << address;
      EXPECT_GT(device->statistics.tests.total(), 0) << address;
      EXPECT_EQ(device->statistics.engine, "vulkan");
      EXPECT_EQ(cpu->statistics.engine, "cpu");
    }
  }
}

TEST(VulkanFrame, has_the_lobes_that_are_wanted) {
  Settings settings = small_settings();
  const Front front("recipe:cornell?glossy=0.1", settings);
  const Result<Frame> all = render(front, settings);
  for (const Lobes lobes : {Lobes::diffuse, Lobes::glossy}) {
    settings.lobes = lobes, settings.engine = Engine::cpu;
    const Result<Frame> cpu = render(front, settings);
    settings.engine = Engine::vulkan;
    const Result<Frame> device = render(front, settings);
    ASSERT_TRUE(device.has_value()) << device.error().message;
    EXPECT_LT(relmse(*device, *cpu), 1e-3 * relmse(*all, *cpu)) << to_string(lobes);
  }
}

// From the first pass on the device on.
std::vector<std::string> passes_of(const Frame& frame) {
  std::vector<std::string> passes;
  for (const auto& [pass, ms] : frame.statistics.passes_ms) passes.push_back(pass);
  passes.erase(passes.begin(), std::find(passes.begin(), passes.end(), "light_range"));
  return passes;
}

// What comes back is the filtered light; with the layer of the unfiltered one that comes too, and changes nothing.
TEST(VulkanFrame, is_filtered_on_the_device) {
  Settings settings = small_settings();
  const Front front("recipe:lights?count=500", settings);
  settings.engine = Engine::vulkan;
  const Result<Frame> noisy = render(front, settings);
  settings.filter = Filter::bilateral;
  const Result<Frame> with_layers = render(front, settings);
  Result<Renderer> renderer = Renderer::create(front.scene, front.scene->cameras.at(0), front.primaries, settings);
  ASSERT_TRUE(renderer.has_value()) << renderer.error().message;
  const Result<Frame> alone = renderer->render(0);
  ASSERT_TRUE(alone.has_value()) << alone.error().message;
  EXPECT_EQ(relmse(*alone, *with_layers), 0);
  for (const char* channel : {"unfiltered.R", "unfiltered.G", "unfiltered.B"})
    EXPECT_EQ(with_layers->layers.channels.at(channel), noisy->layers.channels.at(channel));
  EXPECT_GT(relmse(*noisy, *alone), 0);
  EXPECT_EQ(passes_of(*alone),
            (std::vector<std::string>{"light_range", "culling_and_shading", "filtering", "transfer", "composition"}));
}

// Light is accumulated before it is filtered, and the CPU accumulates.
TEST(VulkanFrame, that_is_accumulated_is_filtered_by_the_cpu) {
  Settings settings = small_settings();
  settings.filter = Filter::bilateral, settings.temporal = 4;
  const Front front("recipe:cornell?glossy=0.1", settings);
  const auto second = [&](Engine engine, std::uint64_t first) {
    settings.engine = engine;
    Result<Renderer> renderer = Renderer::create(front.scene, front.scene->cameras.at(0), front.primaries, settings);
    EXPECT_TRUE(renderer.has_value()) << renderer.error().message;
    EXPECT_TRUE(renderer->render(first).has_value());
    return *renderer->render(first + 1);
  };
  const Frame device = second(Engine::vulkan, 0), cpu = second(Engine::cpu, 0), another = second(Engine::cpu, 8);
  EXPECT_LT(relmse(device, cpu), 1e-3 * relmse(another, cpu));
  EXPECT_EQ(passes_of(device), (std::vector<std::string>{"light_range", "culling_and_shading", "transfer",
                                                         "temporal_accumulation", "filtering", "composition"}));
}

// Shadow rays and the rivals of tiled culling, too. Where a shadow ray grazes an edge the engines may differ.
TEST(VulkanFrame, has_shadow_rays_and_the_rivals) {
  Settings settings = small_settings();
  const Front front("recipe:lights?count=500", settings);
  const Result<Frame> open = render(front, settings);
  for (const Culling culling : {Culling::tiled, Culling::clustered, Culling::splatting}) {
    for (const bool shadows : {false, true}) {
      settings.culling = culling, settings.direct_shadows = shadows, settings.engine = Engine::cpu;
      const Result<Frame> cpu = render(front, settings);
      settings.engine = Engine::vulkan;
      const Result<Frame> device = render(front, settings);
      ASSERT_TRUE(device.has_value()) << device.error().message;
      const std::string what = to_string(culling) + (shadows ? " with shadows" : "");
      EXPECT_LT(relmse(*device, *cpu), 0.01 * std::max(relmse(*open, *cpu), relmse(*render(front, settings, 1), *cpu)))
          << what;
      EXPECT_NEAR(device->statistics.accepted.total() / cpu->statistics.accepted.total(), 1.0, 1e-3) << what;
      if (!shadows) continue;
      EXPECT_GT(relmse(*open, *cpu), 1e-3) << "the control: shadows are seen";
    }
  }
}

TEST(VulkanFrame, of_settings_that_no_engine_can_do_is_refused) {
  Settings settings = small_settings();
  const Front front("recipe:cornell", settings);
  settings.engine = Engine::vulkan, settings.device = "no such device";
  EXPECT_EQ(render(front, settings).error().kind, ErrorKind::usage);
  settings.device.clear(), settings.engine = Engine::cpu, settings.vulkan_validation = true;
  EXPECT_EQ(render(front, settings).error().kind, ErrorKind::usage);
}

TEST(VulkanFrame, by_the_automatic_engine_is_computed_by_hardware_only) {
  Settings settings = small_settings();
  settings.engine = Engine::automatic;
  const Front front("recipe:cornell", settings);
  const auto vulkan = gpu::Instance::create(false);
  ASSERT_TRUE(vulkan.has_value());
  const bool hardware = gpu::choose_device(gpu::list_devices(**vulkan), "", true).has_value();
  Result<Renderer> renderer = Renderer::create(front.scene, front.scene->cameras.at(0), front.primaries, settings);
  ASSERT_TRUE(renderer.has_value());
  EXPECT_EQ(renderer->settings().engine, hardware ? Engine::vulkan : Engine::cpu);
}

// A device that is lost is opened anew; one that is lost again leaves the frame to the CPU.
TEST(VulkanFrame, outlives_the_loss_of_its_device) {
  Settings settings = small_settings();
  const Front front("recipe:cornell?glossy=0.1", settings);
  const Result<Frame> cpu = render(front, settings);
  settings.engine = Engine::vulkan;
  const Result<Frame> device = render(front, settings, 1);
  settings.lost_from_submission = 7;  // in the second frame of the first device; the second one does one frame
  Result<Renderer> renderer = Renderer::create(front.scene, front.scene->cameras.at(0), front.primaries, settings);
  ASSERT_TRUE(renderer.has_value());
  EXPECT_TRUE(renderer->render(0)->statistics.notes.empty());
  const Result<Frame> second = renderer->render(1);
  ASSERT_TRUE(second.has_value()) << second.error().message;
  ASSERT_EQ(second->statistics.notes.size(), 1u);
  EXPECT_NE(second->statistics.notes[0].find("opened anew"), std::string::npos) << second->statistics.notes[0];
  EXPECT_EQ(relmse(*second, *device), 0) << "smaller parts, the same bits";
  EXPECT_EQ(second->statistics.engine, "vulkan");
  const Result<Frame> third = renderer->render(0);
  ASSERT_TRUE(third.has_value()) << third.error().message;
  EXPECT_EQ(third->statistics.engine, "cpu");
  EXPECT_NE(third->statistics.notes.at(0).find("the CPU engine goes on"), std::string::npos);
  EXPECT_EQ(relmse(*third, *cpu), 0);
  EXPECT_EQ(renderer->settings().engine, Engine::cpu);
}

TEST(VulkanFrame, whose_device_is_lost_while_it_filters_is_filtered_by_the_cpu) {
  Settings settings = small_settings();
  settings.filter = Filter::bilateral;
  const Front front("recipe:cornell?glossy=0.1", settings);
  const Result<Frame> cpu = render(front, settings);
  settings.engine = Engine::vulkan;
  settings.lost_from_submission = 5;  // after the edges of codes, ranges and two kinds of lights
  const Result<Frame> device = render(front, settings);
  ASSERT_TRUE(device.has_value()) << device.error().message;
  EXPECT_EQ(device->statistics.engine, "cpu");
  EXPECT_EQ(relmse(*device, *cpu), 0);
}

}  // namespace
}  // namespace luciole::test
