// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/command_line/output_files.h"
#include "apps/command_line/render_options.h"
#include "apps/command_line/video.h"
#include "base/result.h"
#include "image/tone_curve.h"
#include "real_time/settings.h"
#include "shot/find_shot.h"

namespace luciole {

// A run of frames whose every part was found good, before anything heavy happened.
struct RenderPlan {
  Shot shot;
  SearchFolders folders;
  Settings settings;
  FrameRange frames;
  OutputFiles outputs;
  std::optional<VideoFormat> video;
  ToneCurve tone_curve = ToneCurve::pbr_neutral;
  std::vector<std::string> layers;  // asked of the renderer
  bool variance = false;
};

// By name; the default for an empty one.
Result<ToneCurve> chosen_tone_curve(const RenderOptions& options);

// A sentence for a run that needs more memory than the machine has.
//   what   "--size 640x480 with 10 VPLs"
Status check_memory(double bytes, const std::string& what);

// Checks all that can be checked before a scene is loaded: shot, settings, memory, outputs, layers.
Result<RenderPlan> make_plan(const RenderOptions& options);

}  // namespace luciole
