// SPDX-License-Identifier: Apache-2.0
// A frame under the validation layers: core, synchronisation and GPU-assisted checks. By itself, as software Vulkan
// takes half a minute to compile kernels in which each access is checked.
#include "real_time/vulkan_test_front.h"

namespace luciole::test {
namespace {

// All kernels run: the scene has virtual point lights of both lobes and other lights. gpu/gpu_test.cpp shows that the
// layers find what they are there for.
TEST(Validation, has_nothing_to_say_of_a_frame) {
  Settings settings = small_settings();
  settings.engine = Engine::vulkan, settings.vulkan_validation = true, settings.filter = Filter::bilateral;
  const Front front("recipe:lights?count=500", settings);
  ASSERT_GT(front.vpls.size(), 0u);
  ASSERT_GT(front.many.size(), 0u);
  Result<Renderer> renderer = Renderer::create(front.scene, front.scene->cameras.at(0), front.primaries, settings);
  ASSERT_TRUE(renderer.has_value()) << renderer.error().message;
  const Result<Frame> frame = renderer->render(0);
  EXPECT_TRUE(frame.has_value()) << frame.error().message;
}

}  // namespace
}  // namespace luciole::test
