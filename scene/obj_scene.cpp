// SPDX-License-Identifier: Apache-2.0
#include "scene/obj_scene.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "scene/file_fault.h"
#include "scene/mesh_finish.h"
#include "scene/obj_materials.h"
#include "scene/text_lines.h"
#include "scene/triangulate.h"

namespace luciole::obj {
namespace {

constexpr std::size_t kMostCorners = 1024;
constexpr std::int64_t kAbsent = -1;

// Indices of a corner into the file's lists; kAbsent where the file gives none.
struct Corner {
  std::int64_t position = kAbsent, uv = kAbsent, normal = kAbsent;
  bool operator==(const Corner&) const = default;
};

struct CornerHash {
  std::size_t operator()(const Corner& c) const {
    const auto mix = [](std::uint64_t x) { return (x ^ x >> 29) * 0xbf58476d1ce4e5b9u; };
    return mix(static_cast<std::uint64_t>(c.position) +
               mix(static_cast<std::uint64_t>(c.uv) + mix(static_cast<std::uint64_t>(c.normal))));
  }
};

// Triangles of one material in one group.
struct Part {
  std::unordered_map<Corner, std::uint32_t, CornerHash> vertex_of;
  std::vector<Corner> vertices;
  std::vector<std::uint32_t> indices;
};

class ObjReader {
 public:
  ObjReader(std::string_view text, const FileReader& files, const LoadLimits& limits)
      : lines_(text), library_(files, limits), limits_(limits) {}

  Scene read() {
    while (const std::optional<std::string_view> line = lines_.next()) {
      Words words(*line);
      read_statement(words.next(), words);
      if (!words.bad_number().empty()) {
        library_.warn("numbers", "Numbers like \"" + printable(std::string(words.bad_number())) + "\", " + here() +
                                     ", are read without their misspelt exponent.");
      }
    }
    close_group();
    Scene scene;
    library_.finish(scene);
    finish_meshes(scene.materials);
    scene.meshes = std::move(meshes_);
    return scene;
  }

 private:
  void read_statement(std::string_view keyword, Words& words) {
    if (keyword == "v") {
      read_position(words);
    } else if (keyword == "vt") {
      const float u = required_number(words), v = words.number().value_or(0);
      uvs_.emplace_back(u, 1 - v);
    } else if (keyword == "vn") {
      const float x = required_number(words), y = required_number(words), z = required_number(words);
      normals_.emplace_back(x, y, z);
    } else if (keyword == "f") {
      read_face(words);
    } else if (keyword == "usemtl") {
      material_ = std::string(words.rest());
    } else if (keyword == "mtllib") {
      library_.read_file(std::string(words.rest()));
    } else if (keyword == "g" || keyword == "o") {
      close_group();
      group_ = std::string(words.rest());
    } else if (keyword == "l" || keyword == "p") {
      library_.warn("points and lines", "Points and lines are ignored.");
    }
  }

  std::string here() const { return "line " + std::to_string(lines_.number()); }

  float required_number(Words& words) {
    const std::optional<float> value = words.number();
    if (!value) fail("OBJ_INVALID_NUMBER", here(), "has no finite number where one must be");
    return *value;
  }

  void read_position(Words& words) {
    const float x = required_number(words), y = required_number(words), z = required_number(words);
    positions_.emplace_back(x, y, z);
    // "v x y z r g b"; a single fourth number is a weight, which polygons do not use.
    const std::optional<float> r = words.number(), g = words.number(), b = words.number();
    if (!r || !g || !b) return;
    colours_.resize(positions_.size(), Vec4(1, 1, 1, 1));
    colours_.back() = {std::max(*r, 0.0f), std::max(*g, 0.0f), std::max(*b, 0.0f), 1};
  }

  // OBJ counts from 1, and backwards from the newest with negative numbers.
  std::int64_t resolved(std::string_view text, std::size_t count) {
    std::int64_t index = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), index);
    const auto size = static_cast<std::int64_t>(count);
    if (code != std::errc() || end != text.data() + text.size() || index == 0 || index > size || index < -size) {
      fail("OBJ_INDEX_OOB", here(), "refers to \"" + printable(std::string(text)) + "\" of " + std::to_string(count));
    }
    return index > 0 ? index - 1 : size + index;
  }

  Corner read_corner(std::string_view word) {
    Corner corner;
    const std::size_t first = word.find('/');
    corner.position = resolved(word.substr(0, first), positions_.size());
    if (first == std::string_view::npos) return corner;
    const std::size_t second = word.find('/', first + 1);
    const std::string_view uv = word.substr(first + 1, second == std::string_view::npos ? second : second - first - 1);
    if (!uv.empty()) corner.uv = resolved(uv, uvs_.size());
    if (second != std::string_view::npos && second + 1 < word.size()) {
      corner.normal = resolved(word.substr(second + 1), normals_.size());
    }
    return corner;
  }

  void read_face(Words& words) {
    std::vector<Corner> corners;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      if (corners.size() == kMostCorners) {
        fail("OBJ_POLYGON_TOO_LARGE", here(),
             "has a polygon of more than " + std::to_string(kMostCorners) + " corners");
      }
      corners.push_back(read_corner(word));
    }
    if (corners.size() < 3) {
      library_.warn("degenerate faces", "Faces of fewer than three corners are ignored.");
      return;
    }
    std::vector<Vec3> points;
    for (const Corner& corner : corners) points.push_back(positions_[static_cast<std::size_t>(corner.position)]);
    Part& part = parts_[material_];
    for (const std::uint32_t corner : triangulate(points)) part.indices.push_back(vertex(part, corners[corner]));
  }

  static std::uint32_t vertex(Part& part, const Corner& corner) {
    const auto [entry, is_new] = part.vertex_of.try_emplace(corner, static_cast<std::uint32_t>(part.vertices.size()));
    if (is_new) part.vertices.push_back(corner);
    return entry->second;
  }

  void close_group() {
    for (auto& [material, part] : parts_) {
      vertices_ += part.vertices.size() + part.indices.size();
      if (vertices_ > limits_.vertices) {
        fail("VALUE_NOT_IN_RANGE", here(),
             "the scene has more than " + std::to_string(limits_.vertices) + " vertices and indices");
      }
      const std::uint32_t index = material.empty() ? library_.default_material() : library_.find(material);
      meshes_.push_back(as_mesh(part, index));
    }
    parts_.clear();
  }

  Mesh as_mesh(Part& part, std::uint32_t material) {
    Mesh mesh;
    mesh.name = group_;
    mesh.material = material;
    mesh.indices = std::move(part.indices);
    const auto any = [&](std::int64_t Corner::*member) {
      return std::any_of(part.vertices.begin(), part.vertices.end(), [&](const Corner& c) { return c.*member >= 0; });
    };
    const bool has_normals = any(&Corner::normal), has_uv = any(&Corner::uv);
    for (const Corner& corner : part.vertices) {
      const auto position = static_cast<std::size_t>(corner.position);
      mesh.positions.push_back(positions_[position]);
      // A missing normal stays zero here: normalise_normals gives it its triangle's.
      if (has_normals) {
        mesh.normals.push_back(corner.normal < 0 ? Vec3(0, 0, 0) : normals_[static_cast<std::size_t>(corner.normal)]);
      }
      if (has_uv) mesh.uv[0].push_back(corner.uv < 0 ? Vec2(0, 0) : uvs_[static_cast<std::size_t>(corner.uv)]);
      if (!colours_.empty()) mesh.colours.push_back(position < colours_.size() ? colours_[position] : Vec4(1, 1, 1, 1));
    }
    return mesh;
  }

  void finish_meshes(const std::vector<Material>& materials) {
    for (Mesh& mesh : meshes_) {
      normalise_normals(mesh);
      const TextureSlot& normal_map = materials[mesh.material].normal_texture;
      if (normal_map.texture >= 0) add_tangents(mesh, normal_map);
      transform_mesh(mesh, Affine{}, "group \"" + printable(mesh.name) + "\"");
    }
  }

  Lines lines_;
  MaterialLibrary library_;
  LoadLimits limits_;
  std::vector<Vec3> positions_, normals_;
  std::vector<Vec2> uvs_;
  std::vector<Vec4> colours_;  // of the first positions; empty if the file has none
  std::string group_, material_;
  std::map<std::string, Part> parts_;  // of the current group, by material
  std::vector<Mesh> meshes_;
  std::uint64_t vertices_ = 0;
};

}  // namespace

Scene read_scene(std::span<const std::uint8_t> file, const FileReader& files, const LoadLimits& limits) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  if (text.find('\0') != std::string_view::npos) {
    fail("OBJ_NOT_TEXT", "", "is not plain text; store it as UTF-8 or ASCII");
  }
  return ObjReader(text, files, limits).read();
}

}  // namespace luciole::obj
