// SPDX-License-Identifier: Apache-2.0
#include "scene/load_scene.h"

#include <algorithm>
#include <cctype>
#include <new>

#include "scene/file_fault.h"
#include "scene/gltf_scene.h"
#include "scene/obj_scene.h"

namespace luciole {
namespace {

std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// Runs a reader and turns whatever it throws into a Result; nothing it throws gets past here.
template <class Reader>
Result<Scene> guarded(const std::string& name, const Reader& reader) {
  try {
    return reader();
  } catch (const FileFault& fault) {
    return Error{ErrorKind::bad_scene, name + ": " + fault.what()};
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::out_of_memory, name + ": does not fit into memory"};
  } catch (const std::exception& other) {
    return Error{ErrorKind::bad_scene, name + ": cannot be read: " + printable(other.what())};
  }
}

}  // namespace

Result<Scene> load_gltf(std::span<const std::uint8_t> file, const std::string& name, const FileReader& files,
                        const LoadLimits& limits) {
  return guarded(name, [&] {
    Scene scene = gltf::read_scene(file, name.ends_with(".glb"), files, limits);
    scene.name = name;
    return scene;
  });
}

Result<Scene> load_obj(std::span<const std::uint8_t> file, const std::string& name, const FileReader& files,
                       const LoadLimits& limits) {
  return guarded(name, [&] {
    Scene scene = obj::read_scene(file, files, limits);
    scene.name = name;
    return scene;
  });
}

Result<Scene> load_scene(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  const std::string extension = lower_case_extension(path);
  if (extension != ".gltf" && extension != ".glb" && extension != ".obj") {
    return Error{ErrorKind::bad_scene, name + ": scenes are read from .gltf, .glb and .obj files"};
  }
  const Result<Bytes> file = read_regular_file(path, LoadLimits{}.file_bytes);
  if (!file) return Error{file.error().kind, path.string() + ": " + file.error().message};
  const auto load = extension == ".obj" ? load_obj : load_gltf;
  return load(*file, name, files_in(path.parent_path()), LoadLimits{});
}

}  // namespace luciole
