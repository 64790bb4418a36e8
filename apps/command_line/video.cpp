// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/video.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <thread>

#include "apps/command_line/output_files.h"

extern char** environ;

namespace luciole {
namespace {

namespace fs = std::filesystem;

// An encoder that takes nothing for so long will never take it; so will one that has all frames and does not end.
constexpr int kPatience_ms = 120'000;

bool is_on_path(const char* program) {
  const char* path = std::getenv("PATH");
  std::string_view folders = path == nullptr ? "" : path;
  while (true) {
    const std::size_t end = folders.find(':');
    const fs::path candidate = fs::path(folders.substr(0, end)) / program;
    std::error_code ignored;
    if (fs::is_regular_file(candidate, ignored) && access(candidate.c_str(), X_OK) == 0) return true;
    if (end == std::string_view::npos) return false;
    folders.remove_prefix(end + 1);
  }
}

Error ffmpeg_is_missing() {
  return {ErrorKind::failed,
          "--video needs the program ffmpeg, which is not on the PATH (Debian: apt-get install ffmpeg)"};
}

// Its last line of complaint.
std::string last_line(std::FILE* file) {
  if (file == nullptr) return {};
  char text[2001];
  const long size = std::fseek(file, 0, SEEK_END) == 0 ? std::ftell(file) : 0;
  std::fseek(file, std::max(0L, size - 2000), SEEK_SET);
  std::string tail(text, std::fread(text, 1, 2000, file));
  while (!tail.empty() && (tail.back() == '\n' || tail.back() == '\r')) tail.pop_back();
  const std::size_t line = tail.find_last_of("\n\r");
  tail = line == std::string::npos ? tail : tail.substr(line + 1);
  std::replace_if(
      tail.begin(), tail.end(), [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; }, ' ');
  return tail;
}

// A pipe whose ends are not inherited; the end to write to never blocks.
bool open_pipe(int& to_read, int& to_write) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return false;
  to_read = ends[0], to_write = ends[1];
  return fcntl(to_write, F_SETFL, O_NONBLOCK) == 0;
}

// All bytes, or false: the reader is gone or takes nothing. SIGPIPE must be ignored.
bool write_all(int pipe, const std::vector<std::uint8_t>& bytes) {
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t more = write(pipe, bytes.data() + written, bytes.size() - written);
    if (more > 0) {
      written += static_cast<std::size_t>(more);
    } else if (errno == EAGAIN) {
      pollfd wait{pipe, POLLOUT, 0};
      const int ready = poll(&wait, 1, kPatience_ms);
      if (ready == 0 || (ready < 0 && errno != EINTR)) return false;
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

}  // namespace

Status check_video(const VideoFormat& format) {
  const std::string name = format.path.string();
  if (format.path.extension().empty()) return Error{ErrorKind::usage, name + ": --video needs a name like FILE.mp4"};
  if (format.width % 2 != 0 || format.height % 2 != 0) {
    return Error{ErrorKind::usage,
                 fmt::format("--video needs even width and height, not {}x{}", format.width, format.height)};
  }
  if (!is_on_path("ffmpeg")) return ffmpeg_is_missing();
  return check_writable(format.path);
}

VideoWriter::VideoWriter(VideoFormat format, fs::path partial)
    : format_(std::move(format)), partial_(std::move(partial)) {}

VideoWriter::VideoWriter(VideoWriter&& other) noexcept
    : format_(std::move(other.format_)),
      partial_(std::move(other.partial_)),
      child_(std::exchange(other.child_, 0)),
      status_(other.status_),
      pipe_(std::exchange(other.pipe_, -1)),
      complaints_(std::exchange(other.complaints_, nullptr)) {
  other.partial_.clear();
}

VideoWriter::~VideoWriter() {
  discard();
  if (complaints_ != nullptr) std::fclose(complaints_);
}

Result<VideoWriter> VideoWriter::start(const VideoFormat& format) {
  // ffmpeg tells the container by the ending, so that the name keeps it.
  const fs::path partial = format.path.parent_path() / fmt::format("{}.partial-{}{}", format.path.stem().string(),
                                                                   getpid(), format.path.extension().string());
  VideoWriter writer(format, partial);
  if (Status status = writer.spawn(); !status) return status.error();
  return writer;
}

Status VideoWriter::spawn() {
  int to_read = -1;
  complaints_ = std::tmpfile();
  if (complaints_ == nullptr || !open_pipe(to_read, pipe_)) {
    return Error{ErrorKind::failed, std::string("--video: cannot open a pipe: ") + std::strerror(errno)};
  }
  // A write to an encoder that has ended must say so instead of ending this program.
  signal(SIGPIPE, SIG_IGN);
  std::vector<std::string> words = {"ffmpeg",
                                    "-nostdin",
                                    "-y",
                                    "-loglevel",
                                    "error",
                                    "-f",
                                    "rawvideo",
                                    "-pix_fmt",
                                    "rgb24",
                                    "-video_size",
                                    fmt::format("{}x{}", format_.width, format_.height),
                                    "-framerate",
                                    fmt::format("{}", format_.frames_per_second),
                                    "-i",
                                    "pipe:0",
                                    "-pix_fmt",
                                    "yuv420p",
                                    "file:" + partial_.string()};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t streams;
  posix_spawn_file_actions_init(&streams);
  posix_spawn_file_actions_adddup2(&streams, to_read, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&streams, fileno(complaints_), STDERR_FILENO);
  posix_spawn_file_actions_addopen(&streams, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  // A process group of its own: Ctrl-C reaches this program alone.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t usual;
  sigemptyset(&usual);
  sigaddset(&usual, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &usual);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  const int failure = posix_spawnp(&child_, "ffmpeg", &streams, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&streams);
  posix_spawnattr_destroy(&attributes);
  close(to_read);
  if (failure == 0) return Done{};
  child_ = 0;
  if (failure == ENOENT) return ffmpeg_is_missing();
  return Error{ErrorKind::failed, std::string("--video: ffmpeg cannot be started: ") + std::strerror(failure)};
}

bool VideoWriter::wait_for_end(double seconds) {
  const auto start = std::chrono::steady_clock::now();
  while (child_ != 0) {
    const pid_t ended = waitpid(child_, &status_, WNOHANG);
    if (ended != 0) child_ = 0;
    if (child_ == 0) break;
    if (std::chrono::steady_clock::now() - start > std::chrono::duration<double>(seconds)) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

Error VideoWriter::explain(const std::string& what) {
  const std::string said = last_line(complaints_);
  discard();
  return {ErrorKind::failed,
          "cannot write " + format_.path.string() + ": ffmpeg " + what + (said.empty() ? "" : ": " + said)};
}

Status VideoWriter::add(const std::vector<std::uint8_t>& codes) {
  if (write_all(pipe_, codes)) return Done{};
  return explain(wait_for_end(1) ? "ended before the last frame" : "takes no more frames");
}

Status VideoWriter::finish() {
  close(std::exchange(pipe_, -1));
  if (!wait_for_end(kPatience_ms * 1e-3)) return explain("does not end");
  if (!WIFEXITED(status_)) return explain(fmt::format("was ended by signal {}", WTERMSIG(status_)));
  if (WEXITSTATUS(status_) != 0) return explain(fmt::format("failed with exit code {}", WEXITSTATUS(status_)));
  std::error_code failure;
  fs::rename(partial_, format_.path, failure);
  if (failure) return explain("left no file");
  partial_.clear();
  return Done{};
}

void VideoWriter::discard() {
  if (pipe_ >= 0) close(std::exchange(pipe_, -1));
  if (child_ != 0) {
    kill(child_, SIGKILL);
    waitpid(std::exchange(child_, 0), &status_, 0);
  }
  std::error_code ignored;
  if (!partial_.empty()) fs::remove(std::exchange(partial_, {}), ignored);
}

}  // namespace luciole
