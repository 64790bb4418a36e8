// SPDX-License-Identifier: Apache-2.0
#include "offline/light_tree/range_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/isa.h"
#include "offline/light_sample/weighted_choice.h"

namespace luciole {
namespace {

// Triangles of all sizes and brightnesses, some of them two-sided, and lamps, in a room of 10 m.
Scene many_lights(std::uint32_t triangles, std::uint32_t lamps) {
  std::mt19937 engine(4);
  std::uniform_real_distribution<float> unit(0, 1);
  const auto place = [&] { return Vec3(unit(engine) * 10, unit(engine) * 10, unit(engine) * 10); };
  Scene scene;
  for (int kind = 0; kind < 2; ++kind) {
    Material glow;
    glow.emission = kind == 0 ? Vec3(5, 3, 1) : Vec3(200, 300, 100);
    glow.double_sided = kind == 1;
    scene.materials.push_back(glow);
    Mesh mesh;
    mesh.material = static_cast<std::uint32_t>(kind);
    for (std::uint32_t i = 0; i < triangles / 2; ++i) {
      const Vec3 centre = place();
      const float size = 0.003f * std::pow(300.0f, unit(engine));
      for (int k = 0; k < 3; ++k) {
        mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
        mesh.positions.push_back(centre + (place() - Vec3(5, 5, 5)) * (size / 5));
      }
    }
    scene.meshes.push_back(mesh);
  }
  for (std::uint32_t i = 0; i < lamps; ++i) {
    PunctualLight lamp;
    lamp.kind = i % 2 == 0 ? PunctualLight::Kind::point : PunctualLight::Kind::spot;
    lamp.position = place();
    lamp.direction = normalize(place() - Vec3(5, 5, 5));
    lamp.cos_inner = 0.9f, lamp.cos_outer = 0.9f - unit(engine);
    scene.lights.push_back(lamp);
  }
  return scene;
}

Receiver receiver_at(Vec3 position, Vec3 normal) {
  Receiver receiver{};
  const float p[3] = {position.x, position.y, position.z}, n[3] = {normal.x, normal.y, normal.z};
  std::copy(p, p + 3, receiver.position);
  std::copy(n, n + 3, receiver.shading_normal);
  std::copy(n, n + 3, receiver.geometric_normal);
  std::copy(n, n + 3, receiver.to_eye);
  receiver.diffuse = 0.8f, receiver.f0 = 0.04f, receiver.f90 = 1, receiver.ggx_alpha = 0.5f;
  return receiver;
}

std::vector<std::uint32_t> walked(const RangeTree& tree, const WalkBounds& bounds, Isa isa) {
  std::vector<std::uint32_t> all;
  std::uint32_t part[48];
  const SphereTree view = tree.tree();
  for (TreeWalk walk(view); !walk.done();) {
    const std::uint32_t count = LUCIOLE_FOR_ISA(isa, overlapping_lights(view, bounds, walk, part, 48));
    all.insert(all.end(), part, part + count);
  }
  return all;
}

WalkBounds at_point(const RangeTree& tree, Vec3 p) { return {{p.x, p.y, p.z}, {p.x, p.y, p.z}, 0, tree.block_count()}; }

// Lights that can shine on the point at all, in this pass's ranges: by asking each of them.
std::vector<std::uint32_t> in_reach(const LightSet& lights, const RangeTree& tree, const Receiver& receiver,
                                    float floor) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    if (weight_of(lights.records()[i], tree.xi(i), receiver, {Weight::reflected, floor, Isa::baseline}) > 0) {
      found.push_back(i);
    }
  }
  return found;
}

TEST(RangeTree, finds_every_light_in_reach) {
  const Scene scene = many_lights(3000, 300);
  const LightSet lights(scene);
  ASSERT_GT(lights.size(), 3000u);
  RangeTree tree(lights, scene.bounds().diagonal());
  std::mt19937 engine(9);
  std::uniform_real_distribution<float> unit(0, 1);
  std::size_t found = 0, missed = 0;
  for (const float floor : {1e-4f, 0.02f, 1.0f}) {
    for (std::uint64_t pass = 0; pass < 3; ++pass) {
      tree.draw(1, pass, RangeNumbers::independent, floor);
      for (int i = 0; i < 40; ++i) {
        const Vec3 p(unit(engine) * 10, unit(engine) * 10, unit(engine) * 10);
        const Vec3 normal = normalize(Vec3(unit(engine) - 0.5f, unit(engine) - 0.5f, unit(engine) - 0.5f));
        std::vector<std::uint32_t> overlapping = walked(tree, at_point(tree, p), Isa::baseline);
        std::sort(overlapping.begin(), overlapping.end());
        for (const std::uint32_t light : in_reach(lights, tree, receiver_at(p, normal), floor)) {
          ++found;
          missed += !std::binary_search(overlapping.begin(), overlapping.end(), light);
        }
      }
    }
  }
  EXPECT_GT(found, 10000u);
  EXPECT_EQ(missed, 0u);
}

// The reach of a lobe without the size of its triangle loses lights: the test above can fail.
TEST(RangeTree, spheres_without_the_triangles_size_would_lose_lights) {
  const Scene scene = many_lights(2000, 0);
  const LightSet lights(scene);
  RangeTree tree(lights, scene.bounds().diagonal());
  tree.draw(1, 0, RangeNumbers::independent, 50);
  std::size_t lost = 0;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const LightRecord& light = lights.records()[i];
    const float range = std::sqrt(light.intensity / (50 * tree.xi(i)));
    const Vec3 rim =
        light.centre() + light.axis() * range + normalize(cross(light.axis(), Vec3(0.3f, 1, 0.2f))) * light.radius;
    const Vec3 centre = light.centre() + light.axis() * (range * light.reach_offset);
    const bool held = length(rim - centre) < range * light.reach_radius;
    const Receiver receiver = receiver_at(rim, -light.axis());
    lost += !held && weight_of(light, tree.xi(i), receiver, {Weight::reflected, 50, Isa::baseline}) > 0;
  }
  EXPECT_GT(lost, 100u);
}

TEST(RangeTree, boxes_and_parts_of_the_ranges_find_what_points_find) {
  const Scene scene = many_lights(2000, 100);
  const LightSet lights(scene);
  RangeTree tree(lights, scene.bounds().diagonal());
  tree.draw(2, 0, RangeNumbers::independent, 0.01f);
  const std::uint32_t cut = tree.first_block_below(1);
  ASSERT_GT(cut, 0u);
  ASSERT_LT(cut, tree.block_count());
  for (int i = 0; i < 50; ++i) {
    const float x = 0.2f * static_cast<float>(i);
    const Vec3 p(x, 10 - x, 5);
    std::vector<std::uint32_t> parts;
    for (const auto& [first, end] : {std::pair(0u, cut), std::pair(cut, tree.block_count())}) {
      const auto part = walked(tree, {{p.x, p.y, p.z}, {p.x, p.y, p.z}, first, end}, Isa::baseline);
      parts.insert(parts.end(), part.begin(), part.end());
    }
    const auto whole = walked(tree, at_point(tree, p), Isa::baseline);
    EXPECT_EQ(parts, whole);
    auto box = walked(tree, {{p.x - 1, p.y - 1, p.z}, {p.x, p.y, p.z + 1}, 0, tree.block_count()}, Isa::baseline);
    std::sort(box.begin(), box.end());
    for (const std::uint32_t light : whole) EXPECT_TRUE(std::binary_search(box.begin(), box.end(), light));
  }
}

TEST(RangeTree, is_the_same_on_every_instruction_set) {
  const Scene scene = many_lights(1000, 50);
  const LightSet lights(scene);
  RangeTree tree(lights, scene.bounds().diagonal());
  tree.draw(3, 5, RangeNumbers::stratified, 0.01f);
  for (const Isa isa : {Isa::avx512, Isa::avx2}) {
    if (!choose_isa(isa)) continue;
    for (int i = 0; i < 20; ++i) {
      const Vec3 p(0.5f * static_cast<float>(i), 4, 6);
      EXPECT_EQ(walked(tree, at_point(tree, p), isa), walked(tree, at_point(tree, p), Isa::baseline));
    }
  }
}

TEST(RangeTree, serves_any_number_of_lights) {
  for (const std::uint32_t count : {0u, 2u, 16u, 18u, 600u}) {
    const Scene scene = many_lights(count, 0);
    const LightSet lights(scene);
    RangeTree tree(lights, 17);
    tree.draw(1, 0, RangeNumbers::independent, 1e-12f);  // all reach everywhere
    EXPECT_EQ(walked(tree, at_point(tree, {5, 5, 5}), Isa::baseline).size(), lights.size());
  }
}

}  // namespace
}  // namespace luciole
