// SPDX-License-Identifier: Apache-2.0
// luciole render: everything that can be refused is refused before the first ray; then the frames, one after another
// (path_run.h has the other method).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <optional>

#include "apps/command_line/accumulator.h"
#include "apps/command_line/commands.h"
#include "apps/command_line/motion.h"
#include "apps/command_line/path_run.h"
#include "apps/command_line/progress.h"
#include "apps/command_line/render_plan.h"
#include "apps/command_line/stage.h"
#include "apps/command_line/statistics_file.h"
#include "apps/command_line/version.h"
#include "apps/command_line/video.h"
#include "base/parallel.h"
#include "image/output_file.h"
#include "real_time/frame.h"
#include "real_time/settings_text.h"
#include "shot/open_shot.h"

namespace luciole {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Equal pictures are equal files: no times, dates or thread counts here.
void add_metadata(Image& image, const RenderPlan& plan, const RenderOptions& options, const Settings& chosen) {
  image.metadata["luciole.version"] = kVersion;
  image.metadata["luciole.shot"] = options.shot;
  image.metadata["luciole.accumulated_frames"] = std::to_string(options.accumulate);
  for (const auto& [name, text] : settings_as_text(plan.settings)) image.metadata["luciole." + name] = text;
  image.metadata["luciole.isa"] = to_string(chosen.isa);
  image.metadata["luciole.engine"] = to_string(chosen.engine);
  if (!chosen.device.empty()) image.metadata["luciole.device"] = chosen.device;
}

class Run {
 public:
  Run(const RenderOptions& options, RenderPlan plan)
      : options_(options), plan_(std::move(plan)), progress_(verbosity_of(options)) {}

  Result<int> operator()() {
    Result<Motion> motion = prepare();
    if (!motion) return stopped_or(motion.error());
    progress_.step("building the acceleration structure");
    Result<Renderer> renderer = motion->create_renderer(plan_.settings);
    if (!renderer) return stopped_or(renderer.error());
    statistics_.bvh_ms = renderer->bvh_build_ms();
    if (plan_.video) {
      Result<VideoWriter> video = VideoWriter::start(*plan_.video);
      if (!video) return video.error();
      video_.emplace(std::move(*video));
    }
    for (std::uint64_t index = plan_.frames.first; index <= plan_.frames.last && !stop_requested(); ++index) {
      const Result<double> scene_ms = motion->move_to(index, *renderer);
      if (!scene_ms) return stopped_or(scene_ms.error());
      if (Status status = render_one(*renderer, index, *scene_ms); !status) return stopped_or(status.error());
    }
    // Interrupted, the video has the frames that are complete; without any there is none.
    if (video_ && pictures_ > 0) {
      progress_.step("finishing the video");
      if (Status status = video_->finish(); !status) return status.error();
    }
    statistics_.settings = renderer->settings();  // also after a device was lost
    if (!options_.statistics.empty() && !statistics_.frames.empty()) {
      if (Status status = write_text(statistics_json(statistics_), options_.statistics); !status) {
        return status.error();
      }
    }
    return stop_requested() ? interrupted() : Result<int>(0);
  }

 private:
  Result<Motion> prepare() {
    progress_.step("loading " + options_.shot);
    const Clock::time_point start = Clock::now();
    Result<OpenedShot> opened = open_stage(plan_.shot, plan_.folders, options_.environment, options_.camera);
    if (!opened) return opened.error();
    statistics_.load_ms = ms_since(start);
    tell(*opened);
    std::optional<CameraPath> path = options_.camera.empty() ? plan_.shot.camera_path : std::nullopt;
    return Motion(std::move(*opened), std::move(path), plan_.shot.frames_per_second);
  }

  void tell(const OpenedShot& opened) {
    statistics_.shot = options_.shot;
    const PrimaryLights primary = opened.primary.empty() ? strongest_as_primary(opened.scene) : opened.primary;
    statistics_.primary_lights = primary.size();
    for (const auto& sentences : {opened.notes, opened.scene.warnings, left_out(opened.scene, primary)}) {
      for (const std::string& sentence : sentences) {
        progress_.note(sentence);
        statistics_.notes.push_back(sentence);
      }
    }
  }

  // One picture: a frame, or the mean of several. Interrupted, it is the mean of the complete ones, or nothing.
  Status render_one(Renderer& renderer, std::uint64_t index, double scene_ms) {
    FrameAccumulator sum;
    Image picture;
    std::vector<std::uint8_t> shown;
    const bool shows = video_ || plan_.outputs.any_png();
    const bool one = options_.accumulate == 1;  // else the mean is shown
    const std::optional<ToneCurve> curve = shows && one ? std::optional(plan_.tone_curve) : std::nullopt;
    std::uint32_t complete = 0;
    for (; complete < options_.accumulate; ++complete) {
      progress_.step(fmt::format("frame {} of {}-{}, part {} of {}", index, plan_.frames.first, plan_.frames.last,
                                 complete + 1, options_.accumulate));
      Result<Frame> frame = renderer.render(index * options_.accumulate + complete, plan_.layers, curve);
      if (stop_requested()) break;  // the frame may have holes
      if (!frame) return frame.error();
      if (complete == 0) frame->statistics.scene_ms = scene_ms;
      tell(frame->statistics);
      frame->layers.set_colours("", frame->picture);
      statistics_.frames.emplace_back(index * options_.accumulate + complete, frame->statistics);
      if (one) {
        picture = std::move(frame->layers), shown = std::move(frame->shown);
      } else {
        sum.add(frame->layers);
      }
    }
    if (complete == 0) return Done{};
    if (!one) {
      picture = sum.mean();
      if (shows) shown = srgb_codes(to_display(picture.colours(""), plan_.settings.exposure, plan_.tone_curve));
      if (plan_.variance) sum.add_variance_layer(picture);
    }
    add_metadata(picture, plan_, options_, renderer.settings());
    picture.metadata["luciole.accumulated_frames"] = std::to_string(complete);
    ++pictures_;
    complete_frames_ += complete;
    progress_.step("writing");
    if (video_) {
      if (Status status = video_->add(shown); !status) return status;
    }
    return plan_.outputs.write(picture, shown, index);
  }

  void tell(const FrameStatistics& frame) {
    for (const std::string& sentence : frame.notes) {
      progress_.note(sentence);
      statistics_.notes.push_back(sentence);
    }
    for (const auto& [pass, ms] : frame.passes_ms) progress_.detail(fmt::format("{:>9.2f} ms {}", ms, pass));
    progress_.detail(
        fmt::format("{:>9.2f} ms frame, {} lights", frame.frame_ms, frame.virtual_point_lights + frame.many_lights));
  }

  Result<int> interrupted() {
    progress_.note(pictures_ == 0 ? std::string("interrupted before a frame was complete: nothing was written")
                                  : fmt::format("interrupted: wrote {} picture{} from {} complete frames", pictures_,
                                                pictures_ == 1 ? "" : "s", complete_frames_));
    return kInterrupted;
  }

  // After Ctrl-C a pass may end early and say so; that is no failure.
  Result<int> stopped_or(const Error& error) { return stop_requested() ? interrupted() : Result<int>(error); }

  const RenderOptions& options_;
  RenderPlan plan_;
  Progress progress_;
  RunStatistics statistics_;
  std::optional<VideoWriter> video_;
  std::uint64_t pictures_ = 0, complete_frames_ = 0;
};

// Plans what the method needs; the run of a good plan is left in `run`.
Status plan_run(const RenderOptions& options, Method method, std::function<Result<int>()>& run) {
  if (method == Method::path) {
    Result<PathPlan> plan = make_path_plan(options);
    if (!plan) return plan.error();
    run = [&options, plan = std::move(*plan)] { return run_path(options, plan); };
    return Done{};
  }
  Result<RenderPlan> plan = make_plan(options);
  if (!plan) return plan.error();
  run = [&options, plan = std::move(*plan)] { return Run(options, plan)(); };
  return Done{};
}

Result<int> render(const CLI::App& command, const RenderOptions& options) {
  const Result<Method> method = chosen_method(command, options);
  if (!method) return method.error();
  std::function<Result<int>()> run;
  if (Status status = plan_run(options, *method, run); !status) return status.error();
  Result<int> outcome = 0;
  with_threads(options.threads, [&] { outcome = run(); });
  return outcome;
}

}  // namespace

void add_render_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* command = program.add_subcommand("render", "Render a shot or a scene");
  declare_options(*command, *options);
  command->callback(
      [options, command, &chosen] { chosen = [options, command] { return render(*command, *options); }; });
}

}  // namespace luciole
