// SPDX-License-Identifier: Apache-2.0
#include "image/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace luciole {

namespace fs = std::filesystem;

Error cannot_write(const fs::path& path, const std::string& reason) {
  return Error{ErrorKind::failed, "cannot write " + path.string() + ": " + reason};
}

Result<OutputFile> OutputFile::create(const fs::path& path) {
  std::error_code ignored;  // what cannot be asked shows when the file is opened
  if (path.filename().empty()) return cannot_write(path, "the name of a file is missing");
  const fs::path target = fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : path;
  if (fs::exists(target, ignored) && !fs::is_regular_file(target, ignored)) {
    return cannot_write(path, "it exists and is not a regular file");
  }
  fs::path partial = target;
  partial += ".partial-" + std::to_string(getpid());
  std::FILE* stream = std::fopen(partial.c_str(), "wb");
  if (stream == nullptr) return cannot_write(path, std::strerror(errno));
  return OutputFile(target, partial, stream);
}

OutputFile::OutputFile(fs::path target, fs::path partial, std::FILE* stream)
    : target_(std::move(target)), partial_(std::move(partial)), stream_(stream) {}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : target_(std::move(other.target_)),
      partial_(std::move(other.partial_)),
      stream_(std::exchange(other.stream_, nullptr)) {}

OutputFile::~OutputFile() { discard(); }

void OutputFile::discard() {
  if (stream_ == nullptr) return;
  std::fclose(std::exchange(stream_, nullptr));
  std::error_code ignored;
  fs::remove(partial_, ignored);
}

Status OutputFile::commit() {
  if (std::fflush(stream_) != 0 || std::ferror(stream_) != 0) {
    const std::string reason = std::strerror(errno);
    discard();
    return cannot_write(target_, reason);
  }
  std::fclose(std::exchange(stream_, nullptr));
  std::error_code failure;
  fs::rename(partial_, target_, failure);
  if (!failure) return Done{};
  std::error_code ignored;
  fs::remove(partial_, ignored);
  return cannot_write(target_, failure.message());
}

Status write_text(const std::string& text, const fs::path& path) {
  Result<OutputFile> file = OutputFile::create(path);
  if (!file) return file.error();
  if (std::fwrite(text.data(), 1, text.size(), file->stream()) != text.size()) {
    return cannot_write(path, "the device is full or broken");
  }
  return file->commit();
}

}  // namespace luciole
