// SPDX-License-Identifier: Apache-2.0
#include "report/page_folder.h"

#include <unistd.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "image/output_file.h"

namespace luciole {

namespace fs = std::filesystem;

Result<PageFolder> PageFolder::create(const fs::path& path) {
  std::error_code failure;
  fs::path target = path.lexically_normal();
  if (target.filename().empty()) target = target.parent_path();  // "page/" is "page"
  if (target.empty()) return Error{ErrorKind::usage, "the name of the page's folder is missing"};
  const bool exists = fs::exists(target, failure);
  if (exists && !fs::is_directory(target, failure)) return cannot_write(path, "it exists and is not a folder");
  // Within the folder or beside it: on the same file system, so that moving is renaming.
  fs::path partial = exists ? target / "" : target;
  partial += ".partial-" + std::to_string(getpid());
  fs::remove_all(partial, failure);  // of a process that had the same number and was killed
  if (!fs::create_directory(partial, failure)) return cannot_write(path, failure.message());
  return PageFolder(target, partial, exists);
}

PageFolder::PageFolder(fs::path target, fs::path partial, bool existed)
    : target_(std::move(target)), partial_(std::move(partial)), existed_(existed) {}

PageFolder::PageFolder(PageFolder&& other) noexcept
    : target_(std::move(other.target_)), partial_(std::exchange(other.partial_, {})), existed_(other.existed_) {}

PageFolder::~PageFolder() {
  std::error_code ignored;
  if (!partial_.empty()) fs::remove_all(partial_, ignored);
}

Status PageFolder::commit() {
  std::error_code failure;
  if (!existed_) {
    fs::rename(partial_, target_, failure);
    if (failure) return cannot_write(target_, failure.message());
    partial_.clear();
    return Done{};
  }
  std::vector<fs::path> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(partial_, failure)) {
    names.push_back(entry.path().filename());
  }
  // The page that names the files comes after them.
  std::sort(names.begin(), names.end(), [](const fs::path& a, const fs::path& b) {
    return std::pair(a == "index.html", a) < std::pair(b == "index.html", b);
  });
  for (const fs::path& name : names) {
    if (!failure) fs::rename(partial_ / name, target_ / name, failure);
    if (failure) return cannot_write(target_ / name, failure.message());
  }
  return Done{};  // the destructor removes the empty folder
}

}  // namespace luciole
