// SPDX-License-Identifier: Apache-2.0
#include "scene/pbrt_writer.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>

#include "base/setting_table.h"
#include "image/output_file.h"
#include "scene/framing_camera.h"
#include "scene/ply_text.h"
#include "scene/surface.h"

namespace luciole {
namespace {

namespace fs = std::filesystem;

std::string numbers(std::initializer_list<float> values) {
  std::string text = "[";
  for (const float value : values) text += " " + number_text(value + 0.0f);  // no minus before a zero
  return text + " ]";
}
std::string numbers(Vec3 v) { return numbers({v.x, v.y, v.z}); }

// In quotes; what would end the line is replaced.
std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    text += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
  }
  return text + "\"";
}

bool any(Vec3 v) { return v.x > 0 || v.y > 0 || v.z > 0; }

// A material with a shot's overrides, as evaluate_surface sees it.
struct Look {
  Vec3 colour;
  float metallic, ggx_alpha;

  explicit Look(const Material& m)
      : colour(max(min(Vec3(m.base_colour.x, m.base_colour.y, m.base_colour.z), Vec3(1, 1, 1)), Vec3(0, 0, 0))),
        metallic(std::clamp(m.metallic_override >= 0 ? m.metallic_override : m.metallic, 0.0f, 1.0f)),
        ggx_alpha(std::clamp(m.ggx_alpha_override >= 0 ? m.ggx_alpha_override : m.roughness * m.roughness,
                             kLeastGgxAlpha, 1.0f)) {}
  bool lambert(const Material& m) const { return metallic == 0 && !any(m.dielectric_f0) && m.dielectric_f90 == 0; }
  bool white_metal() const { return metallic == 1 && colour.x == 1 && colour.y == 1 && colour.z == 1; }
};

// Whether the normals of all corners lie on the side from which the triangle is counter-clockwise. pbrt takes the side
// of the normals for the front, glTF the winding.
bool normals_face_front(const Mesh& mesh) {
  if (mesh.normals.empty()) return true;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t* corner = &mesh.indices[i];
    const Vec3 a = mesh.positions[corner[0]];
    const Vec3 front = cross(mesh.positions[corner[1]] - a, mesh.positions[corner[2]] - a);
    if (!any(front * front)) continue;
    for (int k = 0; k < 3; ++k) {
      if (!(dot(mesh.normals[corner[k]], front) > 0)) return false;
    }
  }
  return true;
}

// Why pbrt would show a mesh of this material otherwise; empty: it would not.
std::string difference(const Material& material, const Mesh& mesh) {
  for (const TextureSlot* slot : {&material.base_colour_texture, &material.metallic_roughness_texture,
                                  &material.normal_texture, &material.emissive_texture}) {
    if (slot->texture >= 0) return "has a texture, which pbrt would filter in another way";
  }
  if (material.alpha_mode != AlphaMode::opaque) return "is not opaque, which pbrt would sample in another way";
  if (!mesh.colours.empty()) return "is coloured at vertices, which pbrt does not know";
  const Look look(material);
  if (!look.lambert(material) && !look.white_metal()) {
    return "reflects by Schlick's approximation, which pbrt does not know: only Lambert surfaces "
           "(KHR_materials_specular 0) and metals of F0 = 1 are the same in both";
  }
  if (any(material.emission) && !material.double_sided && !normals_face_front(mesh)) {
    return "shines on one side, but the normals of mesh \"" + mesh.name + "\" point to the other";
  }
  return "";
}

// The sentence for what cannot be written; empty: all can be.
std::string refusal(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) {
    const Material& material = scene.materials[mesh.material];
    const std::string reason = mesh.indices.empty() ? "" : difference(material, mesh);
    if (!reason.empty()) return "material \"" + material.name + "\" " + reason;
  }
  for (const PunctualLight& light : scene.lights) {
    if (light.kind == PunctualLight::Kind::spot) {
      return "light \"" + light.name + "\" is a spot, which fades in another way in pbrt between its cones";
    }
  }
  return any(scene.environment.radiance) ? "the scene has a sky, which cannot be written for pbrt" : "";
}

std::string header_text(const PbrtPicture& picture, const fs::path& path) {
  const auto whole = [](std::uint32_t value) { return "[ " + std::to_string(value) + " ]"; };
  return "# Written by Luciole for pbrt-v4. Radiance [W/(m^2 sr)] comes out 1:1.\n"
         "ColorSpace \"srgb\"\n"
         "Film \"rgb\" \"integer xresolution\" " +
         whole(picture.width) + " \"integer yresolution\" " + whole(picture.height) + "\n    \"string filename\" [ " +
         quoted(path.stem().string() + ".exr") +
         " ] \"bool savefp16\" [ false ]\n"
         "    \"string sensor\" [ \"cie1931\" ] \"float iso\" [ 100 ]\n"
         "PixelFilter \"box\" \"float xradius\" [ 0.5 ] \"float yradius\" [ 0.5 ]\n"
         "Sampler \"zsobol\" \"integer pixelsamples\" " +
         whole(picture.samples) + "\nIntegrator \"path\" \"integer maxdepth\" " + whole(picture.bounces) +
         " \"string lightsampler\" [ \"bvh\" ]\n";
}

// pbrt's camera looks along +z with +x to the right: its map from the world is a mirroring one.
std::string camera_text(const Camera& camera, const PbrtPicture& picture) {
  const Vec3 r = camera.right, u = camera.up, f = camera.forward, e = camera.eye;
  const float aspect = static_cast<float>(picture.width) / static_cast<float>(picture.height);
  // pbrt's angle is that of the shorter side.
  const float half_extent = std::tan(camera.vertical_fov / 2) * std::min(1.0f, aspect);
  const float angle_degrees = 2 * std::atan(half_extent) * (180 / std::numbers::pi_v<float>);
  return "Transform " +
         numbers({r.x, u.x, f.x, 0, r.y, u.y, f.y, 0, r.z, u.z, f.z, 0, -dot(r, e), -dot(u, e), -dot(f, e), 1}) +
         "\nCamera \"perspective\" \"float fov\" [ " + number_text(angle_degrees) + " ]\n";
}

// A refractive index of i times one reflects all light at every angle: F0 = 1 without rounding.
std::string material_text(const Material& material) {
  const Look look(material);
  if (look.lambert(material)) {
    return "Material \"diffuse\" \"rgb reflectance\" " + numbers(look.colour);
  }
  return "Material \"conductor\" \"spectrum eta\" [ 300 0 900 0 ] \"spectrum k\" [ 300 1 900 1 ]\n"
         "    \"float roughness\" [ " +
         number_text(look.ggx_alpha) + " ] \"bool remaproughness\" [ false ]";
}

std::string mesh_text(const Material& material, const std::string& ply_name) {
  std::string text = "AttributeBegin  # " + quoted(material.name) + "\n  " + material_text(material) + "\n";
  if (any(material.emission)) {
    text += "  AreaLightSource \"diffuse\" \"rgb L\" " + numbers(material.emission) + " \"bool twosided\" [ " +
            (material.double_sided ? "true" : "false") + " ]\n";
  }
  return text + "  Shape \"plymesh\" \"string filename\" [ " + quoted(ply_name) + " ]\nAttributeEnd\n";
}

std::string light_text(const PunctualLight& light) {
  if (light.kind == PunctualLight::Kind::point) {
    return "LightSource \"point\" \"rgb I\" " + numbers(light.intensity) + " \"point3 from\" " +
           numbers(light.position) + "\n";
  }
  return "LightSource \"distant\" \"rgb L\" " + numbers(light.intensity) + " \"point3 from\" [ 0 0 0 ] \"point3 to\" " +
         numbers(light.direction) + "\n";
}

Status put(const fs::path& path, const std::string& bytes, std::vector<OutputFile>& files) {
  Result<OutputFile> file = OutputFile::create(path);
  if (!file) return file.error();
  if (std::fwrite(bytes.data(), 1, bytes.size(), file->stream()) != bytes.size()) {
    return cannot_write(path, "the disk may be full");
  }
  files.push_back(std::move(*file));
  return Done{};
}

}  // namespace

Status write_pbrt(const Scene& scene, const PbrtPicture& picture, const fs::path& path) try {
  if (path.extension() != ".pbrt") return cannot_write(path, "the name of a file for pbrt ends in .pbrt");
  if (const std::string reason = refusal(scene); !reason.empty()) {
    return Error{ErrorKind::bad_scene, path.string() + ": " + reason};
  }
  std::string text = header_text(picture, path);
  text += camera_text(scene.cameras.empty() ? framing_camera(scene) : scene.cameras.front(), picture);
  text += "WorldBegin\n";
  for (const PunctualLight& light : scene.lights) text += light_text(light);
  std::vector<OutputFile> files;
  for (const Mesh& mesh : scene.meshes) {
    if (mesh.indices.empty()) continue;
    const std::string name = path.stem().string() + "_" + std::to_string(files.size()) + ".ply";
    text += mesh_text(scene.materials[mesh.material], name);
    if (const Status done = put(path.parent_path() / name, ply_text(mesh), files); !done) return done;
  }
  if (const Status done = put(path, text, files); !done) return done;
  for (OutputFile& file : files) {
    if (const Status done = file.commit(); !done) return done;
  }
  return Done{};
} catch (const std::bad_alloc&) {
  return Error{ErrorKind::out_of_memory, path.string() + ": there is not enough memory to write the scene"};
}

}  // namespace luciole
