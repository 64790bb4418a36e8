// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/path_pace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace luciole {
namespace {

// Fewer samples have often not met the rare bright paths, and estimate too small an error.
constexpr std::uint64_t kSamplesForEstimate = 16;
constexpr double kEstimateEvery = 2;  // [s], for the line of progress only

}  // namespace

bool PathPace::goes_on(const Film& film) {
  const std::uint64_t count = film.range().count();
  if (film.range().end >= goal_.samples.end) return false;
  if (count == 0) return true;
  if (elapsed_s() + pass_s() / 2 > goal_.seconds) return false;
  if (goal_.noise <= 0 || count < kSamplesForEstimate) return true;
  // The error falls slowly, and looking at all pixels costs: every twentieth sample more is often enough.
  if (estimated_at_ == 0 || count >= estimated_at_ + std::max<std::uint64_t>(1, estimated_at_ / 20)) error_of(film);
  return error_ > goal_.noise;
}

void PathPace::add_pass(double seconds, std::uint64_t rays_so_far) {
  render_s_ += seconds;
  recent_s_ = passes_ == 0 ? seconds : 0.75 * recent_s_ + 0.25 * seconds;
  ++passes_;
  rays_ = rays_so_far;
}

double PathPace::pass_s() const { return recent_s_; }

double PathPace::error_of(const Film& film) {
  error_ = film.relative_error();
  estimated_at_ = film.range().count();
  error_estimated_s_ = elapsed_s();
  return error_;
}

double PathPace::seconds_left(const Film& film) const {
  const double count = double(film.range().count());
  double left = double(goal_.samples.end - film.range().end) * pass_s();
  left = std::min(left, goal_.seconds - elapsed_s());
  if (goal_.noise > 0 && estimated_at_ > 1) {
    const double ratio = error_ / goal_.noise;  // samples grow with its square
    left = std::min(left, std::max(double(estimated_at_) * ratio * ratio - count, 0.0) * pass_s());
  }
  return std::max(left, 0.0);
}

std::string PathPace::text(const Film& film) {
  const std::uint64_t count = film.range().count();
  if (count >= 2 && elapsed_s() > error_estimated_s_ + kEstimateEvery) error_of(film);
  const bool bounded = goal_.samples.end < Film::kMostSamples;
  std::string line =
      bounded ? fmt::format("{} of {} samples", count, goal_.samples.count()) : fmt::format("{} samples", count);
  if (render_s_ > 0) {
    line += fmt::format(", {:.3g} per second, {:.2f} M rays/s", double(passes_) / render_s_,
                        double(rays_) / render_s_ * 1e-6);
  }
  if (estimated_at_ >= 2) line += fmt::format(", error {:.2g} %", 100 * error_);
  const double left = seconds_left(film);
  if (passes_ > 0 && left < 1e7)
    line += left < 100 ? fmt::format(", {:.0f} s left", left) : fmt::format(", {:.0f} min left", left / 60);
  return line;
}

}  // namespace luciole
