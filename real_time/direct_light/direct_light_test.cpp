// SPDX-License-Identifier: Apache-2.0
#include "real_time/direct_light/direct_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "equations/cpp/double.h"
#include "real_time/front_test_scene.h"
#include "real_time/geometry_buffer/geometry_buffer_pass.h"

namespace luciole {
namespace {

using namespace front_test;

constexpr std::uint32_t kWidth = 53, kHeight = 31;

struct View {
  RayScene rays;
  GeometryBuffer geometry;
};

View view_of(std::shared_ptr<const Scene> scene, const Camera& camera) {
  View view{traceable(std::move(scene)), {}};
  render_geometry_buffer({view.rays, camera, kWidth, kHeight}, view.geometry);
  return view;
}

Camera room_camera() { return look_at(Vec3(-1.2f, 1.7f, 1.8f), Vec3(0.3f, 0.9f, -0.8f), 1.1f); }

PunctualLight light_of(PunctualLight::Kind kind) {
  PunctualLight light;
  light.kind = kind;
  light.position = Vec3(1.1f, 2.4f, 0.9f);
  light.direction = normalize(Vec3(-0.4f, -1, -0.6f));
  light.intensity = Vec3(9, 6, 3);
  light.cos_inner = 0.9f, light.cos_outer = 0.75f;
  return light;
}

f64::real3 wide(Vec3 v) { return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)}; }

// What an unshadowed pixel must show, in double, red channel.
double expected_red(const GeometryBuffer& g, std::size_t i, const PunctualLight& light) {
  const f64::real3 position = wide(at(g.position, i)), normal = wide(at(g.normal, i));
  const f64::real3 to_eye = normalize(wide(g.camera.eye) - position);
  const bool sun = light.kind == PunctualLight::Kind::directional;
  const f64::real3 offset = wide(light.position) - position;
  const f64::real3 to_light = sun ? -normalize(wide(light.direction)) : normalize(offset);
  if (dot(wide(at(g.geometric_normal, i)), to_light) <= 0) return 0;
  double received = static_cast<double>(light.intensity.x) / (sun ? 1.0 : dot(offset, offset));
  if (light.kind == PunctualLight::Kind::spot) {
    const double inner = static_cast<double>(light.cos_inner), outer = static_cast<double>(light.cos_outer);
    const double t = f64::clamp((-dot(to_light, wide(light.direction)) - outer) / (inner - outer), 0.0, 1.0);
    received *= t * t;
  }
  f64::SurfaceBrdf brdf;
  brdf.diffuse_albedo = wide(at(g.diffuse_albedo, i));
  brdf.f0 = wide(at(g.f0, i));
  brdf.f90 = static_cast<double>(g.f90[i]);
  brdf.ggx_alpha = static_cast<double>(g.ggx_alpha[i]);
  const f64::Reflection reflected = reflection(fix_direction(brdf, normal, to_eye), to_light);
  return (brdf.diffuse_albedo.x * reflected.diffuse + reflected.specular.x) * received;
}

std::vector<Isa> available_sets() {
  std::vector<Isa> sets;
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    if (choose_isa(isa).has_value()) sets.push_back(isa);
  }
  return sets;
}

TEST(DirectLight, is_the_full_brdf_times_what_arrives_on_every_instruction_set) {
  for (const Isa isa : available_sets()) {
    for (const auto kind : {PunctualLight::Kind::point, PunctualLight::Kind::spot, PunctualLight::Kind::directional}) {
      const PunctualLight light = light_of(kind);
      // A sun is blocked by the ceiling: it is asked in a scene without one.
      auto open = room_with_ball();
      if (kind == PunctualLight::Kind::directional) open->meshes.erase(open->meshes.begin() + 1);
      const View seen = view_of(open, room_camera());
      const Plane3 radiance = direct_light(seen.rays, seen.geometry, {light}, isa);
      int lit = 0, wrong = 0;
      for (std::size_t i = 0; i < seen.geometry.pixel_count(); ++i) {
        const auto got = static_cast<double>(radiance[0][i]);
        if (got == 0) continue;
        ++lit;
        wrong += std::abs(got / expected_red(seen.geometry, i, light) - 1) > 1e-3;
      }
      EXPECT_GT(lit, 100);
      EXPECT_EQ(wrong, 0);
    }
  }
}

// A small screen between lamp and floor: its shadow is where the line to the lamp crosses it, nowhere else.
TEST(DirectLight, a_blocker_blocks_exactly_the_pixels_behind_it) {
  auto scene = std::make_shared<Scene>();
  scene->materials.resize(1);
  scene->meshes = {quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}), quad({-0.5f, 1, 0.5f}, {1, 0, 0}, {0, 0, -1})};
  PunctualLight lamp = light_of(PunctualLight::Kind::point);
  lamp.position = Vec3(0, 2, 0);
  const View view = view_of(scene, look_at(Vec3(0, 0.6f, 3.5f), Vec3(0, 0, 0), 0.9f));
  const Plane3 radiance = direct_light(view.rays, view.geometry, {lamp}, Isa::baseline);
  int dark = 0, bright = 0;
  for (std::size_t i = 0; i < view.geometry.pixel_count(); ++i) {
    const Vec3 p = at(view.geometry.position, i);
    if (view.geometry.depth[i] == kNoSurface || p.y > 0.5f) continue;
    const float reach = std::max(std::abs(p.x), std::abs(p.z));  // the screen's shadow is twice its size
    if (std::abs(reach - 1) < 1e-3f) continue;
    EXPECT_EQ(radiance[0][i] == 0, reach < 1) << p.x << " " << p.z;
    (reach < 1 ? dark : bright) += 1;
  }
  EXPECT_GT(dark, 50);
  EXPECT_GT(bright, 50);
}

TEST(DirectLight, comes_from_nowhere_below_the_horizon_or_outside_the_cone) {
  const View view = view_of(room_with_ball(), room_camera());
  PunctualLight below = light_of(PunctualLight::Kind::point);
  below.position = Vec3(0, -1, 0);
  PunctualLight turned = light_of(PunctualLight::Kind::spot);
  turned.position = Vec3(0, 2.9f, 0), turned.direction = Vec3(0, 1, 0);  // shines into the ceiling only
  const Plane3 from_below = direct_light(view.rays, view.geometry, {below}, Isa::baseline);
  const Plane3 upwards = direct_light(view.rays, view.geometry, {turned}, Isa::baseline);
  turned.direction = Vec3(0, -1, 0);
  const Plane3 downwards = direct_light(view.rays, view.geometry, {turned}, Isa::baseline);
  int lit_floor = 0;
  for (std::size_t i = 0; i < view.geometry.pixel_count(); ++i) {
    EXPECT_EQ(from_below[1][i], 0);
    if (at(view.geometry.position, i).y > 2.5f) continue;
    EXPECT_EQ(upwards[1][i], 0);
    lit_floor += downwards[1][i] > 0;
  }
  EXPECT_GT(lit_floor, 100);  // the control: turned round it does
}

TEST(DirectLight, suns_that_are_not_primary_shine_too) {
  auto scene = room_with_ball();
  scene->meshes.erase(scene->meshes.begin() + 1);
  scene->lights = {light_of(PunctualLight::Kind::directional), light_of(PunctualLight::Kind::point)};
  const View view = view_of(scene, room_camera());
  const Plane3 other = direct_light(view.rays, view.geometry, {}, Isa::baseline);
  const Plane3 primary = direct_light(view.rays, view.geometry, {scene->lights[0]}, Isa::baseline);
  EXPECT_EQ(other, primary);
  EXPECT_GT(*std::max_element(other[0].begin(), other[0].end()), 0);
}

TEST(DirectLight, same_bits_for_one_and_two_threads) {
  const View view = view_of(room_with_ball(), room_camera());
  const PrimaryLights lights = {light_of(PunctualLight::Kind::point), light_of(PunctualLight::Kind::spot)};
  const auto hash = [&](int threads, const PrimaryLights& lit_by) {
    PlaneHash sum;
    with_threads(threads, [&] { sum.add(direct_light(view.rays, view.geometry, lit_by, Isa::baseline)); });
    return sum.value();
  };
  EXPECT_EQ(hash(1, lights), hash(2, lights));
  EXPECT_NE(hash(1, lights), hash(1, {lights[0]}));
}

}  // namespace
}  // namespace luciole
