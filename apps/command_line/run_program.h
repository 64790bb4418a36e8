// SPDX-License-Identifier: Apache-2.0
// Runs the program as a user does: what it writes, what it says, and what it leaves behind. For tests.
#pragma once
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace luciole {

namespace fs = std::filesystem;

inline std::string content(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

struct Outcome {
  int exit_code = -1;
  std::string said, complained;  // standard output, standard error
};

class CommandLine : public testing::Test {
 protected:
  void SetUp() override {
    // Test programs run side by side, and tests of two suites may have one name.
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(LUCIOLE_SCRATCH_DIR) / test.test_suite_name() / test.name();
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "out");
  }

  // Starts `luciole WORDS...` in the test's folder.
  pid_t start(std::vector<std::string> words) {
    words.insert(words.begin(), LUCIOLE_PROGRAM);
    const pid_t child = fork();
    if (child != 0) return child;
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const auto send_to = [](const char* name, int stream) {
      dup2(open(name, O_WRONLY | O_CREAT | O_TRUNC, 0600), stream);
    };
    if (chdir(folder_.c_str()) != 0) _exit(99);
    send_to("said", STDOUT_FILENO), send_to("complained", STDERR_FILENO);
    unsetenv("LUCIOLE_SCENES");
    execv(LUCIOLE_PROGRAM, arguments.data());
    _exit(99);
  }

  Outcome finish(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(folder_ / "said"), content(folder_ / "complained")};
  }

  // Presses Ctrl-C as soon as the program has complained of `word` ("": as soon as it would listen).
  Outcome interrupt(pid_t child, const std::string& word) {
    const auto listens = [&] {
      const std::string status = content("/proc/" + std::to_string(child) + "/status");
      const std::size_t at = status.find("SigCgt:");
      return at != std::string::npos && (std::stoull(status.substr(at + 7), nullptr, 16) >> (SIGINT - 1) & 1u) != 0;
    };
    for (int tries = 0; tries < 6000; ++tries) {  // a minute
      if (listens() && content(folder_ / "complained").find(word) != std::string::npos) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    kill(child, SIGINT);
    return finish(child);
  }

  Outcome run(std::vector<std::string> words) { return finish(start(std::move(words))); }

  std::size_t files_in_out() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_ / "out"), {}));
  }

  fs::path folder_;
};

// What every refusal must look like: the exit code, one line that begins with the program's name, nothing written.
#define EXPECT_REFUSED(code, ...)                                                                               \
  do {                                                                                                          \
    const Outcome refused = run(__VA_ARGS__);                                                                   \
    EXPECT_EQ(refused.exit_code, code) << refused.complained;                                                   \
    EXPECT_EQ(refused.complained.rfind("luciole: ", 0), 0u) << refused.complained;                              \
    EXPECT_EQ(std::count(refused.complained.begin(), refused.complained.end(), '\n'), 1) << refused.complained; \
    EXPECT_EQ(refused.said, "");                                                                                \
    EXPECT_EQ(files_in_out(), 0u);                                                                              \
  } while (false)

}  // namespace luciole
