// SPDX-License-Identifier: Apache-2.0
// luciole merge: the parts of a picture become the picture, as if one run had rendered all samples.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <utility>

#include "apps/command_line/commands.h"
#include "apps/command_line/film_metadata.h"
#include "apps/command_line/output_files.h"
#include "apps/command_line/path_plan.h"
#include "apps/command_line/progress.h"
#include "apps/command_line/render_plan.h"

namespace luciole {
namespace {

constexpr const char* kExamples = R"(Examples:
  luciole merge part-0.exr part-1.exr part-2.exr -o whole.exr -o whole.png
  luciole merge part-*.exr -o whole.exr --layers albedo,normal,variance
  luciole merge part-1.exr part-2.exr --part -o later-half.exr)";

struct MergeOptions {
  std::vector<std::string> parts;
  RenderOptions render;  // outputs, layers, tone curve
  bool as_part = false;
};

Error cannot_merge(const std::string& reason) { return {ErrorKind::failed, "cannot merge: " + reason}; }

std::string text_of(SampleRange range) { return fmt::format("{}:{}", range.first, range.end); }

// Parts in any order. Neighbours are joined at once, so that parts in order of their samples need the memory of two.
class Merger {
 public:
  Status add(const std::string& name) {
    Result<FilmFile> file = read_film(name);
    if (!file) return file.error();
    if (first_name_.empty()) first_name_ = name, metadata_ = file->metadata;
    if (const std::string reason = difference(file->metadata, metadata_); !reason.empty()) {
      return cannot_merge(name + ": " + reason + " as in " + first_name_);
    }
    const SampleRange range = file->film.range();
    for (const Run& run : runs_) {
      if (range.first < run.film.range().end && run.film.range().first < range.end) {
        return cannot_merge(fmt::format("{} has samples {}, of which {} has some, too", name, text_of(range),
                                        run.first_name == run.last_name ? run.first_name : "another part"));
      }
    }
    return insert({std::move(file->film), name, name});
  }

  // All samples in one film, from sample 0 on if it is to be a whole picture.
  Result<FilmFile> finish(bool as_part) {
    for (std::size_t i = 1; i < runs_.size(); ++i) {
      const SampleRange gap{runs_[i - 1].film.range().end, runs_[i].film.range().first};
      if (gap.count() > 0) {
        return cannot_merge(fmt::format("samples {} are missing between {} and {}", text_of(gap),
                                        runs_[i - 1].last_name, runs_[i].first_name));
      }
    }
    const SampleRange range = runs_.front().film.range();
    if (range.first > 0 && !as_part) {
      return cannot_merge(fmt::format("samples 0:{} are missing before {} (--part writes a part again)", range.first,
                                      runs_.front().first_name));
    }
    return FilmFile{std::move(runs_.front().film), std::move(metadata_)};
  }

 private:
  struct Run {
    Film film;
    std::string first_name, last_name;
  };

  Status insert(Run run) {
    const std::string name = run.first_name;
    const auto behind = std::find_if(
        runs_.begin(), runs_.end(), [&](const Run& other) { return other.film.range().first >= run.film.range().end; });
    auto at = runs_.insert(behind, std::move(run));
    const auto touch = [](const Run& a, const Run& b) { return a.film.range().end == b.film.range().first; };
    if (at != runs_.begin() && touch(*(at - 1), *at)) {
      if (!(at - 1)->film.merge(at->film)) return other_picture(name);
      (at - 1)->last_name = at->last_name;
      at = runs_.erase(at) - 1;
    }
    if (at + 1 != runs_.end() && touch(*at, *(at + 1))) {
      if (!at->film.merge((at + 1)->film)) return other_picture(name);
      at->last_name = (at + 1)->last_name;
      runs_.erase(at + 1);
    }
    return Done{};
  }

  Error other_picture(const std::string& name) const {
    return cannot_merge(name + ": its size or exposure is not that of " + first_name_);
  }

  std::string first_name_;
  Metadata metadata_;
  std::vector<Run> runs_;  // ascending, without overlap
};

Result<int> run_merge(const MergeOptions& options) {
  const Result<ToneCurve> curve = chosen_tone_curve(options.render);
  if (!curve) return curve.error();
  const std::vector<std::string>& names = options.render.outputs;
  const Result<OutputFiles> outputs = OutputFiles::create({names.begin(), names.end()}, {});
  if (!outputs) return outputs.error();
  if (options.as_part && !options.render.layers.empty()) {
    return Error{ErrorKind::usage, "--layers: a part has none; the last merge takes --layers"};
  }
  if (Status status = check_film_layers(options.render.layers, *outputs); !status) return status.error();
  Progress progress(Verbosity::normal);
  Merger merger;
  for (const std::string& part : options.parts) {
    progress.step("reading " + part);
    if (Status status = merger.add(part); !status) return status.error();
  }
  const Result<FilmFile> whole = merger.finish(options.as_part);
  if (!whole) return whole.error();
  if (whole->film.range().count() == 0) return cannot_merge("the parts have no samples");
  progress.step("writing");
  if (Status status = write_film_outputs(*whole, outputs->names(), options.render.layers, *curve, options.as_part);
      !status) {
    return status.error();
  }
  return 0;
}

}  // namespace

void add_merge_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<MergeOptions>();
  CLI::App* command = program.add_subcommand("merge", "Join the parts of a path-traced picture");
  command->footer(kExamples);
  command->add_option("PARTS", options->parts, "files of luciole render --sample-range, in any order")->required();
  command->add_option("-o,--output", options->render.outputs, "FILE.exr (linear, layers) or FILE.png; may be repeated")
      ->required()
      ->allow_extra_args(false);
  command->add_option("--layers", options->render.layers, "layers of the .exr: albedo, normal, variance")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--tone-curve", options->render.tone_curve, "of .png: pbr-neutral|linear")
      ->default_str("pbr-neutral");
  command->add_flag("--part", options->as_part, "write a part again, to be merged with others later");
  command->callback([options, &chosen] { chosen = [options] { return run_merge(*options); }; });
}

}  // namespace luciole
