// SPDX-License-Identifier: Apache-2.0
// Triangles are drawn where they are, the nearest stays, and what is not to be drawn is not.
#include <array>

#include "gpu/test_device.h"

namespace luciole {
extern const gpu::ShaderCode test_corners, test_words;
}

namespace luciole::gpu::test {
namespace {

constexpr std::uint32_t kSize = 16, kEmpty = 77, kWord = 5;

struct Corner {
  float x, y, z, w;
};

struct Push {
  std::uint64_t corners;
  std::uint32_t word, unused;
};

using Words = std::array<std::uint32_t, 2>;

std::vector<VkDrawIndirectCommand> one_draw(std::uint32_t triangles, std::uint32_t number) {
  return {{3 * triangles, 1, 0, number}};
}

// The pixels at the lower left of the diagonal: their centres lie there.
const std::vector<Corner> kHalf = {{-1, -1, 0.5f, 1}, {-1, 1, 0.5f, 1}, {1, 1, 0.5f, 1}};
const std::vector<Corner> kAll = {{-1, -1, 0.25f, 1}, {-1, 3, 0.25f, 1}, {3, -1, 0.25f, 1}};

struct Drawing {
  explicit Drawing(Device& device_) : device(device_) {
    Result<RasterPipeline> made =
        RasterPipeline::create(device, test_corners, test_words, sizeof(Push), PixelFormat::two_words);
    EXPECT_TRUE(made.has_value()) << made.error().message;
    Result<Image> colour_image = Image::create(device, kSize, kSize, PixelFormat::two_words);
    Result<Image> depth_image = Image::create(device, kSize, kSize, PixelFormat::depth);
    EXPECT_TRUE(colour_image.has_value() && depth_image.has_value());
    pipeline = std::move(*made), colour = std::move(*colour_image), depth = std::move(*depth_image);
  }

  // What is in the image after one rendering of all draws.
  std::vector<Words> draw(const std::vector<Corner>& corners, const std::vector<VkDrawIndirectCommand>& draws) {
    const Buffer in = upload_of(device, corners), commands = upload_of(device, draws);
    const Buffer out = make_buffer(device, kSize * kSize * sizeof(Words), BufferUse::readback);
    const Push push{in.address(), kWord, 0};
    CommandList list = make_list(device);
    list.begin_pass("draw");
    list.begin_rendering(colour, depth, kSize, kSize, {kEmpty, kEmpty});
    list.draw(pipeline, push, commands, 0, static_cast<std::uint32_t>(draws.size()));
    list.end_rendering(colour);
    list.copy(colour, out, kSize, kSize);
    status = list.run();
    EXPECT_TRUE(status.has_value()) << status.error().message;
    return values_in<Words>(out, kSize * kSize);
  }

  Device& device;
  RasterPipeline pipeline;
  Image colour, depth;
  Status status = Done{};
};

TEST(Rendering, draws_the_pixels_whose_centres_a_triangle_covers) {
  const auto device = open_device();
  ASSERT_TRUE(device);
  const std::vector<Words> seen = Drawing(*device).draw(kHalf, one_draw(1, 3));
  for (std::uint32_t y = 0; y < kSize; ++y) {
    for (std::uint32_t x = 0; x < kSize; ++x) {
      if (x == y) continue;  // on the edge
      const Words expected = x < y ? Words{3, kWord} : Words{kEmpty, kEmpty};
      ASSERT_EQ(seen[y * kSize + x], expected) << x << " " << y;
    }
  }
}

TEST(Rendering, keeps_what_is_nearest_in_any_order_and_the_first_of_equals) {
  const auto device = open_device();
  ASSERT_TRUE(device);
  Drawing drawing(*device);
  std::vector<Corner> both = kHalf;
  both.insert(both.end(), kAll.begin(), kAll.end());
  for (const bool far_first : {false, true}) {
    std::vector<VkDrawIndirectCommand> draws = {{3, 1, 0, 1}, {3, 1, 3, 2}};
    if (far_first) std::swap(draws[0], draws[1]);
    const std::vector<Words> seen = drawing.draw(both, draws);
    EXPECT_EQ(seen[kSize * (kSize - 1)], (Words{1, kWord}));
    EXPECT_EQ(seen[kSize - 1], (Words{2, kWord}));
  }
  EXPECT_EQ(drawing.draw(kAll, {{3, 1, 0, 8}, {3, 1, 0, 4}})[0], (Words{8, kWord}));
}

TEST(Rendering, of_no_instances_draws_nothing) {
  const auto device = open_device();
  ASSERT_TRUE(device);
  Drawing drawing(*device);
  for (const std::uint32_t instances : {0u, 1u}) {
    const std::vector<Words> seen = drawing.draw(kAll, {{3, instances, 0, 6}});
    EXPECT_EQ(seen[40][0], instances == 0 ? kEmpty : 6) << instances;
  }
}

TEST(Rendering, of_seventy_thousand_draws_draws_the_last) {
  const auto device = open_device();
  ASSERT_TRUE(device);
  std::vector<VkDrawIndirectCommand> draws(70000, VkDrawIndirectCommand{3, 0, 0, 0});
  draws.back() = {3, 1, 0, 69999};
  EXPECT_EQ(Drawing(*device).draw(kAll, draws)[0][0], 69999u);
}

TEST(Rendering, has_nothing_for_validation_to_say_twice_over) {
  const auto device = open_validated_device();
  ASSERT_TRUE(device);
  Drawing drawing(*device);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(drawing.draw(kAll, one_draw(1, 9))[0][0], 9u);
  EXPECT_TRUE(drawing.status.has_value()) << drawing.status.error().message;
}

// The control: synchronisation is looked at here too.
TEST(Rendering, read_before_its_end_is_found_by_validation) {
  const auto device = open_validated_device();
  ASSERT_TRUE(device);
  const Drawing drawing(*device);
  const Buffer out = make_buffer(*device, kSize * kSize * sizeof(Words), BufferUse::readback);
  CommandList list = make_list(*device);
  list.begin_pass("copy twice");
  list.begin_rendering(drawing.colour, drawing.depth, kSize, kSize, {kEmpty, kEmpty});
  list.end_rendering(drawing.colour);
  list.copy(drawing.colour, out, kSize, kSize);
  list.copy(drawing.colour, out, kSize, kSize);
  const Status done = list.run();
  ASSERT_FALSE(done.has_value());
  EXPECT_NE(done.error().message.find("SYNC-HAZARD"), std::string::npos) << done.error().message;
}

TEST(Rendering, is_refused_by_a_device_that_only_computes) {
  DeviceRequest request;
  request.may_rasterise = false;
  const auto device = open_device(request);
  ASSERT_TRUE(device);
  EXPECT_FALSE(device->description().rasterises);
  const Result<RasterPipeline> refused =
      RasterPipeline::create(*device, test_corners, test_words, sizeof(Push), PixelFormat::two_words);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("does not rasterise"), std::string::npos) << refused.error().message;
}

TEST(Image, that_is_too_large_is_refused) {
  const auto device = open_device();
  ASSERT_TRUE(device);
  const Result<Image> refused = Image::create(*device, 1u << 30, 1, PixelFormat::depth);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("draws no images of 1073741824x1 pixels"), std::string::npos);
}

}  // namespace
}  // namespace luciole::gpu::test
