// SPDX-License-Identifier: Apache-2.0
// A file that appears whole or not at all: it is written beside its name and renamed when it is complete.
#pragma once
#include <cstdio>
#include <filesystem>
#include <string>

#include "base/result.h"

namespace luciole {

class OutputFile {
 public:
  // Opens "NAME.partial-PID" in the folder of `path`. A link is followed; a folder or a device is refused.
  static Result<OutputFile> create(const std::filesystem::path& path);
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  ~OutputFile();  // removes what was not committed

  std::FILE* stream() const { return stream_; }
  // Flushes, closes and renames; on failure nothing is left behind.
  Status commit();

 private:
  OutputFile(std::filesystem::path target, std::filesystem::path partial, std::FILE* stream);
  void discard();

  std::filesystem::path target_, partial_;
  std::FILE* stream_ = nullptr;
};

// A whole text file.
Status write_text(const std::string& text, const std::filesystem::path& path);

// "cannot write PATH: REASON", as every writer of a file says it.
Error cannot_write(const std::filesystem::path& path, const std::string& reason);

}  // namespace luciole
