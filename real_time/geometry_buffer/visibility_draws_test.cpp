// SPDX-License-Identifier: Apache-2.0
// Meshes are drawn where any point of their bounds may be seen, and not where a plane of the view has all of them
// behind it; those with holes after those without.
#include "gpu/test_device.h"
#include "real_time/geometry_buffer/pixel_block.h"
#include "real_time/geometry_buffer/raster_geometry_pass.h"
#include "scene/random_surfaces.h"

namespace luciole {

extern const gpu::ShaderCode visibility_draws;

namespace test {
namespace {

constexpr std::uint32_t kBoxes = 4000;

struct Box {
  Vec3 low, high;
};

std::vector<Box> random_boxes(Dice& dice) {
  std::vector<Box> boxes(kBoxes);
  for (Box& box : boxes) {
    const float size = std::exp2(dice.within(-8, 3));
    const Vec3 corner(dice.within(-9, 9), dice.within(-9, 9), dice.within(-9, 9));
    box = {corner, corner + Vec3(dice.unit(), dice.unit(), dice.unit()) * size};
  }
  return boxes;
}

std::vector<MeshBounds> as_meshes(const std::vector<Box>& boxes) {
  std::vector<MeshBounds> meshes;
  for (const Box& box : boxes) {
    const word_ number = static_cast<word_>(meshes.size());
    meshes.push_back({{box.low.x, box.low.y, box.low.z}, {box.high.x, box.high.y, box.high.z}, number % 7, number % 2});
  }
  return meshes;
}

std::vector<DrawRecord> draws_of(gpu::Device& device, const std::vector<MeshBounds>& meshes,
                                 const Projection& projection) {
  const gpu::Kernel kernel = gpu::test::make_kernel(device, visibility_draws, sizeof(DrawsPush));
  const gpu::Buffer bounds = gpu::test::upload_of(device, meshes);
  const std::size_t count = 2 * meshes.size();
  const gpu::Buffer draws = gpu::test::make_buffer(device, count * sizeof(DrawRecord), gpu::BufferUse::readback);
  gpu::CommandList list = gpu::test::make_list(device);
  list.begin_pass("draws");
  const auto number = static_cast<word_>(meshes.size());
  list.dispatch(kernel, DrawsPush{bounds.address(), draws.address(), projection, number}, (number + 63) / 64);
  EXPECT_TRUE(list.run().has_value());
  return gpu::test::values_in<DrawRecord>(draws, count);
}

// Signed, for the five planes between what is seen and what is not; positive: seen.
std::array<double, 5> sides(const Projection& to, Vec3 point) {
  const double p[] = {double(point.x) - double(to.eye[0]), double(point.y) - double(to.eye[1]),
                      double(point.z) - double(to.eye[2])};
  double x = 0, y = 0, w = 0;
  for (int axis = 0; axis < 3; ++axis) {
    x += double(to.x[axis]) * p[axis], y += double(to.y[axis]) * p[axis], w += double(to.w[axis]) * p[axis];
  }
  return {w, w + x, w - x, w + y, w - y};
}

// Whether some plane has all corners behind it, by more than rounding.
bool all_behind(const Projection& to, const Box& box) {
  std::array<double, 5> most;
  most.fill(-1e9);
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at((corner & 1) ? box.high.x : box.low.x, (corner & 2) ? box.high.y : box.low.y,
                  (corner & 4) ? box.high.z : box.low.z);
    const std::array<double, 5> side = sides(to, at);
    for (std::size_t i = 0; i < 5; ++i) most[i] = std::max(most[i], side[i]);
  }
  return *std::min_element(most.begin(), most.end()) < -1e-3;
}

bool shows(Dice& dice, const Projection& to, const Box& box) {
  for (int i = 0; i < 100; ++i) {
    const Vec3 part(dice.unit(), dice.unit(), dice.unit());
    const std::array<double, 5> side = sides(to, box.low + part * (box.high - box.low));
    if (*std::min_element(side.begin(), side.end()) > 0) return true;
  }
  return false;
}

TEST(VisibilityDraws, are_of_the_meshes_that_can_be_seen) {
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  Dice dice(3);
  const std::vector<Box> boxes = random_boxes(dice);
  const std::vector<MeshBounds> meshes = as_meshes(boxes);
  const DeviceView view{look_at(Vec3(1, 2, 3), Vec3(-2, 1, -4), 0.9f), 160, 90};
  const Projection projection = projection_of(view, {Vec3(-9, -9, -9), Vec3(17, 17, 17)});
  const std::vector<DrawRecord> draws = draws_of(*device, meshes, projection);
  std::size_t seen = 0, hidden = 0;
  for (word_ i = 0; i < kBoxes; ++i) {
    const DrawRecord &wanted = draws[i + (i % 2) * kBoxes], &other = draws[i + (1 - i % 2) * kBoxes];
    EXPECT_EQ(other.instances, 0u);
    EXPECT_EQ(wanted.vertices, 3 * (i % 7));
    EXPECT_EQ(wanted.mesh, i);
    if (i % 7 == 0) {
      EXPECT_EQ(wanted.instances, 0u);
    } else if (shows(dice, projection, boxes[i])) {
      EXPECT_EQ(wanted.instances, 1u) << i;
      ++seen;
    } else if (all_behind(projection, boxes[i])) {
      EXPECT_EQ(wanted.instances, 0u) << i;
      ++hidden;
    }
  }
  EXPECT_GT(seen, kBoxes / 50u);
  EXPECT_GT(hidden, kBoxes / 2u);
}

// A point on the ray of a pixel is drawn at that pixel's centre, at its depth.
TEST(Projection, puts_rays_at_the_centres_of_their_pixels) {
  const DeviceView view{look_at(Vec3(1, 2, 3), Vec3(-2, 1, -4), 0.9f), 160, 90, {0.3f, 0.6f}};
  const Projection to = projection_of(view, {Vec3(-9, -9, -9), Vec3(9, 9, 9)});
  const ScreenRays screen(view.camera, view.width, view.height, view.sub_pixel);
  for (const std::uint32_t x : {0u, 100u, 159u}) {
    for (const std::uint32_t y : {0u, 50u, 89u}) {
      const float depth = 2.5f;
      const std::array<double, 5> side = sides(to, screen.eye + screen.direction(x, y) * depth);
      const double w = side[0], column = side[1] / w / 2 * view.width, row = side[3] / w / 2 * view.height;
      // The point, moved by an ulp of a few metres, in pixels at that depth.
      const double rounding = 8 * 0x1p-24 * 4 / double(screen.pixel_size * depth);
      EXPECT_NEAR(column, x + 0.5, rounding);
      EXPECT_NEAR(row, y + 0.5, rounding);
      EXPECT_NEAR(w, double(depth), 32 * 0x1p-24);
    }
  }
  EXPECT_GT(to.near, 0);
  EXPECT_LT(to.near, 1e-4f);  // for a scene of a dozen metres
}

}  // namespace
}  // namespace test
}  // namespace luciole
