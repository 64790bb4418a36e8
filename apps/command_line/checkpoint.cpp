// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/checkpoint.h"

#include <signal.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "base/setting_table.h"

namespace luciole {

namespace fs = std::filesystem;

Checkpoint::Checkpoint(fs::path path, double every_s)
    : path_(std::move(path)), every_s_(every_s), written_at_(std::chrono::steady_clock::now()) {
  if (!path_.empty()) remove_leftovers();
}

// A process that was killed while it wrote leaves "NAME.partial-PID" (image/output_file.h).
void Checkpoint::remove_leftovers() const {
  const std::string prefix = path_.filename().string() + ".partial-";
  const fs::path folder = path_.has_parent_path() ? path_.parent_path() : fs::path(".");
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    int process = 0;
    if (name.rfind(prefix, 0) != 0 || !parse_number(std::string_view(name).substr(prefix.size()), process)) continue;
    if (process > 0 && kill(process, 0) != 0 && errno == ESRCH) fs::remove(entry.path(), ignored);
  }
}

Result<std::optional<FilmFile>> Checkpoint::read() const {
  std::error_code ignored;
  if (!fs::exists(path_, ignored)) return std::optional<FilmFile>();
  Result<FilmFile> file = read_film(path_);
  if (!file) return file.error();
  return std::optional<FilmFile>(std::move(*file));
}

bool Checkpoint::is_behind(const Film& film) const {
  return !path_.empty() && film.range().count() > 0 && film.range() != kept_;
}

bool Checkpoint::is_due(const Film& film) const {
  const std::chrono::duration<double> since = std::chrono::steady_clock::now() - written_at_;
  return since.count() >= every_s_ && is_behind(film);
}

Status Checkpoint::write(const FilmFile& file) {
  Status status = write_film(file, path_);
  written_at_ = std::chrono::steady_clock::now();  // also after a failure: the next try is an interval away
  if (status) kept_ = file.film.range();
  return status;
}

}  // namespace luciole
