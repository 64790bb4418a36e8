// SPDX-License-Identifier: Apache-2.0
// References from a scene file to other data (RFC 3986, as far as glTF uses it).
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scene/file_access.h"

namespace luciole {

bool is_data_uri(const std::string& uri);

// Decodes "data:[<media type>][;base64],<payload>"; fails with INVALID_URI.
Bytes decode_data_uri(const std::string& uri, const std::string& object);

// Percent-decodes once and refuses whatever could leave the scene's folder: absolute paths, "..", backslashes,
// schemes, control characters. Fails with INVALID_URI, naming `object`.
std::string checked_relative_path(const std::string& uri, const std::string& object);

// Whether a path, taken as it is, names something below the folder that it starts from.
bool stays_below_folder(const std::string& path);

// The bytes behind either kind of reference; failures name `object`.
Bytes resolve_uri(const std::string& uri, const std::string& object, const FileReader& files);

}  // namespace luciole
