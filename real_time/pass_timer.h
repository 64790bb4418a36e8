// SPDX-License-Identifier: Apache-2.0
// How long the CPU's passes take.
#pragma once
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace luciole {

using PassTimes = std::vector<std::pair<std::string, double>>;  // [ms], in the order of the frame

// Adds the times of passes of the same name.
void add_times(PassTimes& sums, const PassTimes& more);

double total_ms(const PassTimes& times);
double of_pass(const PassTimes& times, const std::string& name);

class PassTimer {
 public:
  explicit PassTimer(PassTimes& times) : times_(times) {}
  // The time since the last call (or construction) belongs to this pass.
  void end(const std::string& pass) {
    const auto now = std::chrono::steady_clock::now();
    times_.emplace_back(pass, std::chrono::duration<double, std::milli>(now - last_).count());
    last_ = now;
  }

 private:
  PassTimes& times_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace luciole
