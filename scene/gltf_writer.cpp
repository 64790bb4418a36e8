// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_writer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <new>

#include "image/output_file.h"
#include "scene/gltf_animation_writer.h"
#include "scene/gltf_writer_parts.h"

namespace luciole {
namespace {

using gltf::BufferWriter;
using gltf::Bytes;
using gltf::Json;

namespace fs = std::filesystem;

// An image of the document: in the buffer of a .glb, or a file beside a .gltf.
struct SideFile {
  fs::path path;
  Bytes bytes;
};

struct Writing {
  const Scene& scene;
  fs::path path;
  bool binary = false;
  BufferWriter buffer;
  gltf::ExtensionNames extensions;
  std::vector<SideFile> side_files;
  Json document = Json::object();
};

void append_to(Json& document, const char* list, Json item) { document[list].push_back(std::move(item)); }

// Adds a node to the default scene.
void add_node(Writing& out, Json node) {
  append_to(out.document, "nodes", std::move(node));
  out.document["scenes"][0]["nodes"].push_back(out.document["nodes"].size() - 1);
}

Status add_images(Writing& out) {
  std::map<const MipImage*, std::size_t> known;  // one image may serve several textures
  gltf::UniqueNames names;
  for (const Texture& texture : out.scene.textures) {
    const auto [entry, is_new] = known.emplace(texture.image.get(), known.size());
    append_to(out.document, "samplers", gltf::sampler_json(texture));
    append_to(out.document, "textures",
              {{"name", names.give(texture.name, "texture")},
               {"source", entry->second},
               {"sampler", out.document["samplers"].size() - 1}});
    if (!is_new) continue;
    std::optional<Bytes> png = gltf::encode_png(*texture.image);
    if (!png) return cannot_write(out.path, "texture \"" + texture.name + "\" could not be encoded as PNG");
    if (out.binary) {
      const std::size_t view = out.buffer.add_view(png->data(), png->size(), BufferWriter::Target::none);
      append_to(out.document, "images", {{"bufferView", view}, {"mimeType", "image/png"}});
    } else {
      const std::string name = out.path.stem().string() + "_" + std::to_string(entry->second) + ".png";
      append_to(out.document, "images", {{"uri", name}});
      out.side_files.push_back({out.path.parent_path() / name, std::move(*png)});
    }
  }
  return Done{};
}

void add_materials(Writing& out) {
  gltf::UniqueNames names;
  for (const Material& material : out.scene.materials) {
    Json json = gltf::material_json(material, out.extensions);
    json["name"] = names.give(material.name, "material");
    append_to(out.document, "materials", std::move(json));
  }
}

Json primitive_json(const Mesh& mesh, BufferWriter& buffer) {
  Json attributes = {{"POSITION", buffer.add_vectors(mesh.positions, true)}};
  if (!mesh.normals.empty()) attributes["NORMAL"] = buffer.add_vectors(mesh.normals, false);
  if (!mesh.tangents.empty()) attributes["TANGENT"] = buffer.add_vectors(mesh.tangents);
  if (!mesh.uv[0].empty() || !mesh.uv[1].empty()) {
    // TEXCOORD_1 alone is not allowed.
    const std::vector<Vec2> none(mesh.positions.size());
    attributes["TEXCOORD_0"] = buffer.add_vectors(mesh.uv[0].empty() ? none : mesh.uv[0]);
  }
  if (!mesh.uv[1].empty()) attributes["TEXCOORD_1"] = buffer.add_vectors(mesh.uv[1]);
  if (!mesh.colours.empty()) attributes["COLOR_0"] = buffer.add_vectors(mesh.colours);
  return {{"attributes", std::move(attributes)},
          {"indices", buffer.add_indices(mesh.indices)},
          {"material", mesh.material}};
}

// Returns the document's number of each mesh; of an empty one, that of the next.
std::vector<std::size_t> add_meshes(Writing& out) {
  gltf::UniqueNames names;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < out.scene.meshes.size(); ++i) {
    const Mesh& mesh = out.scene.meshes[i];
    numbers.push_back(out.document.contains("meshes") ? out.document["meshes"].size() : 0);
    if (mesh.indices.empty()) continue;  // glTF has no empty accessors
    const std::string name = names.give(mesh.name, "mesh");
    const MovingMesh* moving = gltf::moving_mesh(out.scene, i);
    const Json primitive = primitive_json(moving ? moving->at_rest : mesh, out.buffer);
    append_to(out.document, "meshes", {{"name", name}, {"primitives", Json::array({primitive})}});
    if (!moving) add_node(out, {{"name", name}, {"mesh", numbers.back()}});
  }
  return numbers;
}

void add_lights(Writing& out) {
  if (out.scene.lights.empty()) return;
  gltf::UniqueNames names;
  Json list = Json::array();
  for (const PunctualLight& light : out.scene.lights) {
    const std::string name = names.give(light.name, "light");
    Json json = gltf::light_json(light);
    json["name"] = name;
    Json node = {{"name", name}, {"extensions", {{"KHR_lights_punctual", {{"light", list.size()}}}}}};
    if (light.kind != PunctualLight::Kind::directional) {
      node["translation"] = {light.position.x, light.position.y, light.position.z};
    }
    if (light.kind != PunctualLight::Kind::point) node["rotation"] = gltf::rotation_towards(light.direction);
    if (!gltf::is_moving_light(out.scene, list.size())) add_node(out, std::move(node));
    list.push_back(std::move(json));
  }
  out.document["extensions"]["KHR_lights_punctual"]["lights"] = std::move(list);
  out.extensions.insert("KHR_lights_punctual");
}

void add_cameras(Writing& out) {
  gltf::UniqueNames names;
  for (const Camera& camera : out.scene.cameras) {
    const std::string name = names.give(camera.name, "camera");
    append_to(
        out.document, "cameras",
        {{"name", name}, {"type", "perspective"}, {"perspective", {{"yfov", camera.vertical_fov}, {"znear", 0.01}}}});
    const std::size_t number = out.document["cameras"].size() - 1;
    if (gltf::is_moving_camera(out.scene, number)) continue;
    add_node(out, {{"name", name},
                   {"camera", number},
                   {"translation", {camera.eye.x, camera.eye.y, camera.eye.z}},
                   {"rotation", gltf::rotation_json(camera.right, camera.up, -camera.forward)}});
  }
}

Status build(Writing& out) {
  out.document["asset"] = {{"version", "2.0"}, {"generator", "Luciole"}};
  out.document["scene"] = 0;
  out.document["scenes"] = Json::array({Json{{"name", out.scene.name.empty() ? "scene" : out.scene.name}}});
  if (const Status images = add_images(out); !images) return images;
  add_materials(out);
  const std::vector<std::size_t> meshes = add_meshes(out);
  add_lights(out);
  add_cameras(out);
  gltf::add_animation(out.scene, meshes, out.buffer, out.document);
  if (!out.extensions.empty()) out.document["extensionsUsed"] = out.extensions;
  if (out.buffer.bytes().empty()) return Done{};
  out.document["bufferViews"] = out.buffer.views();
  if (!out.buffer.accessors().empty()) out.document["accessors"] = out.buffer.accessors();
  out.document["buffers"] = Json::array({Json{{"byteLength", out.buffer.bytes().size()}}});
  return Done{};
}

bool put(std::FILE* stream, const void* data, std::size_t size) {
  return size == 0 || std::fwrite(data, 1, size, stream) == size;
}

bool put_words(std::FILE* stream, std::initializer_list<std::uint64_t> words) {
  for (const std::uint64_t word : words) {  // little-endian on every machine
    const std::array<std::uint8_t, 4> bytes = {std::uint8_t(word), std::uint8_t(word >> 8), std::uint8_t(word >> 16),
                                               std::uint8_t(word >> 24)};
    if (!put(stream, bytes.data(), bytes.size())) return false;
  }
  return true;
}

// The container: header, JSON chunk padded with spaces, binary chunk padded with zeros.
Status write_container(const Writing& out, OutputFile& file) {
  std::string json = out.document.dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const Bytes& bytes = out.buffer.bytes();
  const std::uint64_t padding = (4 - bytes.size() % 4) % 4, chunk = bytes.size() + padding;
  const std::uint64_t total = 12 + 8 + json.size() + (chunk > 0 ? 8 + chunk : 0);
  if (total > std::numeric_limits<std::uint32_t>::max()) {
    return cannot_write(out.path, "a .glb holds at most 4 GiB; write a .gltf instead");
  }
  constexpr std::uint32_t kMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;
  const std::array<std::uint8_t, 3> zeros{};
  const bool written =
      put_words(file.stream(), {kMagic, 2, total, json.size(), kJsonChunk}) &&
      put(file.stream(), json.data(), json.size()) &&
      (chunk == 0 || (put_words(file.stream(), {chunk, kBinaryChunk}) &&
                      put(file.stream(), bytes.data(), bytes.size()) && put(file.stream(), zeros.data(), padding)));
  return written ? Status(Done{}) : Status(cannot_write(out.path, "the disk may be full"));
}

// Writes all files beside their names, then gives them their names, the document last.
Status write_separate(Writing& out) {
  if (!out.buffer.bytes().empty()) {
    const std::string name = out.path.stem().string() + ".bin";
    out.document["buffers"][0]["uri"] = name;
    out.side_files.push_back({out.path.parent_path() / name, out.buffer.bytes()});
  }
  const std::string json = out.document.dump(1) + "\n";
  out.side_files.push_back({out.path, Bytes(json.begin(), json.end())});
  std::vector<OutputFile> files;
  for (const SideFile& side : out.side_files) {
    Result<OutputFile> file = OutputFile::create(side.path);
    if (!file) return file.error();
    if (!put(file->stream(), side.bytes.data(), side.bytes.size())) {
      return cannot_write(side.path, "the disk may be full");
    }
    files.push_back(std::move(*file));
  }
  for (OutputFile& file : files) {
    if (const Status done = file.commit(); !done) return done;
  }
  return Done{};
}

}  // namespace

Status write_gltf(const Scene& scene, const fs::path& path) try {
  const std::string extension = path.extension().string();
  if (extension != ".glb" && extension != ".gltf") {
    return cannot_write(path, "the name of a glTF file ends in .glb or .gltf");
  }
  Writing out{scene, path, extension == ".glb", {}, {}, {}, Json::object()};
  if (const Status built = build(out); !built) return built;
  if (!out.binary) return write_separate(out);
  Result<OutputFile> file = OutputFile::create(path);
  if (!file) return file.error();
  if (const Status written = write_container(out, *file); !written) return written;
  return file->commit();
} catch (const std::bad_alloc&) {
  return Error{ErrorKind::out_of_memory, path.string() + ": there is not enough memory to write the scene"};
} catch (const Json::exception&) {
  return cannot_write(path, "a name in the scene is not UTF-8 text");
}

}  // namespace luciole
