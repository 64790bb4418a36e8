// SPDX-License-Identifier: Apache-2.0
#include "ray_tracing/ray_scene.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <memory>

#include "base/parallel.h"

namespace luciole {
namespace {

// A square of side 2 in the plane z = `depth`, facing +z.
Mesh square(float depth) {
  Mesh mesh;
  mesh.positions = {{-1, -1, depth}, {1, -1, depth}, {1, 1, depth}, {-1, 1, depth}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

std::shared_ptr<Scene> scene_of(std::vector<Mesh> meshes) {
  auto scene = std::make_shared<Scene>();
  scene->meshes = std::move(meshes);
  scene->materials.resize(1);
  return scene;
}

RayPacket rays_along_minus_z(Vec3 first_origin, float step) {
  RayPacket rays;
  for (int lane = 0; lane < kPacketRays; ++lane) {
    rays.set(lane, first_origin + Vec3(step * float(lane), 0, 0), Vec3(0, 0, -1), 0, 1e30f);
  }
  return rays;
}

TEST(RayScene, meets_the_nearest_surface_and_says_where) {
  const auto rays_scene = RayScene::create(scene_of({square(-3), square(-5)}));
  ASSERT_TRUE(rays_scene.has_value());
  RayPacket rays = rays_along_minus_z(Vec3(-0.9f, 0.3f, 0), 0.2f);
  rays.skip(3);
  for (const Coherence coherence : {Coherence::coherent, Coherence::incoherent}) {
    const HitPacket hits = rays_scene->intersect(rays, coherence);
    for (int lane = 0; lane < kPacketRays; ++lane) {
      const float x = -0.9f + 0.2f * float(lane);
      if (lane == 3 || x > 1) {
        EXPECT_EQ(hits.mesh[lane], kNoHit);
        continue;
      }
      ASSERT_EQ(hits.mesh[lane], 0u);
      EXPECT_FLOAT_EQ(hits.distance[lane], 3.0f);
      const Mesh& mesh = rays_scene->scene().meshes[0];
      const std::uint32_t* index = &mesh.indices[3 * hits.triangle[lane]];
      const Vec3 p0 = mesh.positions[index[0]], p1 = mesh.positions[index[1]], p2 = mesh.positions[index[2]];
      const Vec3 met = p0 + (p1 - p0) * hits.u[lane] + (p2 - p0) * hits.v[lane];
      EXPECT_NEAR(met.x, x, 1e-6f);
      EXPECT_NEAR(met.y, 0.3f, 1e-6f);
    }
  }
}

TEST(RayScene, is_blocked_only_between_nearest_and_farthest) {
  const auto rays_scene = RayScene::create(scene_of({square(-3)}));
  ASSERT_TRUE(rays_scene.has_value());
  RayPacket rays;
  for (int lane = 0; lane < kPacketRays; ++lane) rays.skip(lane);
  rays.set(0, Vec3(0, 0, 0), Vec3(0, 0, -1), 0, 2.9f);
  rays.set(1, Vec3(0, 0, 0), Vec3(0, 0, -1), 0, 3.1f);
  rays.set(2, Vec3(0, 0, 0), Vec3(0, 0, -1), 3.1f, 9.0f);
  rays.set(3, Vec3(0, 0, -6), Vec3(0, 0, 1), 0, 9.0f);  // the back side blocks too
  EXPECT_EQ(rays_scene->occluded(rays, Coherence::incoherent), 0b1010u);
}

TEST(RayScene, a_ray_that_starts_on_a_large_slanted_triangle_misses_it) {
  Mesh slope;
  slope.positions = {{-180, -33, 71}, {205, 12, 140}, {-7, 90, -260}};
  slope.indices = {0, 1, 2};
  const Vec3 e1 = slope.positions[1] - slope.positions[0], e2 = slope.positions[2] - slope.positions[0];
  const Vec3 normal = normalize(cross(e1, e2));
  const auto rays_scene = RayScene::create(scene_of({slope}));
  ASSERT_TRUE(rays_scene.has_value());
  int blocked = 0, blocked_without_offset = 0;
  for (int i = 0; i < 4096; ++i) {
    RayPacket with, without;
    for (int lane = 0; lane < kPacketRays; ++lane) {
      const float u = float((i * 16 + lane) * 7919 % 65536) / 65536, v = (1 - u) * float(i % 101) / 101;
      const Vec3 point = slope.positions[0] + e1 * u + e2 * v;
      const Vec3 grazing = normalize(normalize(e1) * std::cos(float(i)) +
                                     cross(normal, normalize(e1)) * std::sin(float(i)) + normal * 0.01f);
      with.set(lane, rays_scene->offset_from_surface(point, normal), grazing, 0, 1e30f);
      without.set(lane, point, grazing, 0, 1e30f);
    }
    blocked += std::popcount(rays_scene->occluded(with, Coherence::incoherent));
    blocked_without_offset += std::popcount(rays_scene->occluded(without, Coherence::incoherent));
  }
  EXPECT_EQ(blocked, 0);
  EXPECT_GT(blocked_without_offset, 100);  // the control: without the offset the surface shadows itself
}

// A texture of 2x1 texels: the left one is a hole.
std::shared_ptr<Scene> scene_with_hole(AlphaMode mode) {
  auto scene = scene_of({square(-3), square(-5)});
  auto image = std::make_shared<MipImage>();
  image->levels = {{2, 1, 0}};
  image->rgba = {255, 255, 255, 0, 255, 255, 255, 255};
  image->has_alpha = true;
  Texture texture;
  texture.image = image;
  texture.magnify_linear = texture.minify_linear = false;
  scene->textures = {texture};
  scene->materials.resize(2);
  scene->materials[1].alpha_mode = mode;
  scene->materials[1].base_colour_texture.texture = 0;
  scene->meshes[0].material = 1;
  scene->meshes[0].uv[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  return scene;
}

TEST(RayScene, sees_through_the_holes_of_alpha_masks) {
  for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend, AlphaMode::opaque}) {
    const auto rays_scene = RayScene::create(scene_with_hole(mode));
    ASSERT_TRUE(rays_scene.has_value());
    RayPacket rays = rays_along_minus_z(Vec3(-0.9f, 0.3f, 0), 0.11f);
    const HitPacket hits = rays_scene->intersect(rays, Coherence::coherent);
    for (int lane = 0; lane < kPacketRays; ++lane) rays.farthest[lane] = 4;
    const std::uint32_t blocked = rays_scene->occluded(rays, Coherence::incoherent);
    for (int lane = 0; lane < kPacketRays; ++lane) {
      const bool hole = rays.origin_x[lane] < 0 && mode != AlphaMode::opaque;  // the control: the alpha is ignored
      EXPECT_EQ(hits.mesh[lane], hole ? 1u : 0u);
      EXPECT_EQ((blocked >> lane & 1) != 0, !hole);
    }
  }
}

TEST(RayScene, every_instruction_set_meets_the_same_triangles) {
  for (const char* isa : {"", "baseline", "avx2"}) {
    RayTracingOptions options;
    options.isa = isa;
    options.robust = true;
    const auto rays_scene = RayScene::create(scene_of({square(-3)}), options);
    ASSERT_TRUE(rays_scene.has_value()) << isa;
    const HitPacket hits = rays_scene->intersect(rays_along_minus_z(Vec3(-0.9f, 0.3f, 0), 0.1f), Coherence::coherent);
    for (int lane = 0; lane < kPacketRays; ++lane) EXPECT_EQ(hits.mesh[lane], 0u) << isa;
  }
}

TEST(RayScene, reports_lack_of_memory_as_one_sentence) {
  Mesh grid;
  for (int i = 0; i < 40000; ++i) grid.positions.push_back(Vec3(float(i % 200), float(i / 200), 0));
  for (std::uint32_t i = 0; i + 201 < 40000; ++i) grid.indices.insert(grid.indices.end(), {i, i + 1, i + 201});
  RayTracingOptions options;
  options.memory_limit_bytes = 1 << 20;
  const auto refused = RayScene::create(scene_of({grid}), options);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().kind, ErrorKind::out_of_memory);
  options.memory_limit_bytes = 0;
  EXPECT_TRUE(RayScene::create(scene_of({grid}), options).has_value());
}

TEST(RayScene, refuses_triangles_without_vertices) {
  Mesh broken = square(-1);
  broken.indices[4] = 17;
  const auto refused = RayScene::create(scene_of({broken}));
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().kind, ErrorKind::bad_scene);
}

TEST(RayScene, an_empty_scene_is_met_by_nothing) {
  const auto rays_scene = RayScene::create(scene_of({}));
  ASSERT_TRUE(rays_scene.has_value());
  EXPECT_EQ(rays_scene->intersect(rays_along_minus_z(Vec3(0, 0, 0), 0.1f), Coherence::coherent).mesh[0], kNoHit);
}

}  // namespace
}  // namespace luciole
