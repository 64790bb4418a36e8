// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/progress.h"

#include <unistd.h>

#include <cstdio>

namespace luciole {

Progress::Progress(Verbosity verbosity)
    : verbosity_(verbosity), terminal_(isatty(STDERR_FILENO) == 1 && verbosity != Verbosity::quiet) {}

Progress::~Progress() {
  if (step_shown_) std::fputc('\n', stderr);
}

void Progress::step(const std::string& doing) {
  if (!terminal_) return;
  std::fprintf(stderr, "\r\033[K%s", doing.c_str());  // erases the line first
  std::fflush(stderr);
  step_shown_ = true;
}

void Progress::line(const std::string& sentence) {
  if (step_shown_) std::fputs("\r\033[K", stderr);
  step_shown_ = false;
  std::fprintf(stderr, "luciole: %s\n", sentence.c_str());
}

void Progress::note(const std::string& sentence) {
  if (verbosity_ != Verbosity::quiet) line(sentence);
}

void Progress::detail(const std::string& sentence) {
  if (verbosity_ == Verbosity::verbose) line(sentence);
}

}  // namespace luciole
