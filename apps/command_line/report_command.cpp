// SPDX-License-Identifier: Apache-2.0
// luciole report: pages for a browser: pictures held against a reference, or the figures of ./do reproduce.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "apps/command_line/commands.h"
#include "apps/command_line/progress.h"
#include "apps/command_line/render_time.h"
#include "apps/command_line/version.h"
#include "base/parallel.h"
#include "image/exr.h"
#include "image/tone_curve.h"
#include "report/comparison_page.h"
#include "report/figure_pages.h"

namespace luciole {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExamples = R"(Examples:
  luciole report --compare result.exr --reference reference.exr -o page
  luciole report --compare tree.exr uniform.exr other-renderer.exr --reference truth.exr -o page --exposure 4
  luciole report --figures out/reproduce/*/figure.json -o out/report     (what ./do reproduce ends with)

The page is page/index.html; it needs no network, and the folder can be moved. Times come from the files, or from
NAME.json beside NAME.exr (luciole render --statistics NAME.json).)";

struct ReportOptions {
  std::vector<std::string> pictures, figures;
  std::string reference, output;
  float exposure = 0;  // 0: not said
  std::string tone_curve = "pbr-neutral";
};

std::string made_by() {
  return *kCommit == '\0' ? fmt::format("luciole {}", kVersion)
                          : fmt::format("luciole {} (commit {})", kVersion, kCommit);
}

// A file's own name; with its folder, as it was typed, where another file has the same.
std::string page_name(const ReportOptions& options, const std::string& file) {
  const fs::path own = fs::path(file).filename();
  const auto same = [&](const std::string& other) { return other != file && fs::path(other).filename() == own; };
  const bool shared = std::any_of(options.pictures.begin(), options.pictures.end(), same) || same(options.reference);
  return shared ? file : own.string();
}

Result<PagePicture> read_picture(const ReportOptions& options, const std::string& file) {
  Result<Image> image = read_exr(file);
  if (!image) return image.error();
  return PagePicture{page_name(options, file), std::move(*image), render_time_beside(file)};
}

// What was said, else what the reference was made for, if Luciole made it, else 1.
float chosen_exposure(const ReportOptions& options, const Image& reference) {
  if (options.exposure > 0) return options.exposure;
  const auto own = reference.metadata.find("luciole.exposure");
  const float exposure = own == reference.metadata.end() ? 1 : std::strtof(own->second.c_str(), nullptr);
  return exposure > 0 && std::isfinite(exposure) ? exposure : 1;
}

// One page per figure, and the index last.
Result<int> report_figures(const ReportOptions& options) {
  std::vector<Figure> figures;
  for (const std::string& file : options.figures) {
    Result<Figure> figure = read_figure(file);
    if (!figure) return figure.error();
    figures.push_back(std::move(*figure));
  }
  std::error_code failure;
  fs::create_directory(options.output, failure);
  if (!fs::is_directory(options.output))
    return Error{ErrorKind::failed, options.output + ": is no folder, and cannot be made"};
  Progress progress(Verbosity::normal);
  for (const Figure& figure : figures) {
    progress.step("page of " + figure.name);
    if (Status status = write_figure_page(figure, options.output, made_by()); !status) return status.error();
    if (stop_requested()) {
      progress.note("interrupted: the index was not written");
      return kInterrupted;
    }
  }
  if (Status status = write_figure_index(figures, options.output, made_by()); !status) return status.error();
  return 0;
}

Result<int> compare_pictures(const ReportOptions& options) {
  ComparisonSettings display;
  const std::optional<ToneCurve> curve = tone_curve_by_name(options.tone_curve);
  if (!curve) return Error{ErrorKind::usage, "--tone-curve must be pbr-neutral or linear"};
  display.tone_curve = *curve;
  Progress progress(Verbosity::normal);
  progress.step("reading " + options.reference);
  Result<PagePicture> reference = read_picture(options, options.reference);
  if (!reference) return reference.error();
  display.exposure = chosen_exposure(options, reference->image);
  Result<ComparisonPage> page = ComparisonPage::create(options.output, std::move(*reference), display, made_by());
  if (!page) return page.error();
  for (const std::string& file : options.pictures) {
    progress.step("comparing " + file);
    const Result<PagePicture> picture = read_picture(options, file);
    if (!picture) return picture.error();
    if (Status status = page->add(*picture); !status) return status.error();
    if (stop_requested()) {
      progress.note("interrupted: nothing was written");
      return kInterrupted;
    }
  }
  if (Status status = page->finish(); !status) return status.error();
  return 0;
}

Result<int> run_report(const ReportOptions& options) {
  if (!options.figures.empty()) return report_figures(options);
  if (options.pictures.empty() || options.reference.empty()) {
    return Error{ErrorKind::usage, "report needs --compare with --reference, or --figures"};
  }
  return compare_pictures(options);
}

}  // namespace

void add_report_command(CLI::App& program, Command& chosen) {
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* command = program.add_subcommand("report", "Make pages that compare pictures with references");
  command->footer(kExamples);
  CLI::Option* compare =
      command->add_option("--compare", options->pictures, "OpenEXR files of one size, of any renderer");
  CLI::Option* reference = command->add_option("--reference", options->reference, "OpenEXR file of the same size");
  command->add_option("--figures", options->figures, "figure.json files of ./do reproduce: a site of them")
      ->excludes(compare)
      ->excludes(reference);
  command->add_option("-o,--output", options->output, "folder of the page; is made if its parent exists")->required();
  command
      ->add_option("--exposure", options->exposure,
                   "display value per radiance, of FLIP and where the page starts (the reference's own, else 1)")
      ->check(CLI::PositiveNumber);
  command->add_option("--tone-curve", options->tone_curve, "pbr-neutral|linear")->default_str("pbr-neutral");
  command->callback([options, &chosen] { chosen = [options] { return run_report(*options); }; });
}

}  // namespace luciole
