// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/path_run.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "apps/command_line/checkpoint.h"
#include "apps/command_line/commands.h"
#include "apps/command_line/film_metadata.h"
#include "apps/command_line/path_pace.h"
#include "apps/command_line/path_statistics.h"
#include "apps/command_line/progress.h"
#include "apps/command_line/stage.h"
#include "base/parallel.h"
#include "image/output_file.h"
#include "offline/render.h"

namespace luciole {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kShowEvery = 0.5;  // [s], in the viewer

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::string samples_text(std::uint64_t count) { return fmt::format("{} sample{}", count, count == 1 ? "" : "s"); }

class PathRun {
 public:
  PathRun(const RenderOptions& options, PathPlan plan)
      : options_(options),
        plan_(std::move(plan)),
        progress_(verbosity_of(options)),
        checkpoint_(plan_.checkpoint, plan_.checkpoint_every),
        file_{Film(plan_.settings.width, plan_.settings.height, plan_.settings.exposure, plan_.goal.samples.first),
              {}} {}

  Result<int> operator()() {
    // An unusable checkpoint is told before the scene is loaded.
    Result<std::optional<FilmFile>> kept = plan_.resume ? checkpoint_.read() : std::optional<FilmFile>();
    if (!kept) return kept.error();
    Result<PathTracer> tracer = prepare();
    if (!tracer) return stop_requested() ? interrupted() : Result<int>(tracer.error());
    if (Status status = take_up(std::move(*kept)); !status) return status.error();
    render(*tracer);
    return finish(*tracer);
  }

 private:
  Result<PathTracer> prepare() {
    progress_.step("loading " + options_.shot);
    const Clock::time_point start = Clock::now();
    Result<OpenedShot> opened = open_stage(plan_.shot, plan_.folders, options_.environment, options_.camera);
    if (!opened) return opened.error();
    // Here all lights are alike; those that the shot and the file both name were counted once already.
    Scene& loaded = opened->scene;
    loaded.lights.insert(loaded.lights.end(), opened->primary.begin(), opened->primary.end());
    for (const auto& sentences : {opened->notes, loaded.warnings}) {
      for (const std::string& sentence : sentences) note(sentence);
    }
    statistics_.load_ms = 1000 * seconds_since(start);
    progress_.step("preparing rays and lights");
    const Clock::time_point loading_ended = Clock::now();
    const auto scene = std::make_shared<const Scene>(std::move(loaded));
    Result<PathTracer> tracer = PathTracer::create(scene, opened->camera, plan_.settings);
    if (!tracer) return tracer;
    statistics_.prepare_ms = 1000 * seconds_since(loading_ended);
    file_.metadata = path_metadata(options_.shot, *scene, opened->camera, tracer->settings());
    return tracer;
  }

  // Goes on from what an earlier run kept.
  Status take_up(std::optional<FilmFile> kept) {
    const std::string name = plan_.checkpoint.string();
    if (!kept) {
      std::error_code ignored;
      if (plan_.resume) note(name + " does not exist yet: rendering begins anew.");
      if (!plan_.resume && !name.empty() && std::filesystem::exists(plan_.checkpoint, ignored)) {
        note(name + " is from an earlier run and will be replaced (--resume would go on from it).");
      }
      return Done{};
    }
    const auto refuse = [&](const std::string& reason) {
      return Error{ErrorKind::failed, "cannot resume from " + name + ": " + reason};
    };
    if (const std::string reason = difference(kept->metadata, file_.metadata); !reason.empty()) return refuse(reason);
    const SampleRange has = kept->film.range(), wanted = plan_.goal.samples;
    if (has.first != wanted.first || has.end > wanted.end) {
      return refuse(
          fmt::format("it has samples {}:{}, which are not of {}:{}", has.first, has.end, wanted.first, wanted.end));
    }
    // Of the same settings it has the same size and exposure.
    if (!file_.film.merge(kept->film)) return refuse("its picture has another size or exposure");
    progress_.detail("going on from " + samples_text(has.count()));
    return Done{};
  }

  void render(PathTracer& tracer) {
    if (plan_.viewer) {
      display_.emplace(*plan_.viewer, options_.shot + " (luciole)", file_.film.width(), file_.film.height());
    }
    PathPace pace(plan_.goal);
    Clock::time_point shown = Clock::now();
    while (!stop_requested() && pace.goes_on(file_.film)) {
      const Clock::time_point start = Clock::now();
      if (!tracer.add_sample(file_.film)) break;
      pace.add_pass(seconds_since(start), tracer.statistics().rays);
      if (progress_.shows_steps()) progress_.step(pace.text(file_.film));
      if (display_ && seconds_since(shown) >= kShowEvery && display_->wants_picture()) {
        display_->show(file_.film.image());
        shown = Clock::now();
      }
      if (checkpoint_.is_due(file_.film)) keep();
    }
    statistics_.render_seconds = pace.render_s();
    statistics_.passes = pace.passes();
  }

  // A disk that is full now may have room later: rendering goes on.
  void keep() {
    const Status status = checkpoint_.write(file_);
    if (!status) return progress_.note(status.error().message);
    progress_.detail("kept " + samples_text(file_.film.range().count()));
  }

  Result<int> finish(const PathTracer& tracer) {
    const Film& film = file_.film;
    if (film.range().count() == 0) return interrupted();
    if (display_) display_->show(film.image());
    progress_.step("writing");
    // The sums first: whatever fails after that can be written again.
    Status status = checkpoint_.is_behind(film) ? checkpoint_.write(file_) : Done{};
    const Status written =
        write_film_outputs(file_, plan_.outputs.names(), plan_.layers, plan_.tone_curve, plan_.as_part);
    if (status) status = written;
    if (film.saturated() > 0)
      note(fmt::format("{} samples were not finite or too bright, and were cut.", film.saturated()));
    if (status && !options_.statistics.empty()) status = write_statistics(tracer);
    display_.reset();
    if (!status) return status.error();
    return stop_requested() ? interrupted() : Result<int>(0);
  }

  Status write_statistics(const PathTracer& tracer) {
    statistics_.shot = options_.shot;
    statistics_.settings = tracer.settings();
    statistics_.counts = tracer.statistics();
    statistics_.lights = tracer.light_count();
    statistics_.light_bytes = tracer.light_bytes();
    statistics_.bvh_ms = tracer.bvh_build_ms();
    return write_text(path_statistics_json(statistics_, file_.film), options_.statistics);
  }

  Result<int> interrupted() {
    const SampleRange range = file_.film.range();
    if (range.count() == 0) {
      progress_.note("interrupted before a sample was complete: nothing was written");
    } else if (plan_.as_part) {
      progress_.note(fmt::format("interrupted: wrote samples {}:{}", range.first, range.end));
    } else {
      progress_.note("interrupted: wrote the picture of " + samples_text(range.count()));
    }
    return kInterrupted;
  }

  void note(const std::string& sentence) {
    progress_.note(sentence);
    statistics_.notes.push_back(sentence);
  }

  const RenderOptions& options_;
  PathPlan plan_;
  Progress progress_;
  Checkpoint checkpoint_;
  FilmFile file_;
  std::optional<LiveDisplay> display_;
  PathRunStatistics statistics_;
};

}  // namespace

Result<int> run_path(const RenderOptions& options, PathPlan plan) { return PathRun(options, std::move(plan))(); }

}  // namespace luciole
