// SPDX-License-Identifier: Apache-2.0
// A page and the files beside it, which appear together or not at all: they are written to a folder of their own first.
#pragma once
#include <filesystem>

#include "base/result.h"

namespace luciole {

class PageFolder {
 public:
  // Refused: what exists and is not a folder, and what cannot be written.
  static Result<PageFolder> create(const std::filesystem::path& path);
  PageFolder(PageFolder&& other) noexcept;
  PageFolder& operator=(PageFolder&&) = delete;
  ~PageFolder();  // removes what was not committed

  // Where a file of this name is to be written.
  std::filesystem::path file(const std::string& name) const { return partial_ / name; }

  // Moves the files to their place; in a folder that existed they replace those of the same names, index.html last.
  Status commit();

 private:
  PageFolder(std::filesystem::path target, std::filesystem::path partial, bool existed);

  std::filesystem::path target_, partial_;  // partial_ is empty once it is gone
  bool existed_;
};

}  // namespace luciole
