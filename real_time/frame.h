// SPDX-License-Identifier: Apache-2.0
// One real-time frame: the passes in order. This is the door of real_time for programs.
#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "image/image.h"
#include "image/tone_curve.h"
#include "real_time/reflective_shadow_map/primary_light.h"
#include "real_time/settings.h"
#include "scene/scene.h"

namespace luciole {

// Means over the pixels that show a surface. A virtual point light with two lobes counts as two.
struct PerPixel {
  double diffuse = 0, glossy = 0, many = 0;
  double total() const { return diffuse + glossy + many; }
};

struct FrameStatistics {
  std::string engine;                                     // that computed ranges, culling and shading: cpu or vulkan
  std::vector<std::string> notes;                         // what the user should know of this frame, a sentence each
  std::vector<std::pair<std::string, double>> passes_ms;  // in the order of the frame
  double frame_ms = 0;                                    // without loading and BVH building
  double scene_ms = 0;  // moving the scene and building its BVH anew, before the frame; not part of frame_ms
  std::uint64_t virtual_point_lights = 0, many_lights = 0;
  PerPixel tests;  // made by culling (LightCounts)
  // listed: in the list of the pixel's depth half or cluster; splatting: lights whose splat covers the pixel
  PerPixel listed, accepted, false_positives;
  // Through the shading kernel: the CPU shades 16 pixels at once, and tiled culling tests each 16 once more.
  PerPixel evaluated;
  // Per list: (sub-region tile, depth half), cluster, or 4x4 pixels.
  double list_length_mean = 0, list_length_p99 = 0, list_length_max = 0;

  // Pixels whose light came out as no number or infinite, and was made good: by their neighbours' in the filter, else
  // black. Rare, or a mistake of ours.
  std::uint64_t pixels_not_finite = 0;

  double evaluations_per_second = 0;  // listed light x pixel pairs per second of culling and shading
};

struct Frame {
  std::uint32_t width = 0, height = 0;
  std::vector<Vec3> picture;        // linear radiance, exposure not applied
  std::vector<std::uint8_t> shown;  // srgb_codes() of the picture, with the settings' exposure, if asked for
  Image layers;                     // the layers that were asked for
  FrameStatistics statistics;
};

// Frames differ by their index (new ranges, offsets, and samples with jitter), and by what was set before them. With
// temporal accumulation a frame goes on from the one that was rendered before.
class Renderer {
 public:
  // Names of the layers that `render` can give: direct, indirect, indirect_from_diffuse, indirect_from_glossy,
  // unfiltered, albedo, normal, depth, history (frames that temporal accumulation averages), lights_listed,
  // lights_false; and, slow, as every light is evaluated at every
  // pixel, what the noisy light of one frame must be on average and how much it may scatter: reference,
  // predicted_variance, predicted_accepted (of all lights that go through culling).
  static const std::vector<std::string>& layer_names();

  // Whether such frames can be rendered; else one sentence. `create` asks it, too.
  static Status check(const Settings& settings);

  static Result<Renderer> create(std::shared_ptr<const Scene> scene, const Camera& camera, PrimaryLights primaries,
                                 const Settings& settings);
  //   shown  the tone curve of Frame::shown
  Result<Frame> render(std::uint64_t frame_index, const std::vector<std::string>& layers = {},
                       std::optional<ToneCurve> shown = {});

  // Of the frames from now on. What was kept of the last view is made anew where this one is another.
  void set_camera(const Camera& camera);
  // The same for what is lit and what lights it: rays are traced in this scene from now on.
  Status set_scene(std::shared_ptr<const Scene> scene, PrimaryLights primaries);
  const Settings& settings() const;  // instruction set, engine and device as chosen
  double bvh_build_ms() const;

  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace luciole
