// SPDX-License-Identifier: Apache-2.0
// How far the filter reaches.
#pragma once
#include "real_time/filtering/filter_records.h"

namespace luciole {

// Half the kernel's width and height [pixels]; the taps of both ends weigh a half.
struct FilterRadius {
  int x = 0, y = 0;  // 0 ... kLargestFilterRadius
};

}  // namespace luciole
