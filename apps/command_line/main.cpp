// SPDX-License-Identifier: Apache-2.0
// The program: understands the command line, runs one command, and turns its outcome into one sentence and an exit
// code.
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <new>
#include <string>

#include "apps/command_line/commands.h"
#include "apps/command_line/version.h"
#include "base/parallel.h"

namespace luciole {
namespace {

int explain(const Error& error) {
  std::string sentence = error.message;
  for (char& letter : sentence) {
    if (letter == '\n' || letter == '\r') letter = ' ';
  }
  std::fprintf(stderr, "luciole: %s\n", sentence.c_str());
  return static_cast<int>(error.kind);
}

// The first Ctrl-C asks the frame to stop; the handler is gone then, so that the second one ends the program.
void stop_on_interrupt() {
  struct sigaction action = {};
  action.sa_handler = [](int) { request_stop(); };
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

int run(int argument_count, char** arguments) {
  CLI::App program("Luciole renders scenes with very many lights by stochastic light culling.", "luciole");
  program.require_subcommand(0, 1);
  program.set_version_flag("--version", version_text, "Print version, commit and instruction sets");
  program.footer("Each command explains itself: luciole render --help");
  Command chosen;
  add_render_command(program, chosen);
  add_info_command(program, chosen);
  add_make_command(program, chosen);
  add_merge_command(program, chosen);
  add_compare_command(program, chosen);
  add_report_command(program, chosen);
  add_devices_command(program, chosen);
  try {
    program.parse(argument_count, arguments);
  } catch (const CLI::Success& asked_for_text) {
    return program.exit(asked_for_text);
  } catch (const CLI::ParseError& misuse) {
    return explain({ErrorKind::usage, std::string(misuse.what()) + " (see luciole --help)"});
  }
  if (!chosen) {
    return explain({ErrorKind::usage,
                    "a command is needed: render, info, make, merge, compare, report or devices (see luciole --help)"});
  }
  const Result<int> outcome = chosen();
  if (!outcome) return explain(outcome.error());
  if (std::fflush(stdout) != 0) return explain({ErrorKind::failed, "cannot write to standard output"});
  return *outcome;
}

}  // namespace
}  // namespace luciole

int main(int argument_count, char** arguments) {
  luciole::stop_on_interrupt();
  try {
    return luciole::run(argument_count, arguments);
  } catch (const std::bad_alloc&) {
    return luciole::explain(
        {luciole::ErrorKind::out_of_memory, "out of memory; a smaller --size or fewer --vpls help"});
  } catch (const std::exception& unforeseen) {
    return luciole::explain({luciole::ErrorKind::failed, unforeseen.what()});
  }
}
