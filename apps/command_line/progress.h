// SPDX-License-Identifier: Apache-2.0
// What a user sees while waiting. All of it goes to standard error: standard output is for results.
#pragma once
#include <string>

namespace luciole {

enum class Verbosity { quiet, normal, verbose };

class Progress {
 public:
  explicit Progress(Verbosity verbosity);
  ~Progress();  // ends the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  bool shows_steps() const { return terminal_; }
  void step(const std::string& doing);       // on a terminal: replaces the line before
  void note(const std::string& sentence);    // warnings and defaults: always but with --quiet
  void detail(const std::string& sentence);  // with --verbose

 private:
  void line(const std::string& sentence);

  Verbosity verbosity_;
  bool terminal_;
  bool step_shown_ = false;
};

}  // namespace luciole
