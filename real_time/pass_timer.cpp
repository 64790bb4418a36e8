// SPDX-License-Identifier: Apache-2.0
#include "real_time/pass_timer.h"

#include <algorithm>

namespace luciole {

void add_times(PassTimes& sums, const PassTimes& more) {
  for (const auto& [name, ms] : more) {
    const auto known =
        std::find_if(sums.begin(), sums.end(), [&, &wanted = name](const auto& sum) { return sum.first == wanted; });
    if (known == sums.end()) {
      sums.emplace_back(name, ms);
    } else {
      known->second += ms;
    }
  }
}

double total_ms(const PassTimes& times) {
  double sum = 0;
  for (const auto& [pass, ms] : times) sum += ms;
  return sum;
}

double of_pass(const PassTimes& times, const std::string& name) {
  double sum = 0;
  for (const auto& [pass, ms] : times) sum += pass == name ? ms : 0;
  return sum;
}

}  // namespace luciole
