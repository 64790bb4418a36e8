// SPDX-License-Identifier: Apache-2.0
// The rasterised geometry buffer is the CPU's: the same triangles but at edges and where depths are the same to a
// rasteriser, and where they are the same every quantity is within what rounding can do.
#include "real_time/geometry_buffer/raster_geometry_pass.h"

#include "real_time/front_test_scene.h"
#include "real_time/geometry_buffer/compare_geometry.h"

namespace luciole::test {
namespace {

DeviceFrame drawn_on_device(gpu::Device& device, const Scene& scene, const DeviceView& view) {
  const Result<RasterGeometryPass> pass =
      RasterGeometryPass::create(device, view.width, view.height, static_cast<std::uint32_t>(scene.meshes.size()));
  EXPECT_TRUE(pass.has_value());
  return on_device(device, scene, view, [&](auto&... told) { pass->record(told...); });
}

// What a rasteriser makes of the exact hit: corners lie on a grid of 2^-bits pixels, so that edges move by its diagonal
// at most; and the rounding of clip coordinates, which reach to twice the screen, moves them by a few 2^-24 of that.
// Depth is compared at the place beside it that is moved as far, and interpolated in float from the largest 1 / depth
// of the triangle within twice the screen.
class RasterHit {
 public:
  RasterHit(const Scene& scene, const DeviceView& view, std::uint32_t bits)
      : scene_(scene),
        view_(view),
        screen_(view.camera, view.width, view.height, view.sub_pixel),
        slack_(std::sqrt(2.0) * std::exp2(-double(bits)) + 32 * kU * std::max(view.width, view.height)) {}

  double slack() const { return slack_; }  // [pixels]

  ExactHit operator()(const RayQuery& ray, const RayAnswer& hit) const {
    ExactHit exact = exact_hit(scene_, ray, hit.mesh, hit.triangle);
    const Mesh& mesh = scene_.meshes[hit.mesh];
    const std::uint32_t* index = &mesh.indices[3 * std::size_t(hit.triangle)];
    const Double3 eye(ray.origin), d(ray.direction);
    const Double3 a = Double3(mesh.positions[index[0]]) - eye, b = Double3(mesh.positions[index[1]]) - eye,
                  c = Double3(mesh.positions[index[2]]) - eye;
    exact.is_at_an_edge = std::abs(pixels_inside(a, b, c, d)) <= slack_;
    // 1 / depth is (n . d) / (n . a), linear on the screen.
    const Double3 normal = (b - a).cross(c - a);
    const double right = std::abs(normal.dot(Double3(screen_.across)) / normal.dot(a)),
                 down = std::abs(normal.dot(Double3(screen_.down)) / normal.dot(a));
    const double largest = 1 / exact.distance + right * view_.width + down * view_.height;
    exact.distance_tolerance += exact.distance * exact.distance * ((right + down) * slack_ + 16 * kU * largest);
    return exact;
  }

 private:
  // How far inside the triangle the ray passes, from the nearest edge; negative: outside. [pixels]
  double pixels_inside(Double3 a, Double3 b, Double3 c, Double3 d) const {
    const Double3 sides[] = {c.cross(b), a.cross(c), b.cross(a)};
    const double sum = d.dot(sides[0]) + d.dot(sides[1]) + d.dot(sides[2]);
    double least = 1e9;
    for (const Double3& side : sides) {
      const double slope = std::hypot(side.dot(Double3(screen_.across)), side.dot(Double3(screen_.down)));
      least = std::min(least, std::copysign(1.0, sum) * d.dot(side) / slope);
    }
    return least;
  }

  const Scene& scene_;
  const DeviceView& view_;
  const ScreenRays screen_;
  const double slack_;
};

BufferComparison compared(gpu::Device& device, const std::shared_ptr<const Scene>& scene, const DeviceView& view,
                          const DeviceFrame& frame, double sky = 0) {
  return compare_buffers(scene, view, frame, sky, RasterHit(*scene, view, device.limits().subPixelPrecisionBits));
}

// Pixels whose point does not lie on their ray, as far as moved corners allow: where the ray passes beside the triangle
// by so many pixels at the farthest corner, the nearest point of its edges is as near; measured across the view and not
// across the ray's longest axis, up to twice that in each of two directions.
std::size_t count_strays(gpu::Device& device, const Scene& scene, const DeviceView& view, const DeviceFrame& frame) {
  const double slack = RasterHit(scene, view, device.limits().subPixelPrecisionBits).slack();
  const ScreenRays screen(view.camera, view.width, view.height, view.sub_pixel);
  const std::vector<RayQuery> rays = rays_of(view);
  std::size_t strays = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const RayAnswer& hit = frame.hits[i];
    if (!is_hit(hit)) continue;
    const Double3 eye(screen.eye), forward(screen.forward), d(rays[i].direction);
    const Mesh& mesh = scene.meshes[hit.mesh];
    double farthest = 0;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3 at = mesh.positions[mesh.indices[3 * std::size_t(hit.triangle) + corner]];
      farthest = std::max(farthest, (Double3(at) - eye).dot(forward));
    }
    const Double3 point = Double3(front_test::at(frame.buffer.position, i)) - eye;
    const double depth = point.dot(forward);
    const double beside = (point - Double3(d.x * depth, d.y * depth, d.z * depth)).length();
    const double allowed = 4 * slack * double(screen.pixel_size) * farthest;
    strays += !(beside <= allowed + tolerances_of(scene, rays[i], hit).position);
  }
  return strays;
}

//   aside  how far the control looks to the side [pixels]
void expect_same_buffer(gpu::Device& device, const std::shared_ptr<const Scene>& scene, const std::string& name,
                        double sky = 0, float aside = 0.01f) {
  const DeviceView view = view_of(*scene);
  const DeviceFrame frame = drawn_on_device(device, *scene, view);
  ASSERT_TRUE(frame.status.has_value()) << frame.status.error().message;
  const BufferComparison c = compared(device, scene, view, frame, sky);
  const std::size_t pixels = frame.buffer.pixel_count();
  EXPECT_EQ(c.hits.wrong, 0u) << name;
  EXPECT_EQ(c.outside, 0u) << name << ", of " << c.compared;
  // Of a pixel that an edge runs through, the part that lies as near to it: no more than one edge runs through each.
  const double slack = RasterHit(*scene, view, device.limits().subPixelPrecisionBits).slack();
  EXPECT_LE(double(c.hits.set_apart + c.hits.coincident), 2 * slack * double(pixels)) << name;
  EXPECT_EQ(count_strays(device, *scene, view, frame), 0u) << name;
  // The controls: a hundredth of a pixel to the side is noticed, and half a pixel that points are not on their rays.
  DeviceView moved = view;
  moved.sub_pixel.x += 0.5f;
  EXPECT_GE(count_strays(device, *scene, moved, frame), c.hits.met / 4) << name;
  moved.sub_pixel.x = view.sub_pixel.x + aside;
  const BufferComparison control = compared(device, scene, view, drawn_on_device(device, *scene, moved), sky);
  EXPECT_GE(control.outside, c.hits.met / 4) << name;
  std::printf("%-28s %zu of %zu pixels show the same, %zu set apart, %zu coincident\n", name.c_str(), c.compared,
              pixels, c.hits.set_apart, c.hits.coincident);
}

// Noise in the alpha of a texture, cut by a mask and by blending at one half, and in that of vertices, before a wall.
Scene scene_with_holes() {
  Scene scene;
  auto image = std::make_shared<MipImage>();
  image->levels = {{8, 8, 0}};
  image->has_alpha = true;
  for (std::uint32_t i = 0; i < 64; ++i) {
    for (const std::uint32_t code : {255u, 128u, 60u, i * i * 37 % 256}) {
      image->rgba.push_back(static_cast<std::uint8_t>(code));
    }
  }
  scene.textures.resize(1);
  scene.textures[0].image = image;
  scene.materials.resize(3);
  scene.materials[1].alpha_mode = AlphaMode::mask, scene.materials[1].alpha_cutoff = 0.4f;
  scene.materials[2].alpha_mode = AlphaMode::blend;
  for (std::size_t i : {1, 2}) scene.materials[i].base_colour_texture.texture = 0;
  using front_test::quad;
  scene.meshes = {quad({-4, -3, -6}, {8, 0, 0}, {0, 6, 0}), quad({-2, -1, -3}, {2, 0, 0.5f}, {0, 2, 0}, 1),
                  quad({0.2f, -1, -2.5f}, {2, 0, -1}, {0, 2, 0}, 2), quad({-1, -1, -4}, {2, 0, 0}, {0, 1.5f, 0}, 2)};
  scene.meshes[3].colours = {{1, 1, 1, 0.2f}, {1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 0.6f}};
  scene.cameras = {look_at(Vec3(0.1f, 0.2f, 0), Vec3(0, 0, -3), 1.1f)};
  return scene;
}

// A floor, a wall and a needle from before the camera to behind it.
Scene scene_across_the_camera() {
  Scene scene;
  scene.materials.resize(1);
  const auto add = [&](Vec3 a, Vec3 b, Vec3 c) {
    scene.meshes.emplace_back();
    scene.meshes.back().positions = {a, b, c};
    scene.meshes.back().indices = {0, 1, 2};
  };
  add({-30, 0, 20}, {30, 0, 20}, {0, 0, -40});
  add({1, 0, 30}, {2, 0, -30}, {2, 9, -30});
  add({-0.02f, 0.51f, 1}, {-0.01f, 0.5f, 1}, {-1, 0.9f, -2});
  scene.cameras = {look_at(Vec3(0, 0.5f, 0), Vec3(0.2f, 0.4f, -1), 1.3f)};
  return scene;
}

TEST(RasterGeometryBuffer, is_the_cpus) {
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  for (const char* address : {"recipe:cornell?glossy=0.1", "recipe:ring?alpha=0.1", "recipe:gallery?detail=0.05"}) {
    expect_same_buffer(*device, bundled(address), address);
  }
}

TEST(RasterGeometryBuffer, is_the_cpus_in_sponza) {
  const std::shared_ptr<const Scene> sponza = sponza_if_there();
  if (!sponza) GTEST_SKIP() << "LUCIOLE_SCENES is not set";
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  expect_same_buffer(*device, sponza, "Sponza");
}

TEST(RasterGeometryBuffer, has_the_sky_where_there_is_nothing) {
  Scene scene = scene_with_sky();
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  expect_same_buffer(*device, std::make_shared<const Scene>(scene), "a constant sky");
  set_sky_image(scene.environment);
  expect_same_buffer(*device, std::make_shared<const Scene>(scene), "a sky image", kSkyTolerance);
  scene.meshes.clear();
  expect_same_buffer(*device, std::make_shared<const Scene>(scene), "nothing but sky", kSkyTolerance);
}

TEST(RasterGeometryBuffer, has_what_reaches_behind_the_camera) {
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  // A hundredth of a pixel is less than weights of corners as far away are known to.
  expect_same_buffer(*device, std::make_shared<const Scene>(scene_across_the_camera()), "across the camera", 0, 0.2f);
}

TEST(RasterGeometryBuffer, has_holes_where_the_cpu_has_them) {
  const auto device = gpu::test::open_device();
  ASSERT_TRUE(device);
  const auto scene = std::make_shared<const Scene>(scene_with_holes());
  expect_same_buffer(*device, scene, "holes");
  // The control: without the alpha test pixels show what the CPU looks through.
  Scene solid = *scene;
  for (Material& material : solid.materials) material.alpha_mode = AlphaMode::opaque;
  const DeviceView view = view_of(solid);
  const DeviceFrame frame = drawn_on_device(*device, solid, view);
  EXPECT_GT(compared(*device, scene, view, frame).hits.wrong, frame.hits.size() / 20);
}

TEST(RasterGeometryBuffer, is_refused_by_a_device_that_only_computes) {
  gpu::DeviceRequest request;
  request.may_rasterise = false;
  const auto device = gpu::test::open_device(request);
  ASSERT_TRUE(device);
  const Result<RasterGeometryPass> refused = RasterGeometryPass::create(*device, 4, 4, 1);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("does not rasterise"), std::string::npos) << refused.error().message;
}

}  // namespace
}  // namespace luciole::test
