// SPDX-License-Identifier: Apache-2.0
// A scene as kernels of a device read it (scene.glsl), shared with C++. What the tables of scene/surface_tables.h are
// to the CPU's kernels.
#ifndef LUCIOLE_SCENE_RECORDS_H
#define LUCIOLE_SCENE_RECORDS_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

const word_ kNoTexture = 0xffffffffu;
// Wrap and MipFilter of scene/texture_modes.h.
const word_ kWrapRepeat = 0u, kWrapMirrored = 1u, kWrapClamp = 2u;
const word_ kMipNone = 0u, kMipNearest = 1u, kMipLinear = 2u;

struct TextureRecord {
  address_ texels;                   // a word each, red in the lowest byte; level after level, the finest first
  address_ levels;                   // a word each: its first texel
  word_ width, height;               // of the finest level; each further one halves, rounding down, at least 1
  word_ level_count;                 // at least 1
  word_ srgb;                        // colours are sRGB codes; alpha is linear
  word_ wrap_u, wrap_v, mip_filter;  // as named above
  word_ magnify_linear, minify_linear;
  word_ unused;
};

// uv' = (a b; c d) uv + offset
struct SlotRecord {
  word_ texture;  // kNoTexture: white
  word_ uv_set;
  float a, b, c, d, offset[2];
};

// A material's slots, in the order of its record.
const word_ kSlotOfBaseColour = 0u, kSlotOfRoughness = 1u, kSlotOfNormal = 2u, kSlotOfEmission = 3u,
            kMaterialSlots = 4u;

const word_ kMaterialBytes = 208u;
struct MaterialRecord {
  SlotRecord base_colour_texture, metallic_roughness_texture, normal_texture, emissive_texture;
  float base_colour[4];
  float emission[3];  // factor times strength [W/(m^2 sr)]
  float metallic;
  float dielectric_f0[3];
  float dielectric_f90;
  float roughness, normal_scale;
  float metallic_override, ggx_alpha_override;  // negative: none
  float least_alpha;                            // rays pass where the surface's alpha is below it; 0: nowhere
  word_ emits, double_sided;
  word_ unused;
};

// Addresses of what each vertex has; 0: none.
struct MeshRecord {
  address_ positions, normals;  // 3 floats
  address_ tangents, colours;   // 4 floats
  address_ uv[2];               // 2 floats
  address_ indices;             // 3 words per triangle
  word_ material;
  word_ unused;
};

// What is asked of a mesh before any of its triangles.
struct MeshBounds {
  float low[3], high[3];  // world [m]; low above high where there is no vertex
  word_ triangles;
  word_ has_holes;  // not 0: the alpha of a triangle's points decides whether they are there
};

struct SceneRecord {
  address_ nodes, triangles;  // HierarchyNode, HierarchyTriangle
  address_ meshes, materials, textures;
  address_ linear_from_srgb;                    // 256 floats
  address_ environment;                         // 3 floats per pixel, row 0 is +Y, centre column -Z
  word_ root;                                   // reference of the hierarchy
  word_ environment_width, environment_height;  // 0: `environment_radiance` alone
  float environment_radiance[3];                // multiplies the image if there is one
};

#if defined(__cplusplus)
static_assert(sizeof(TextureRecord) == 56 && sizeof(SlotRecord) == 32);
static_assert(sizeof(MaterialRecord) == kMaterialBytes && offsetof(MaterialRecord, base_colour) == 128);
static_assert(offsetof(MaterialRecord, emissive_texture) == kSlotOfEmission * sizeof(SlotRecord));
static_assert(sizeof(MeshBounds) == 32 && offsetof(MeshBounds, triangles) == 24);
static_assert(sizeof(MeshRecord) == 64 && sizeof(SceneRecord) == 80 && offsetof(SceneRecord, root) == 56);
#endif

LUCIOLE_RECORDS_END

#endif
