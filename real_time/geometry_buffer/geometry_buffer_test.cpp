// SPDX-License-Identifier: Apache-2.0
#include "real_time/geometry_buffer/geometry_buffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "real_time/front_test_scene.h"
#include "real_time/geometry_buffer/geometry_buffer_pass.h"
#include "scene/sky.h"

namespace luciole {
namespace {

using namespace front_test;

constexpr std::uint32_t kWidth = 50, kHeight = 38;  // not multiples of packets or blocks

Camera room_camera() { return look_at(Vec3(-1.2f, 1.7f, 1.8f), Vec3(0.3f, 1.0f, -0.8f), 0.9f); }

GeometryBuffer seen(const std::shared_ptr<Scene>& scene, const Camera& camera, Vec2 sub_pixel = {0.5f, 0.5f}) {
  const RayScene rays = traceable(scene);
  GeometryBuffer buffer;
  render_geometry_buffer({rays, camera, kWidth, kHeight, sub_pixel}, buffer);
  return buffer;
}

// Unit direction through a pixel, written from the definition of a camera: independent of the pass.
Vec3 pixel_direction(const Camera& camera, std::size_t pixel, double across, double down) {
  const double x = static_cast<double>(pixel % kWidth) + across, y = static_cast<double>(pixel / kWidth) + down;
  const double scale = std::tan(0.5 * static_cast<double>(camera.vertical_fov)) * 2 / kHeight;
  const auto right = static_cast<float>((x - kWidth / 2.0) * scale);
  const auto up = static_cast<float>((kHeight / 2.0 - y) * scale);
  return normalize(camera.forward + camera.right * right + camera.up * up);
}

struct Analytic {
  float distance;
  Vec3 normal;
};

// Distance and normal of what a ray inside the room meets: six planes and a perfect ball.
Analytic met_in_room(Vec3 eye, Vec3 d) {
  Analytic best{1e30f, {}};
  const auto offer = [&](float distance, Vec3 normal) {
    if (distance > 0 && distance < best.distance) best = {distance, normal};
  };
  offer(d.x > 0 ? (2 - eye.x) / d.x : (-2 - eye.x) / d.x, Vec3(d.x > 0 ? -1.0f : 1.0f, 0, 0));
  offer(d.y > 0 ? (3 - eye.y) / d.y : (0 - eye.y) / d.y, Vec3(0, d.y > 0 ? -1.0f : 1.0f, 0));
  offer(d.z > 0 ? (2 - eye.z) / d.z : (-2 - eye.z) / d.z, Vec3(0, 0, d.z > 0 ? -1.0f : 1.0f));
  const Vec3 centre(0.5f, 0.8f, -0.6f), to_eye = eye - centre;
  const float b = dot(to_eye, d), discriminant = b * b - dot(to_eye, to_eye) + 0.49f;
  if (discriminant > 0) {
    const float distance = -b - std::sqrt(discriminant);
    offer(distance, (eye + d * distance - centre) / 0.7f);
  }
  return best;
}

// Share of pixels whose position is within a millimetre, and normal within 1/50, of the analytic ones. The facets of
// the ball stay within 0.7 (1 - cos(pi/96)) = 0.4 mm of it, seen at a slant a little more; pixels on its rim differ.
double agreeing_pixels(const GeometryBuffer& buffer, double across, double down) {
  double agreeing = 0;
  for (std::size_t i = 0; i < buffer.pixel_count(); ++i) {
    const Vec3 direction = pixel_direction(buffer.camera, i, across, down);
    const Analytic expected = met_in_room(buffer.camera.eye, direction);
    const Vec3 position = buffer.camera.eye + direction * expected.distance;
    const bool on_ball = buffer.material[i] == 1;
    const float tolerance = on_ball ? 3e-3f : 1e-5f;
    agreeing += length(at(buffer.position, i) - position) < tolerance &&
                std::abs(buffer.depth[i] - dot(position - buffer.camera.eye, buffer.camera.forward)) < tolerance &&
                length(at(buffer.normal, i) - expected.normal) < 0.02f &&
                dot(at(buffer.geometric_normal, i), direction) < 0;
  }
  return agreeing / static_cast<double>(buffer.pixel_count());
}

TEST(GeometryBuffer, shows_a_room_and_a_ball_where_geometry_says) {
  const GeometryBuffer buffer = seen(room_with_ball(), room_camera());
  EXPECT_GT(agreeing_pixels(buffer, 0.5, 0.5), 0.99);
  EXPECT_LT(agreeing_pixels(buffer, 1.0, 0.5), 0.5);  // the control: half a pixel off is noticed
  const auto ball_pixels = std::count(buffer.material.begin(), buffer.material.end(), 1u);
  EXPECT_GT(ball_pixels, 100);
  EXPECT_FLOAT_EQ(buffer.diffuse_albedo[0][0], 0.6f);
  EXPECT_FLOAT_EQ(buffer.f0[2][0], 0.04f);
  EXPECT_FLOAT_EQ(buffer.f90[0], 1);
}

TEST(GeometryBuffer, rays_go_where_the_sub_pixel_position_says) {
  const GeometryBuffer buffer = seen(room_with_ball(), room_camera(), Vec2(0.1f, 0.8f));
  EXPECT_GT(agreeing_pixels(buffer, 0.1, 0.8), 0.99);
  EXPECT_LT(agreeing_pixels(buffer, 0.5, 0.5), 0.5);
  EXPECT_EQ(buffer.sub_pixel_y, 0.8f);
}

TEST(GeometryBuffer, jittered_frames_fill_the_pixel_evenly) {
  double sum_x = 0, sum_y = 0, sum_xy = 0;
  constexpr int kFrames = 256;
  int cells[16][16] = {};
  for (int frame = 0; frame < kFrames; ++frame) {
    const Vec2 p = jittered_sub_pixel(12, static_cast<std::uint64_t>(frame));
    ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
    sum_x += static_cast<double>(p.x), sum_y += static_cast<double>(p.y), sum_xy += static_cast<double>(p.x * p.y);
    ++cells[static_cast<int>(p.x * 16)][static_cast<int>(p.y * 16)];
  }
  EXPECT_NEAR(sum_x / kFrames, 0.5, 0.01);
  EXPECT_NEAR(sum_y / kFrames, 0.5, 0.01);
  EXPECT_NEAR(sum_xy / kFrames, 0.25, 0.01);
  int empty = 0;
  for (const auto& row : cells) empty += static_cast<int>(std::count(std::begin(row), std::end(row), 0));
  EXPECT_LT(empty, 64);  // independent points leave 256/e = 94 of 256 cells empty
  EXPECT_NE(jittered_sub_pixel(12, 0).x, jittered_sub_pixel(13, 0).x);
}

TEST(GeometryBuffer, sees_the_sky_where_there_is_nothing) {
  auto scene = std::make_shared<Scene>();
  scene->materials.resize(1);
  scene->meshes = {quad({-100, -1, 100}, {200, 0, 0}, {0, 0, -200})};
  scene->environment.radiance = Vec3(1, 2, 3);
  const GeometryBuffer buffer = seen(scene, look_at(Vec3(0, 0, 0), Vec3(0, 0.05f, -1), 0.8f));
  EXPECT_EQ(buffer.depth[0], kNoSurface);
  EXPECT_EQ(buffer.material[0], 0xffffffffu);
  EXPECT_EQ(buffer.emission[1][0], 2.0f);
  EXPECT_EQ(buffer.material[buffer.pixel_count() - 1], 0u);
  EXPECT_EQ(buffer.emission[1][buffer.pixel_count() - 1], 0.0f);
}

TEST(Sky, image_has_its_centre_at_minus_z_and_its_top_at_plus_y) {
  Environment sky;
  sky.radiance = Vec3(2, 2, 2);
  sky.width = 4, sky.height = 2;
  for (int i = 0; i < 8; ++i) sky.pixels.push_back(Vec3(float(i), 0, 0));
  EXPECT_FLOAT_EQ(sky_radiance(sky, Vec3(0, 1, 0)).x, 2 * 1.5f);  // between columns 1 and 2 of the top row
  const float diagonal = std::sqrt(2.0f);
  EXPECT_NEAR(sky_radiance(sky, normalize(Vec3(1, diagonal, -1))).x, 2 * 2, 1e-5f);  // right of the centre
  EXPECT_NEAR(sky_radiance(sky, normalize(Vec3(-1, -diagonal, -1))).x, 2 * 5, 1e-5f);
}

TEST(GeometryBuffer, single_sided_emission_leaves_the_front_only) {
  for (const bool double_sided : {false, true}) {
    auto scene = std::make_shared<Scene>();
    scene->materials.resize(1);
    scene->materials[0].emission = Vec3(7, 7, 7);
    scene->materials[0].double_sided = double_sided;
    scene->meshes = {quad({-5, -5, 0}, {10, 0, 0}, {0, 10, 0})};  // faces +z
    const std::size_t middle = kWidth * (kHeight / 2) + kWidth / 2;
    EXPECT_EQ(seen(scene, look_at(Vec3(0, 0, 2), Vec3(0, 0, 0), 0.8f)).emission[0][middle], 7);
    EXPECT_EQ(seen(scene, look_at(Vec3(0, 0, -2), Vec3(0, 0, 0), 0.8f)).emission[0][middle], double_sided ? 7 : 0);
  }
}

TEST(GeometryBuffer, same_bits_for_one_and_two_threads) {
  const auto hash = [](int threads, Vec2 sub_pixel) {
    GeometryBuffer buffer;
    with_threads(threads, [&] { buffer = seen(room_with_ball(), room_camera(), sub_pixel); });
    PlaneHash sum;
    for (const Plane3* planes : {&buffer.position, &buffer.normal, &buffer.geometric_normal, &buffer.diffuse_albedo,
                                 &buffer.f0, &buffer.emission}) {
      sum.add(*planes);
    }
    sum.add(buffer.depth), sum.add(buffer.ggx_alpha), sum.add(buffer.material);
    return sum.value();
  };
  EXPECT_EQ(hash(1, {0.5f, 0.5f}), hash(2, {0.5f, 0.5f}));
  EXPECT_NE(hash(1, {0.5f, 0.5f}), hash(1, {0.5f, 0.501f}));  // the control: the hash sees a thousandth of a pixel
}

}  // namespace
}  // namespace luciole
