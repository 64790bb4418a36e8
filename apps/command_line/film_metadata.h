// SPDX-License-Identifier: Apache-2.0
// What must be equal between parts and sessions of one picture, and the picture that a film becomes. Equal pictures are
// equal files: no times, dates or thread counts here.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "image/image.h"
#include "image/tone_curve.h"
#include "offline/film/film_file.h"
#include "offline/settings.h"
#include "scene/scene.h"

namespace luciole {

using Metadata = std::map<std::string, std::string>;

//   chosen   the settings with what the tracer chose: PathTracer::settings()
Metadata path_metadata(const std::string& shot, const Scene& scene, const Camera& camera, const PathSettings& chosen);

// What keeps two films apart: "its seed is 2, not 1". Empty if they belong together.
std::string difference(const Metadata& its, const Metadata& wanted);

// The mean with layers, and the metadata with the number of samples.
Image picture_of(const FilmFile& file, const std::vector<std::string>& layers);

// Each name that ends in .exr: with the exact sums if it is a part, else the picture. Each .png: the picture.
Status write_film_outputs(const FilmFile& file, const std::vector<std::filesystem::path>& names,
                          const std::vector<std::string>& layers, ToneCurve curve, bool as_part);

}  // namespace luciole
