// SPDX-License-Identifier: Apache-2.0
// Rays on the device meet what they meet in Embree and in double precision.
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>

#include "real_time/device_scene/compare_hits.h"
#include "real_time/device_scene/device_scene_probe.h"
#include "scene/load_scene.h"

namespace luciole::test {
namespace {

constexpr std::size_t kRays = 8192;
constexpr float kEndless = std::numeric_limits<float>::infinity();

class RayDice {
 public:
  explicit RayDice(std::uint32_t seed) : generator_(seed) {}
  float unit() { return static_cast<float>(generator_() >> 8) * 0x1p-24f; }
  std::uint32_t below(std::uint64_t count) { return static_cast<std::uint32_t>(generator_() % count); }
  Vec3 within(const Bounds& box) {
    const Vec3 size = box.high - box.low;
    return box.low + size * Vec3(unit(), unit(), unit());
  }
  // On a triangle of a random mesh.
  Vec3 on_surface(const Scene& scene) {
    const Mesh& mesh = scene.meshes[below(scene.meshes.size())];
    const std::uint32_t* index = &mesh.indices[3 * std::size_t(below(mesh.indices.size() / 3))];
    const float a = std::sqrt(unit()), u = a * unit(), v = a - u;
    return mesh.positions[index[0]] * (1 - a) + mesh.positions[index[1]] * u + mesh.positions[index[2]] * v;
  }

 private:
  std::mt19937 generator_;
};

RayQuery ray_of(Vec3 origin, Vec3 direction, float farthest = kEndless) {
  return {{origin.x, origin.y, origin.z}, {direction.x, direction.y, direction.z}, 0, farthest};
}

// From anywhere in the scene's bounds: to surfaces, and in all directions.
std::vector<RayQuery> random_rays(const Scene& scene, std::uint32_t seed) {
  RayDice dice(seed);
  const Bounds box = scene.bounds();
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < kRays; ++i) {
    const Vec3 origin = dice.within(box);
    const Vec3 target = i % 2 == 0 ? dice.on_surface(scene) : dice.within(box);
    rays.push_back(ray_of(origin, target - origin));
  }
  return rays;
}

void expect_same(const HitComparison& c, std::size_t rays, const std::string& what, double ms) {
  EXPECT_GT(c.met, rays / 8) << what;
  EXPECT_EQ(c.wrong, 0u) << what;
  EXPECT_LE(c.set_apart, rays / 1000) << what;
  EXPECT_EQ(c.off_distance, 0u) << what;
  std::printf(
      "%-40s %zu of %zu rays meet something, %zu set apart, %zu coincident, %.0f turns each, %.3f million rays/s\n",
      what.c_str(), c.met, rays, c.set_apart, c.coincident, c.turns / double(rays), double(rays) / ms / 1e3);
}

void expect_embrees_hits(Probe& probe, std::shared_ptr<const Scene> scene, const std::string& name) {
  const Result<RayScene> embree = RayScene::create(scene);
  ASSERT_TRUE(embree.has_value());
  const DeviceScene placed = probe.place(*scene, hierarchy_of(*scene));
  const std::vector<RayQuery> rays = random_rays(*scene, 3);
  const std::vector<RayAnswer> nearest = probe.trace(placed, rays);
  expect_same(compare_hits(*scene, rays, nearest, in_embree(*embree, rays)), kRays, name + ", nearest",
              probe.last_ms());
  // Nine tenths of the way between two points: blocked or not, by whatever.
  std::vector<RayQuery> segments = random_rays(*scene, 4);
  for (RayQuery& segment : segments) segment.farthest = 0.9f;
  const std::vector<RayAnswer> any = probe.trace(placed, segments, true);
  std::vector<RayAnswer> blocked = in_embree(*embree, segments, true);
  for (std::size_t i = 0; i < any.size(); ++i) {
    if (is_hit(any[i]) && is_hit(blocked[i])) blocked[i].mesh = any[i].mesh, blocked[i].triangle = any[i].triangle;
  }
  expect_same(compare_hits(*scene, segments, any, blocked), kRays, name + ", any", probe.last_ms());
}

TEST(Trace, meets_what_embree_meets) {
  Probe probe;
  for (const char* address : {"recipe:cornell?glossy=0.1", "recipe:ring?alpha=0.1", "recipe:gallery?detail=0.05"}) {
    expect_embrees_hits(probe, bundled(address), address);
  }
}

// Textures decide where its leaves have holes.
TEST(Trace, meets_what_embree_meets_in_sponza) {
  const char* folder = std::getenv("LUCIOLE_SCENES");
  if (folder == nullptr) GTEST_SKIP() << "LUCIOLE_SCENES is not set";
  Result<Scene> sponza = load_scene(std::string(folder) + "/sponza/sponza.gltf");
  ASSERT_TRUE(sponza.has_value()) << sponza.error().message;
  Probe probe;
  const auto scene = std::make_shared<const Scene>(std::move(*sponza));
  const Hierarchy hierarchy = hierarchy_of(*scene);
  std::printf("Sponza's hierarchy: %.1f bytes per triangle, stack of %u\n",
              double(hierarchy.bytes()) / double(hierarchy.triangles.size()), hierarchy.stack);
  expect_embrees_hits(probe, scene, "Sponza");
}

TEST(Trace, finds_a_box_that_is_too_small_by_its_missing_hits) {
  Probe probe;
  const auto scene = bundled("recipe:gallery?detail=0.05");
  const Result<RayScene> embree = RayScene::create(scene);
  ASSERT_TRUE(embree.has_value());
  Hierarchy hierarchy = hierarchy_of(*scene);
  const std::vector<RayQuery> rays = random_rays(*scene, 3);
  HierarchyNode& node = hierarchy.nodes.at(0);
  for (int lane = 0; lane < 4; ++lane) node.high_y[lane] -= 0.1f * (node.high_y[lane] - node.low_y[lane]);
  const std::vector<RayAnswer> found = probe.trace(probe.place(*scene, hierarchy), rays);
  EXPECT_GT(compare_hits(*scene, rays, found, in_embree(*embree, rays)).wrong, 0u);
}

// A ball whose triangles share their vertices.
Scene closed_ball() {
  constexpr std::uint32_t kRings = 24, kColumns = 48;
  Mesh mesh;
  mesh.positions = {{0, 1, 0}, {0, -1, 0}};
  for (std::uint32_t ring = 1; ring < kRings; ++ring) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const float theta = 3.14159265f * float(ring) / kRings, phi = 6.2831853f * float(column) / kColumns;
      mesh.positions.emplace_back(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
    }
  }
  const auto at = [](std::uint32_t ring, std::uint32_t column) {
    return 2 + (ring - 1) * kColumns + column % kColumns;
  };
  for (std::uint32_t column = 0; column < kColumns; ++column) {
    mesh.indices.insert(mesh.indices.end(), {0, at(1, column + 1), at(1, column)});
    mesh.indices.insert(mesh.indices.end(), {1, at(kRings - 1, column), at(kRings - 1, column + 1)});
    for (std::uint32_t ring = 1; ring + 1 < kRings; ++ring) {
      const std::uint32_t a = at(ring, column), b = at(ring, column + 1), c = at(ring + 1, column),
                          d = at(ring + 1, column + 1);
      mesh.indices.insert(mesh.indices.end(), {a, b, c, b, d, c});
    }
  }
  Scene scene;
  scene.materials.resize(1);
  scene.meshes = {mesh};
  return scene;
}

// Rays from inside, aimed at vertices and at points of edges: those that leave through a crack.
std::size_t leaving(Probe& probe, const Scene& scene) {
  RayDice dice(8);
  const Mesh& mesh = scene.meshes[0];
  std::vector<RayQuery> rays;
  for (std::size_t i = 0; i < 4 * kRays; ++i) {
    const Vec3 origin(dice.unit() - 0.5f, dice.unit() - 0.5f, dice.unit() - 0.5f);
    const std::size_t triangle = dice.below(mesh.indices.size() / 3), corner = dice.below(3);
    const Vec3 a = mesh.positions[mesh.indices[3 * triangle + corner]],
               b = mesh.positions[mesh.indices[3 * triangle + (corner + 1) % 3]];
    rays.push_back(ray_of(origin, a + (b - a) * (i % 2 == 0 ? 0.0f : dice.unit()) - origin));
  }
  const std::vector<RayAnswer> answers = probe.trace(probe.place(scene, hierarchy_of(scene)), rays);
  return static_cast<std::size_t>(std::count_if(answers.begin(), answers.end(), [](auto& a) { return !is_hit(a); }));
}

TEST(Trace, does_not_leave_a_closed_mesh_through_its_edges) {
  Probe probe;
  Scene scene = closed_ball();
  EXPECT_EQ(leaving(probe, scene), 0u);
  // The control: corners that are moved by a few thousandths of a millimetre against those of their neighbours.
  for (std::size_t corner = 0; corner < scene.meshes[0].indices.size(); corner += 2) {
    std::uint32_t& index = scene.meshes[0].indices[corner];
    scene.meshes[0].positions.push_back(scene.meshes[0].positions[index] + Vec3(2e-6f, -2e-6f, 2e-6f));
    index = static_cast<std::uint32_t>(scene.meshes[0].positions.size() - 1);
  }
  EXPECT_GT(leaving(probe, scene), 0u);
}

// Software Vulkan counts the turns of all loops together, and those of loops in loops as often as they run.
TEST(Trace, is_one_loop) {
  constexpr std::uint32_t kLoopMerge = 246;  // "Control-Flow Instructions" of the SPIR-V specification
  std::size_t loops = 0;
  for (std::size_t at = 5; at < trace_probe.bytes / 4; at += trace_probe.words[at] >> 16) {
    loops += (trace_probe.words[at] & 0xffffu) == kLoopMerge;
  }
  EXPECT_EQ(loops, 1u);
}

TEST(Trace, of_an_empty_scene_meets_nothing) {
  Probe probe;
  Scene scene;
  scene.materials.resize(1);
  const DeviceScene placed = probe.place(scene, hierarchy_of(scene));
  for (const bool any : {false, true}) {
    const RayAnswer answer = probe.trace(placed, {ray_of({0, 0, 0}, {0, 0, -1})}, any).at(0);
    EXPECT_EQ(answer.mesh, kNothing);
    EXPECT_EQ(answer.complete, 1u);
  }
}

Mesh square(float depth) {
  Mesh mesh;
  mesh.positions = {{-1, -1, depth}, {1, -1, depth}, {1, 1, depth}, {-1, 1, depth}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

// Two squares behind each other; the left texel of the nearer one is a hole.
TEST(Trace, passes_the_holes_of_masks) {
  Probe probe;
  auto image = std::make_shared<MipImage>();
  image->levels = {{2, 1, 0}};
  image->rgba = {255, 255, 255, 100, 255, 255, 255, 255};
  image->has_alpha = true;
  for (const AlphaMode mode : {AlphaMode::opaque, AlphaMode::mask, AlphaMode::blend}) {
    Scene scene;
    scene.textures.resize(1);
    scene.textures[0].image = image;
    scene.textures[0].magnify_linear = false;
    scene.materials.resize(2);
    scene.materials[1].alpha_mode = mode;
    scene.materials[1].alpha_cutoff = 0.4f;  // of 100/255 and more
    scene.materials[1].base_colour_texture.texture = 0;
    scene.meshes = {square(-3), square(-5)};
    scene.meshes[0].material = 1;
    scene.meshes[0].uv[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const DeviceScene placed = probe.place(scene, hierarchy_of(scene));
    std::vector<RayQuery> rays;
    for (const float x : {-0.5f, 0.5f}) rays.push_back(ray_of({x, 0.3f, 0}, {0, 0, -1}, 4));
    const std::vector<RayAnswer> blocked = probe.trace(placed, rays, true);
    for (RayQuery& ray : rays) ray.farthest = kEndless;
    const std::vector<RayAnswer> met = probe.trace(placed, rays);
    EXPECT_EQ(met[0].mesh, mode == AlphaMode::opaque ? 0u : 1u);
    EXPECT_EQ(met[1].mesh, 0u);
    EXPECT_EQ(is_hit(blocked[0]), mode == AlphaMode::opaque);
    EXPECT_TRUE(is_hit(blocked[1]));
  }
}

TEST(Trace, of_two_triangles_in_one_place_meets_the_first) {
  Probe probe;
  Scene scene;
  scene.materials.resize(1);
  scene.meshes = {square(-3), square(-3), square(-3)};
  const RayAnswer met =
      probe.trace(probe.place(scene, hierarchy_of(scene)), {ray_of({0.1f, 0.2f, 0}, {0, 0, -1})}).at(0);
  EXPECT_EQ(met.mesh, 0u);
}

// 70,000 triangles in whose boxes the ray runs all the way, and which it all misses.
TEST(Trace, that_meets_too_much_says_so) {
  Probe probe;
  Scene scene;
  scene.materials.resize(1);
  scene.meshes.resize(1);
  for (std::uint32_t i = 0; i < 70000; ++i) {
    const float depth = -1.0f - 1e-4f * float(i);
    for (const Vec3 corner : {Vec3(0, 0, depth), Vec3(1, 0, depth), Vec3(0, 1, depth)}) {
      scene.meshes[0].indices.push_back(static_cast<std::uint32_t>(scene.meshes[0].positions.size()));
      scene.meshes[0].positions.push_back(corner);
    }
  }
  const DeviceScene placed = probe.place(scene, hierarchy_of(scene));
  const auto answers = probe.trace(placed, {ray_of({0.9f, 0.9f, 0}, {0, 0, -1}), ray_of({0.1f, 0.1f, 0}, {0, 0, -1})});
  EXPECT_EQ(answers[0].complete, 0u);
  EXPECT_EQ(answers[0].mesh, kNothing);
  EXPECT_EQ(answers[1].complete, 1u) << "the control: the first triangle ends it";
  EXPECT_EQ(answers[1].triangle, 0u);
}

}  // namespace
}  // namespace luciole::test
