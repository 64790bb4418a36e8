// SPDX-License-Identifier: Apache-2.0
// How fast a progressive rendering goes, how far it is from its goal, and whether it has reached it.
#pragma once
#include <chrono>
#include <cstdint>
#include <string>

#include "apps/command_line/path_plan.h"
#include "offline/film/film.h"

namespace luciole {

class PathPace {
 public:
  using Clock = std::chrono::steady_clock;

  // Time begins to count here.
  explicit PathPace(const PathGoal& goal) : goal_(goal), start_(Clock::now()) {}

  // Whether another pass is due. A pass is begun if it will end nearer to the wanted time than stopping now would.
  bool goes_on(const Film& film);

  // A pass took so long, and traced so many rays so far.
  void add_pass(double seconds, std::uint64_t rays_so_far);

  double elapsed_s() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  double render_s() const { return render_s_; }  // in passes; writing and the like is left out
  std::uint64_t passes() const { return passes_; }

  // "12 of 64 samples, 0.8 per second, 3.1 M rays/s, error 4.2 %, 65 s left". Looks at the whole film at times.
  std::string text(const Film& film);

 private:
  double pass_s() const;  // of the next one
  double error_of(const Film& film);
  double seconds_left(const Film& film) const;

  PathGoal goal_;
  Clock::time_point start_;
  double render_s_ = 0, recent_s_ = 0;
  std::uint64_t passes_ = 0, rays_ = 0;
  std::uint64_t estimated_at_ = 0;  // samples
  double error_ = 0, error_estimated_s_ = -1e9;
};

}  // namespace luciole
