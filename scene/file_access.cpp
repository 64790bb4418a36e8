// SPDX-License-Identifier: Apache-2.0
#include "scene/file_access.h"

#include <fstream>
#include <system_error>

namespace luciole {

Result<Bytes> read_regular_file(const std::filesystem::path& path, std::uint64_t largest) {
  std::error_code code;
  const std::filesystem::file_status status = std::filesystem::status(path, code);
  if (status.type() == std::filesystem::file_type::not_found)
    return Error{ErrorKind::failed, "no such file (IO_ERROR)"};
  if (code) return Error{ErrorKind::failed, code.message() + " (IO_ERROR)"};
  if (status.type() != std::filesystem::file_type::regular) {
    return Error{ErrorKind::failed, "not a regular file (IO_ERROR)"};
  }
  const std::uint64_t size = std::filesystem::file_size(path, code);
  if (code) return Error{ErrorKind::failed, code.message() + " (IO_ERROR)"};
  if (size > largest)
    return Error{ErrorKind::bad_scene, "larger than " + std::to_string(largest) + " bytes (IO_ERROR)"};
  std::ifstream stream(path, std::ios::binary);
  Bytes bytes(size);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream || static_cast<std::uint64_t>(stream.gcount()) != size) {
    return Error{ErrorKind::failed, "cannot be read (IO_ERROR)"};
  }
  return bytes;
}

FileReader files_in(const std::filesystem::path& folder) {
  return [folder](const std::string& relative_path) {
    return read_regular_file(folder / std::filesystem::path(relative_path), LoadLimits{}.file_bytes);
  };
}

FileReader no_files() {
  return [](const std::string&) -> Result<Bytes> {
    return Error{ErrorKind::bad_scene, "files beside the scene cannot be read here (IO_ERROR)"};
  };
}

}  // namespace luciole
