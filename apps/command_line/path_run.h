// SPDX-License-Identifier: Apache-2.0
// luciole render --method path: samples until the goal is reached, kept safe on the way.
#pragma once
#include "apps/command_line/path_plan.h"
#include "apps/command_line/render_options.h"
#include "base/result.h"

namespace luciole {

// Gives the exit code.
Result<int> run_path(const RenderOptions& options, PathPlan plan);

}  // namespace luciole
