// SPDX-License-Identifier: Apache-2.0
// The file that keeps a film while it grows. It is whole at any time: written beside its name and renamed.
#pragma once
#include <chrono>
#include <filesystem>
#include <optional>

#include "base/result.h"
#include "offline/film/film_file.h"

namespace luciole {

class Checkpoint {
 public:
  //   path    empty: nothing is ever kept
  //   every   seconds between two writings
  Checkpoint(std::filesystem::path path, double every_s);

  // What an earlier run left; empty if there is no file.
  Result<std::optional<FilmFile>> read() const;

  // Whether the film has grown since it was kept, and the interval is over.
  bool is_due(const Film& film) const;
  bool is_behind(const Film& film) const;
  Status write(const FilmFile& file);

 private:
  void remove_leftovers() const;

  std::filesystem::path path_;
  double every_s_;
  std::chrono::steady_clock::time_point written_at_;
  SampleRange kept_;
};

}  // namespace luciole
