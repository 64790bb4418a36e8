// SPDX-License-Identifier: Apache-2.0
// What the kernel is told that brings the lights of texels together; shared with C++.
#ifndef LUCIOLE_PLACEMENT_RECORDS_H
#define LUCIOLE_PLACEMENT_RECORDS_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

struct PlacementPush {
  address_ texels;  // VplRecord, per texel
  address_ counts;  // word per subset: its lights
  address_ lights;  // VplRecord, in the order of subset_layout (light_range/subset_layout.h)
  address_ ranges;  // SubsetRange, n^2 of them
  word_ texel_count;
  word_ subsets;  // n^2
};

#if defined(__cplusplus)
static_assert(sizeof(PlacementPush) == 40);
#endif

LUCIOLE_RECORDS_END

#endif
