// SPDX-License-Identifier: Apache-2.0
// What shading counted -> the statistics of a frame.
#pragma once
#include "real_time/frame.h"
#include "real_time/shading/shading_pass.h"

namespace luciole {

// Lights per pixel, and the lengths of the lists.
void count_lights(const ShadingOutputs& shaded, FrameStatistics& statistics);

double listed_pairs(const ShadingOutputs& shaded);  // of light and pixel, all kinds

// The wall time of culling and shading, split by what the threads spent on each.
void time_shading(const ShadingOutputs& shaded, double wall_ms, FrameStatistics& statistics);

}  // namespace luciole
