// SPDX-License-Identifier: Apache-2.0
// The program's commands. Each adds itself to the parser and remembers what to run once the line is understood.
#pragma once
#include <functional>

#include "base/result.h"

namespace CLI {
class App;  // the header takes seconds to compile
}

namespace luciole {

inline constexpr int kInterrupted = 130;  // exit code: stopped by Ctrl-C, what was complete is written

// Gives the exit code of a command that was carried out, or why it was not.
using Command = std::function<Result<int>()>;

void add_render_command(CLI::App& program, Command& chosen);
void add_info_command(CLI::App& program, Command& chosen);
void add_make_command(CLI::App& program, Command& chosen);
void add_merge_command(CLI::App& program, Command& chosen);
void add_compare_command(CLI::App& program, Command& chosen);
void add_devices_command(CLI::App& program, Command& chosen);
void add_report_command(CLI::App& program, Command& chosen);

}  // namespace luciole
