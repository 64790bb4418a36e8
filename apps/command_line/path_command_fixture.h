// SPDX-License-Identifier: Apache-2.0
// What the tests of path tracing on the command line share.
#pragma once
#include <chrono>
#include <thread>

#include "apps/command_line/run_program.h"

namespace luciole {

using Words = std::vector<std::string>;

class PathCommand : public CommandLine {
 protected:
  // Small enough to be quick; odd, so that tiles are cut.
  static Words small(Words more) {
    Words words = {"render", "recipe:cornell", "--method", "path", "--size", "17x9", "--bounces", "2"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  // Renders and expects success; gives the file's bytes.
  std::string bytes(const std::string& output, Words words) {
    words.insert(words.end(), {"-o", output});
    const Outcome outcome = run(std::move(words));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.complained;
    return content(folder_ / output);
  }

  void write_text(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  // Waits until the file is there.
  bool appears(const std::string& name) {
    for (int i = 0; i < 6000 && !fs::exists(folder_ / name); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return fs::exists(folder_ / name);
  }
};

}  // namespace luciole
