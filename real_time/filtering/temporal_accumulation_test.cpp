// SPDX-License-Identifier: Apache-2.0
// A view that stands still converges to its mean; one that moves goes on from what it saw, and from nothing else.
#include "real_time/filtering/temporal_accumulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/parallel.h"
#include "ray_tracing/ray_scene.h"
#include "real_time/frame.h"
#include "real_time/geometry_buffer/geometry_buffer_pass.h"
#include "scene/recipes/recipes.h"

namespace luciole {
namespace {

constexpr const char* kScene = "recipe:cornell?glossy=0.1";

struct Stage {
  std::shared_ptr<const Scene> scene;
  Camera camera;
  PrimaryLights primaries;
  Settings settings;

  Stage() : scene(std::make_shared<const Scene>(std::move(*make_recipe_from_address(kScene)))) {
    camera = scene->cameras.at(0);
    primaries = {scene->lights.at(0)};
    settings.width = 120, settings.height = 90, settings.vpls = 3000, settings.exposure = 2.0f, settings.delta = 0.01f;
    settings.filter = Filter::none;
  }
  Camera moved(float right) const {
    Camera to = camera;
    to.eye = to.eye + to.right * right;
    return to;
  }
  Renderer renderer() const { return std::move(*Renderer::create(scene, camera, primaries, settings)); }
};

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

bool is_blocked(const RayScene& scene, Vec3 from, Vec3 to) {
  RayPacket rays;
  for (int lane = 0; lane < kPacketRays; ++lane) rays.skip(lane);
  rays.set(0, from, to - from, 0, 1);
  return scene.occluded(rays, Coherence::incoherent) != 0;
}

// Mean square difference of the noisy light from what it must be on average, over the mean square of that.
double relative_error(const Frame& frame) {
  const std::vector<Vec3> noisy = frame.layers.colours("unfiltered"), truth = frame.layers.colours("reference");
  double error = 0, size = 0;
  for (std::size_t i = 0; i < noisy.size(); ++i) {
    const Vec3 apart = noisy[i] - truth[i];
    error += dot(apart, apart), size += dot(truth[i], truth[i]);
  }
  return error / size;
}

double relative_bias(const Frame& frame) {
  const std::vector<Vec3> noisy = frame.layers.colours("unfiltered"), truth = frame.layers.colours("reference");
  double sum = 0, size = 0;
  for (std::size_t i = 0; i < noisy.size(); ++i)
    sum += channel_mean(noisy[i] - truth[i]), size += channel_mean(truth[i]);
  return sum / size;
}

TEST(TemporalAccumulation, of_a_view_that_stands_still_is_the_mean_of_its_frames) {
  constexpr std::uint64_t kFrames = 6;
  Stage stage;
  Renderer single = stage.renderer();
  stage.settings.temporal = 100;
  Renderer accumulating = stage.renderer();
  std::vector<Vec3> sum(std::size_t(120) * 90, Vec3(0, 0, 0)), mean, last;
  for (std::uint64_t f = 0; f < kFrames; ++f) {
    last = single.render(f)->picture;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += last[i] * (1.0f / kFrames);
    mean = accumulating.render(f)->picture;
    if (f == 0) {
      EXPECT_TRUE(same_bits(mean, last));
    }
  }
  double apart = 0, noise = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    apart += dot(mean[i] - sum[i], mean[i] - sum[i]), noise += dot(last[i] - sum[i], last[i] - sum[i]);
  }
  EXPECT_GT(noise, 0);
  EXPECT_LT(apart / noise, 1e-9);  // rounding
}

// Error falls as one over the frames in the mean; fewer of them where the surface was not in sight all the time.
TEST(TemporalAccumulation, of_a_moving_view_is_less_noisy_and_no_darker) {
  Stage stage;
  constexpr std::uint64_t kFrames = 16;
  const auto last_frame = [&](std::uint32_t longest) {
    stage.settings.temporal = longest;
    Renderer renderer = stage.renderer();
    for (std::uint64_t f = 0; f + 1 < kFrames; ++f) {
      renderer.set_camera(stage.moved(0.01f * static_cast<float>(f)));
      EXPECT_TRUE(renderer.render(f).has_value());
    }
    renderer.set_camera(stage.moved(0.01f * static_cast<float>(kFrames - 1)));
    return std::move(*renderer.render(kFrames - 1, {"unfiltered", "reference", "history"}));
  };
  const Frame alone = last_frame(1), four = last_frame(4), all = last_frame(kFrames);
  EXPECT_LT(relative_error(four), 0.5 * relative_error(alone));
  EXPECT_LT(relative_error(all), 0.2 * relative_error(alone));
  // What a few hundredths of a metre change in the light, and no more.
  EXPECT_LT(std::abs(relative_bias(all)), 0.02);
  const std::vector<float>&history = all.layers.channels.at("history.V"),
        &of_four = four.layers.channels.at("history.V");
  EXPECT_EQ(*std::max_element(of_four.begin(), of_four.end()), 4.0f);
  EXPECT_LE(*std::max_element(history.begin(), history.end()), float(kFrames));
}

TEST(TemporalAccumulation, starts_anew_where_the_surface_was_hidden) {
  Stage stage;
  stage.settings.temporal = 8;
  Renderer renderer = stage.renderer();
  EXPECT_TRUE(renderer.render(0).has_value());
  const Camera now = stage.moved(1.0f);
  renderer.set_camera(now);
  const Frame frame = std::move(*renderer.render(1, {"history", "depth"}));
  const RayScene rays = std::move(*RayScene::create(stage.scene));
  GeometryBuffer geometry;
  render_geometry_buffer({rays, now, 120, 90}, geometry);
  const std::vector<float>& history = frame.layers.channels.at("history.V");
  int hidden = 0, hidden_known = 0, seen = 0, seen_known = 0;
  const float half_height = std::tan(0.5f * now.vertical_fov), half_width = half_height * 120 / 90;
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (geometry.depth[i] == kNoSurface) continue;
    const Vec3 p(geometry.position[0][i], geometry.position[1][i], geometry.position[2][i]);
    const Vec3 n(geometry.geometric_normal[0][i], geometry.geometric_normal[1][i], geometry.geometric_normal[2][i]);
    const Vec3 to_eye = stage.camera.eye - p;
    const float depth = -dot(to_eye, stage.camera.forward);
    const bool in_sight = std::abs(dot(to_eye, stage.camera.right)) < half_width * depth &&
                          std::abs(dot(to_eye, stage.camera.up)) < half_height * depth && dot(to_eye, n) > 0;
    const bool visible = in_sight && !is_blocked(rays, rays.offset_from_surface(p, n), stage.camera.eye);
    (visible ? seen : hidden) += 1;
    (visible ? seen_known : hidden_known) += history[i] > 1;
  }
  EXPECT_GT(hidden, 200);
  EXPECT_LT(hidden_known, 0.05 * hidden);  // pixels at edges, whose neighbours were in sight
  EXPECT_GT(seen_known, 0.9 * seen);
}

TEST(TemporalAccumulation, of_another_view_altogether_is_the_frame_alone) {
  Stage stage;
  const Camera elsewhere = [&] {
    Camera turned = stage.camera;
    turned.eye = stage.camera.eye + stage.camera.forward * 0.5f;
    turned.forward = stage.camera.right, turned.right = -stage.camera.forward;
    return turned;
  }();
  Renderer alone = stage.renderer();
  alone.set_camera(elsewhere);
  stage.settings.temporal = 8;
  Renderer accumulating = stage.renderer();
  EXPECT_TRUE(accumulating.render(0).has_value());
  accumulating.set_camera(elsewhere);
  const Frame frame = std::move(*accumulating.render(1, {"history"})), expected = std::move(*alone.render(1));
  const std::vector<float>& history = frame.layers.channels.at("history.V");
  int fresh = 0;
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (history[i] > 1) continue;
    ++fresh;
    EXPECT_EQ(std::memcmp(&frame.picture[i], &expected.picture[i], sizeof(Vec3)), 0) << i;
  }
  EXPECT_GT(fresh, 0.5 * static_cast<double>(history.size()));
}

TEST(TemporalAccumulation, has_the_same_bits_on_any_number_of_threads) {
  Stage stage;
  stage.settings.temporal = 8, stage.settings.jitter = true;
  std::vector<Vec3> pictures[2];
  for (int k = 0; k < 2; ++k) {
    with_threads(1 + 2 * k, [&] {
      Renderer renderer = stage.renderer();
      for (std::uint64_t f = 0; f < 3; ++f) {
        renderer.set_camera(stage.moved(0.02f * static_cast<float>(f)));
        pictures[k] = renderer.render(f)->picture;
      }
    });
  }
  EXPECT_TRUE(same_bits(pictures[0], pictures[1]));
}

// The light of a room made up: all pixels alike, frame by frame another value.
class MadeUpLight {
 public:
  MadeUpLight() : rays_(std::move(*RayScene::create(stage_.scene))) {}

  void add_frame(float right, float value, float alpha) {
    render_geometry_buffer({rays_, stage_.moved(right), 60, 45}, geometry);
    std::fill(geometry.ggx_alpha.begin(), geometry.ggx_alpha.end(), alpha);
    light.resize(geometry.pixel_count());
    for (Plane3* planes : {&light.diffuse, &light.specular}) {
      for (Plane& plane : *planes) std::fill(plane.begin(), plane.end(), value);
    }
    pass_.run({geometry, ++view_, 100}, light, none_);
  }
  const Plane& frames() const { return pass_.frames(); }

  GeometryBuffer geometry;
  Radiance light;

 private:
  Stage stage_;
  RayScene rays_;
  TemporalAccumulationPass pass_;
  Radiance none_;
  std::uint64_t view_ = 0;
};

TEST(TemporalAccumulation, soon_forgets_what_smooth_surfaces_reflected_elsewhere) {
  for (const float alpha : {1.0f, 0.001f}) {
    MadeUpLight room;
    for (int f = 0; f < 10; ++f) room.add_frame(0.02f * static_cast<float>(f), f < 9 ? 1.0f : 2.0f, alpha);
    double diffuse = 0, specular = 0;
    for (std::size_t i = 0; i < room.geometry.pixel_count(); ++i) {
      if (room.frames()[i] != 10) continue;
      diffuse = std::max(diffuse, double(room.light.diffuse[0][i]));
      specular = std::max(specular, double(room.light.specular[0][i]));
    }
    EXPECT_NEAR(diffuse, 1.1, 1e-4) << alpha;
    if (alpha == 1.0f) {
      EXPECT_NEAR(specular, 1.1, 0.01);
    } else {
      EXPECT_GT(specular, 1.5);
    }
  }
}

// Before there is a past, its camera is nowhere in particular, be it at the surface itself.
TEST(TemporalAccumulation, begins_where_no_camera_was) {
  Stage stage;
  const RayScene rays = std::move(*RayScene::create(stage.scene));
  GeometryBuffer geometry;
  render_geometry_buffer({rays, stage.camera, 60, 45}, geometry);
  const std::size_t pixel = geometry.pixel_count() / 2;
  for (Plane& axis : geometry.position) axis[pixel] = 0;
  Radiance light, none;
  light.resize(geometry.pixel_count());
  for (Plane3* planes : {&light.diffuse, &light.specular}) {
    for (Plane& plane : *planes) std::fill(plane.begin(), plane.end(), 1.0f);
  }
  TemporalAccumulationPass pass;
  pass.run({geometry, 1, 100}, light, none);
  EXPECT_EQ(light.specular[0][pixel], 1.0f);
  EXPECT_EQ(pass.frames()[pixel], 1.0f);
}

TEST(TemporalAccumulation, leaves_out_light_that_is_not_finite) {
  MadeUpLight room;
  room.add_frame(0, 1.0f, 0.1f);
  room.add_frame(0, std::numeric_limits<float>::quiet_NaN(), 0.1f);
  for (std::size_t i = 0; i < room.geometry.pixel_count(); ++i) {
    if (room.geometry.depth[i] == kNoSurface) continue;
    ASSERT_EQ(room.light.diffuse[0][i], 1.0f) << i;
    ASSERT_EQ(room.frames()[i], 1.0f) << i;
  }
  room.add_frame(0, 3.0f, 0.1f);
  EXPECT_EQ(room.light.diffuse[0][room.geometry.pixel_count() / 2], 2.0f);
}

}  // namespace
}  // namespace luciole
