// SPDX-License-Identifier: Apache-2.0
#include "real_time/geometry_buffer/raster_geometry_pass.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "real_time/geometry_buffer/pixel_block.h"

namespace luciole {

extern const gpu::ShaderCode visibility_draws, visibility_vertex, visibility_opaque, visibility_masked,
    visibility_resolve;

namespace {

constexpr std::uint32_t kGroup = 8;    // pixels along a side of a workgroup of visibility_resolve.comp
constexpr std::uint32_t kMeshes = 64;  // of a workgroup of visibility_draws.comp
static_assert(sizeof(VkDrawIndirectCommand) == sizeof(DrawRecord));

std::uint32_t groups(std::uint32_t count, std::uint32_t of) { return (count + of - 1) / of; }

struct Row {
  double x, y, z;
  explicit Row(Vec3 v) : x(v.x), y(v.y), z(v.z) {}
  Row(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
  Row operator+(Row o) const { return {x + o.x, y + o.y, z + o.z}; }
  Row operator*(double s) const { return {x * s, y * s, z * s}; }
  double dot(Row o) const { return x * o.x + y * o.y + z * o.z; }
  Row cross(Row o) const { return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x}; }
  void copy_to(float (&to)[3]) const {
    to[0] = static_cast<float>(x), to[1] = static_cast<float>(y), to[2] = static_cast<float>(z);
  }
};

// Clipping moves corners to the plane `near`, where their depth errs what depths of the farthest corners round by: a
// few 2^-24 of these. 64 of them, so that it stays positive; what lies nearer than that to the camera's plane is lost.
float near_of(Vec3 eye, const Bounds& bounds) {
  const Vec3 reach = max(bounds.high - eye, eye - bounds.low);
  const bool is_empty = bounds.low.x > bounds.high.x;
  return is_empty ? 1.0f : std::max(0x1p-18f * length(reach), 0x1p-100f);
}

}  // namespace

// The ray of pixel (i, j) is top_left + i across + j down =: t + i a + j d. A point p = w (t + i a + j d), relative to
// the eye, has by Cramer's rule  w = p . (a x d) / v,  w i = p . (d x t) / v,  w j = p . (t x a) / v,  v = t . (a x d).
// The centre of pixel i lies at 2 (i + 1/2) / width - 1 in clip space.
Projection projection_of(const DeviceView& view, const Bounds& bounds) {
  const ScreenRays screen(view.camera, view.width, view.height, view.sub_pixel);
  const Row t(screen.top_left), a(screen.across), d(screen.down);
  const double volume = t.dot(a.cross(d));
  const Row w = a.cross(d) * (1 / volume), column = d.cross(t) * (1 / volume), row = t.cross(a) * (1 / volume);
  Projection made{};
  ((column + w * 0.5) * (2.0 / view.width) + w * -1.0).copy_to(made.x);
  ((row + w * 0.5) * (2.0 / view.height) + w * -1.0).copy_to(made.y);
  w.copy_to(made.w);
  Row(screen.eye).copy_to(made.eye);
  made.near = near_of(screen.eye, bounds);
  return made;
}

Result<RasterGeometryPass> RasterGeometryPass::create(gpu::Device& device, std::uint32_t width, std::uint32_t height,
                                                      std::uint32_t meshes) {
  RasterGeometryPass pass;
  pass.most_meshes_ = meshes;
  const auto take = [](auto made, auto& to) {
    Status done = Done{};
    if (made) {
      to = std::move(*made);
    } else {
      done = made.error();
    }
    return done;
  };
  const std::uint64_t pixels = std::uint64_t(width) * height, draws = 2 * std::uint64_t(meshes);
  const auto pipeline = [&](const gpu::ShaderCode& fragment) {
    return gpu::RasterPipeline::create(device, visibility_vertex, fragment, sizeof(VisibilityPush),
                                       gpu::PixelFormat::two_words);
  };
  using gpu::BufferUse, gpu::PixelFormat;
  Status done = take(pipeline(visibility_opaque), pass.opaque_);
  if (done) done = take(pipeline(visibility_masked), pass.masked_);
  if (done) done = take(gpu::Kernel::create(device, visibility_draws, sizeof(DrawsPush)), pass.choose_draws_);
  if (done) done = take(gpu::Kernel::create(device, visibility_resolve, sizeof(ResolvePush)), pass.resolve_);
  if (done) done = take(gpu::Image::create(device, width, height, PixelFormat::two_words), pass.visibility_);
  if (done) done = take(gpu::Image::create(device, width, height, PixelFormat::depth), pass.depth_);
  if (done) done = take(gpu::Buffer::create(device, pixels * 2 * sizeof(word_), BufferUse::device), pass.shown_);
  if (done) done = take(gpu::Buffer::create(device, draws * sizeof(DrawRecord), BufferUse::device), pass.draws_);
  if (!done) return done.error();
  return pass;
}

void RasterGeometryPass::record(gpu::CommandList& list, const DeviceScene& scene, const DeviceView& view,
                                const GeometryOnDevice& to) const {
  const std::uint32_t meshes = scene.mesh_count();
  LUCIOLE_ASSERT_LE(meshes, most_meshes_);
  ResolvePush resolve{};
  resolve.geometry = geometry_push(scene, view, to), resolve.visibility = shown_.address();
  const GeometryPush& told = resolve.geometry;
  DrawsPush choose{scene.mesh_bounds(), draws_.address(), projection_of(view, scene.bounds()), meshes};
  VisibilityPush see{};
  see.scene = scene.address(), see.projection = choose.projection;
  std::copy_n(told.top_left, 3, see.top_left), std::copy_n(told.across, 3, see.across);
  std::copy_n(told.down, 3, see.down);

  list.begin_pass("geometry_buffer");
  list.fill(to.unfinished, 0);
  list.dispatch(choose_draws_, choose, groups(meshes, kMeshes));
  list.begin_rendering(visibility_, depth_, view.width, view.height, {kNothing, kNothing});
  list.draw(opaque_, see, draws_, 0, meshes);
  list.draw(masked_, see, draws_, meshes, meshes);
  list.end_rendering(visibility_);
  list.copy(visibility_, shown_, view.width, view.height);
  list.barrier();
  list.dispatch(resolve_, resolve, groups(view.width, kGroup), groups(view.height, kGroup));
}

}  // namespace luciole
