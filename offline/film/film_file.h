// SPDX-License-Identifier: Apache-2.0
// A film on disk: an OpenEXR picture that anybody can look at, whose further channels carry the exact sums. Parts,
// checkpoints and what is merged from them are all this one kind of file.
#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "base/result.h"
#include "offline/film/film.h"

namespace luciole {

struct FilmFile {
  Film film;
  std::map<std::string, std::string> metadata;  // what must be equal between parts: scene, settings, instruction set
};

// Each sum is cut into three numbers of 22 bits, which a float holds exactly: channels "sum.00.low", ".middle",
// ".high".
Status write_film(const FilmFile& file, const std::filesystem::path& path);

// Refuses what is no film, or damaged.
Result<FilmFile> read_film(const std::filesystem::path& path);

}  // namespace luciole
