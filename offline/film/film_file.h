// SPDX-License-Identifier: Apache-2.0
// A film on disk: an OpenEXR picture that anybody can look at, whose further channels carry the exact sums. Parts and
// checkpoints are both this one kind of file.
#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "base/result.h"
#include "offline/film/film.h"

namespace luciole {

struct FilmFile {
  Film film;
  std::map<std::string, std::string>
      metadata;  // what must be equal between parts: scene, settings, instruction set; no "film." names
};

// Each sum is cut into three whole numbers of 22 bits, which a float holds exactly, as channels "sum.00.low",
// ".middle",
// ".high": sum = low + 2^22 middle + 2^44 high. Low and middle are never negative; high has the sign, as in two's
// complement. Uncompressed: 156 bytes per pixel, written many times faster than ZIP could.
Status write_film(const FilmFile& file, const std::filesystem::path& path);

// Refuses what is no film, or damaged: the file carries a fingerprint of all its sums and metadata.
Result<FilmFile> read_film(const std::filesystem::path& path);

}  // namespace luciole
