// SPDX-License-Identifier: Apache-2.0
// Records that C++ and shaders share lie alike on both sides: offsets and sizes as the SPIR-V says them.
#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <string>

#include "gpu/shader_code.h"
#include "ray_tracing/hierarchy_records.h"
#include "real_time/composition/composition_records.h"
#include "real_time/device_scene/scene_records.h"
#include "real_time/filtering/accumulation_records.h"
#include "real_time/filtering/filter_records.h"
#include "real_time/geometry_buffer/geometry_records.h"
#include "real_time/light_range/emitters.h"
#include "real_time/light_range/range_records.h"
#include "real_time/shading/shading_records.h"

namespace luciole {

extern const gpu::ShaderCode device_records;

namespace {

// What SPIR-V tells of structs ("Physical Layout of a SPIR-V Module and Instruction" of its specification).
class Layouts {
 public:
  explicit Layouts(const gpu::ShaderCode& code) {
    const std::size_t words = code.bytes / 4;
    for (std::size_t at = 5; at < words; at += code.words[at] >> 16) read(code.words + at);
  }

  // "struct.member" -> offset in bytes.
  std::map<std::string, std::uint32_t> offsets() const {
    std::map<std::string, std::uint32_t> result;
    for (const auto& [key, offset] : offset_of_) {
      const auto structure = name_of_.find(key.first);
      const auto member = member_name_.find(key);
      if (structure != name_of_.end() && member != member_name_.end()) {
        result[structure->second + "." + member->second] = offset;
      }
    }
    return result;
  }

 private:
  static std::string text(const std::uint32_t* words) { return reinterpret_cast<const char*>(words); }

  void read(const std::uint32_t* instruction) {
    constexpr std::uint32_t kName = 5, kMemberName = 6, kMemberDecorate = 72, kOffset = 35;
    const std::uint32_t* const operands = instruction + 1;
    switch (instruction[0] & 0xffffu) {
      case kName:
        name_of_[operands[0]] = text(operands + 1);
        break;
      case kMemberName:
        member_name_[{operands[0], operands[1]}] = text(operands + 2);
        break;
      case kMemberDecorate:
        if (operands[2] == kOffset) offset_of_[{operands[0], operands[1]}] = operands[3];
        break;
      default:
        break;
    }
  }

  using Member = std::pair<std::uint32_t, std::uint32_t>;  // id of the struct, place in it
  std::map<std::uint32_t, std::string> name_of_;
  std::map<Member, std::string> member_name_;
  std::map<Member, std::uint32_t> offset_of_;
};

struct Expected {
  const char* member;
  std::size_t offset;
};
#define LUCIOLE_MEMBER(record, member) \
  Expected { #record "." #member, offsetof(record, member) }

// Every member but those that are only there to fill up.
const Expected kMembers[] = {
    LUCIOLE_MEMBER(DiffuseEmitter, position),
    LUCIOLE_MEMBER(DiffuseEmitter, normal),
    LUCIOLE_MEMBER(DiffuseEmitter, geometric_normal),
    LUCIOLE_MEMBER(DiffuseEmitter, incident),
    LUCIOLE_MEMBER(DiffuseEmitter, intensity),
    LUCIOLE_MEMBER(DiffuseEmitter, probability_scale),
    LUCIOLE_MEMBER(DiffuseEmitter, xi),
    LUCIOLE_MEMBER(DiffuseEmitter, disc),
    LUCIOLE_MEMBER(DiffuseEmitter, f0_max),
    LUCIOLE_MEMBER(DiffuseEmitter, f90),
    LUCIOLE_MEMBER(GlossyEmitter, position),
    LUCIOLE_MEMBER(GlossyEmitter, normal),
    LUCIOLE_MEMBER(GlossyEmitter, geometric_normal),
    LUCIOLE_MEMBER(GlossyEmitter, incident),
    LUCIOLE_MEMBER(GlossyEmitter, flux),
    LUCIOLE_MEMBER(GlossyEmitter, probability_scale),
    LUCIOLE_MEMBER(GlossyEmitter, xi),
    LUCIOLE_MEMBER(GlossyEmitter, disc),
    LUCIOLE_MEMBER(GlossyEmitter, f0),
    LUCIOLE_MEMBER(GlossyEmitter, f90),
    LUCIOLE_MEMBER(GlossyEmitter, alpha_sq),
    LUCIOLE_MEMBER(GlossyEmitter, cos_incident),
    LUCIOLE_MEMBER(GlossyEmitter, masking),
    LUCIOLE_MEMBER(ManyEmitter, position),
    LUCIOLE_MEMBER(ManyEmitter, axis),
    LUCIOLE_MEMBER(ManyEmitter, intensity),
    LUCIOLE_MEMBER(ManyEmitter, probability_scale),
    LUCIOLE_MEMBER(ManyEmitter, xi),
    LUCIOLE_MEMBER(ManyEmitter, disc),
    LUCIOLE_MEMBER(ManyEmitter, scale),
    LUCIOLE_MEMBER(ManyEmitter, offset),
    LUCIOLE_MEMBER(ManyEmitter, two_sided),
    LUCIOLE_MEMBER(ManyEmitter, squared),
    LUCIOLE_MEMBER(BoundBlock, row),
    LUCIOLE_MEMBER(VplRecord, position),
    LUCIOLE_MEMBER(VplRecord, normal),
    LUCIOLE_MEMBER(VplRecord, geometric_normal),
    LUCIOLE_MEMBER(VplRecord, incident),
    LUCIOLE_MEMBER(VplRecord, flux),
    LUCIOLE_MEMBER(VplRecord, diffuse_albedo),
    LUCIOLE_MEMBER(VplRecord, f0),
    LUCIOLE_MEMBER(VplRecord, f90),
    LUCIOLE_MEMBER(VplRecord, ggx_alpha),
    LUCIOLE_MEMBER(VplRecord, area),
    LUCIOLE_MEMBER(VplRecord, key),
    LUCIOLE_MEMBER(VplRecord, is_light),
    LUCIOLE_MEMBER(ManyLightRecord, position),
    LUCIOLE_MEMBER(ManyLightRecord, axis),
    LUCIOLE_MEMBER(ManyLightRecord, intensity),
    LUCIOLE_MEMBER(ManyLightRecord, scale),
    LUCIOLE_MEMBER(ManyLightRecord, offset),
    LUCIOLE_MEMBER(ManyLightRecord, two_sided),
    LUCIOLE_MEMBER(ManyLightRecord, squared),
    LUCIOLE_MEMBER(ManyLightRecord, area),
    LUCIOLE_MEMBER(ManyLightRecord, key),
    LUCIOLE_MEMBER(ManyLightRecord, is_light),
    LUCIOLE_MEMBER(RangeFrame, exposure_over_delta),
    LUCIOLE_MEMBER(RangeFrame, seed),
    LUCIOLE_MEMBER(RangeFrame, frame),
    LUCIOLE_MEMBER(RangeFrame, constant_xi),
    LUCIOLE_MEMBER(RangeFrame, stratified),
    LUCIOLE_MEMBER(RangeFrame, stratum_shift),
    LUCIOLE_MEMBER(RangeFrame, disc),
    LUCIOLE_MEMBER(RangeFrame, subsets),
    LUCIOLE_MEMBER(RangeFrame, eye),
    LUCIOLE_MEMBER(RangeFrame, right),
    LUCIOLE_MEMBER(RangeFrame, up),
    LUCIOLE_MEMBER(RangeFrame, forward),
    LUCIOLE_MEMBER(RangePush, frame),
    LUCIOLE_MEMBER(RangePush, lights),
    LUCIOLE_MEMBER(RangePush, emitters),
    LUCIOLE_MEMBER(RangePush, bounds),
    LUCIOLE_MEMBER(RangePush, count),
    LUCIOLE_MEMBER(FilterPush, pixels),
    LUCIOLE_MEMBER(FilterPush, sums),
    LUCIOLE_MEMBER(FilterPush, more_sums),
    LUCIOLE_MEMBER(FilterPush, filtered),
    LUCIOLE_MEMBER(FilterPush, counts),
    LUCIOLE_MEMBER(FilterPush, right),
    LUCIOLE_MEMBER(FilterPush, up),
    LUCIOLE_MEMBER(FilterPush, forward),
    LUCIOLE_MEMBER(FilterPush, footprint),
    LUCIOLE_MEMBER(FilterPush, left_edge),
    LUCIOLE_MEMBER(FilterPush, top_edge),
    LUCIOLE_MEMBER(FilterPush, weight),
    LUCIOLE_MEMBER(FilterPush, width),
    LUCIOLE_MEMBER(FilterPush, height),
    LUCIOLE_MEMBER(PixelLight, diffuse),
    LUCIOLE_MEMBER(PixelLight, specular),
    LUCIOLE_MEMBER(FilterCounts, not_finite),
    LUCIOLE_MEMBER(PixelRecord, position),
    LUCIOLE_MEMBER(PixelRecord, depth),
    LUCIOLE_MEMBER(PixelRecord, normal),
    LUCIOLE_MEMBER(PixelRecord, f90),
    LUCIOLE_MEMBER(PixelRecord, geometric_normal),
    LUCIOLE_MEMBER(PixelRecord, ggx_alpha),
    LUCIOLE_MEMBER(PixelRecord, f0),
    LUCIOLE_MEMBER(PixelSums, diffuse),
    LUCIOLE_MEMBER(PixelSums, specular),
    LUCIOLE_MEMBER(PixelSums, listed),
    LUCIOLE_MEMBER(PixelSums, accepted),
    LUCIOLE_MEMBER(TileCounts, pixels),
    LUCIOLE_MEMBER(TileCounts, listed),
    LUCIOLE_MEMBER(TileCounts, accepted),
    LUCIOLE_MEMBER(TileCounts, tests),
    LUCIOLE_MEMBER(SubsetRange, begin),
    LUCIOLE_MEMBER(SubsetRange, count),
    LUCIOLE_MEMBER(ShadingPush, pixels),
    LUCIOLE_MEMBER(ShadingPush, emitters),
    LUCIOLE_MEMBER(ShadingPush, bounds),
    LUCIOLE_MEMBER(ShadingPush, subsets),
    LUCIOLE_MEMBER(ShadingPush, sums),
    LUCIOLE_MEMBER(ShadingPush, tile_counts),
    LUCIOLE_MEMBER(ShadingPush, eye),
    LUCIOLE_MEMBER(ShadingPush, right),
    LUCIOLE_MEMBER(ShadingPush, up),
    LUCIOLE_MEMBER(ShadingPush, width),
    LUCIOLE_MEMBER(ShadingPush, height),
    LUCIOLE_MEMBER(ShadingPush, interleave),
    LUCIOLE_MEMBER(ShadingPush, shift),
    LUCIOLE_MEMBER(ShadingPush, first_light),
    LUCIOLE_MEMBER(ShadingPush, light_count),
    LUCIOLE_MEMBER(HierarchyNode, low_x),
    LUCIOLE_MEMBER(HierarchyNode, low_y),
    LUCIOLE_MEMBER(HierarchyNode, low_z),
    LUCIOLE_MEMBER(HierarchyNode, high_x),
    LUCIOLE_MEMBER(HierarchyNode, high_y),
    LUCIOLE_MEMBER(HierarchyNode, high_z),
    LUCIOLE_MEMBER(HierarchyNode, child),
    LUCIOLE_MEMBER(HierarchyTriangle, a),
    LUCIOLE_MEMBER(HierarchyTriangle, b),
    LUCIOLE_MEMBER(HierarchyTriangle, c),
    LUCIOLE_MEMBER(HierarchyTriangle, mesh),
    LUCIOLE_MEMBER(HierarchyTriangle, triangle),
    LUCIOLE_MEMBER(HierarchyTriangle, has_holes),
    LUCIOLE_MEMBER(TextureRecord, texels),
    LUCIOLE_MEMBER(TextureRecord, levels),
    LUCIOLE_MEMBER(TextureRecord, width),
    LUCIOLE_MEMBER(TextureRecord, height),
    LUCIOLE_MEMBER(TextureRecord, level_count),
    LUCIOLE_MEMBER(TextureRecord, srgb),
    LUCIOLE_MEMBER(TextureRecord, wrap_u),
    LUCIOLE_MEMBER(TextureRecord, wrap_v),
    LUCIOLE_MEMBER(TextureRecord, mip_filter),
    LUCIOLE_MEMBER(TextureRecord, magnify_linear),
    LUCIOLE_MEMBER(TextureRecord, minify_linear),
    LUCIOLE_MEMBER(SlotRecord, texture),
    LUCIOLE_MEMBER(SlotRecord, uv_set),
    LUCIOLE_MEMBER(SlotRecord, a),
    LUCIOLE_MEMBER(SlotRecord, b),
    LUCIOLE_MEMBER(SlotRecord, c),
    LUCIOLE_MEMBER(SlotRecord, d),
    LUCIOLE_MEMBER(SlotRecord, offset),
    LUCIOLE_MEMBER(MaterialRecord, base_colour_texture),
    LUCIOLE_MEMBER(MaterialRecord, metallic_roughness_texture),
    LUCIOLE_MEMBER(MaterialRecord, normal_texture),
    LUCIOLE_MEMBER(MaterialRecord, emissive_texture),
    LUCIOLE_MEMBER(MaterialRecord, base_colour),
    LUCIOLE_MEMBER(MaterialRecord, emission),
    LUCIOLE_MEMBER(MaterialRecord, metallic),
    LUCIOLE_MEMBER(MaterialRecord, dielectric_f0),
    LUCIOLE_MEMBER(MaterialRecord, dielectric_f90),
    LUCIOLE_MEMBER(MaterialRecord, roughness),
    LUCIOLE_MEMBER(MaterialRecord, normal_scale),
    LUCIOLE_MEMBER(MaterialRecord, metallic_override),
    LUCIOLE_MEMBER(MaterialRecord, ggx_alpha_override),
    LUCIOLE_MEMBER(MaterialRecord, least_alpha),
    LUCIOLE_MEMBER(MaterialRecord, emits),
    LUCIOLE_MEMBER(MaterialRecord, double_sided),
    LUCIOLE_MEMBER(MeshRecord, positions),
    LUCIOLE_MEMBER(MeshRecord, normals),
    LUCIOLE_MEMBER(MeshRecord, tangents),
    LUCIOLE_MEMBER(MeshRecord, colours),
    LUCIOLE_MEMBER(MeshRecord, uv),
    LUCIOLE_MEMBER(MeshRecord, indices),
    LUCIOLE_MEMBER(MeshRecord, material),
    LUCIOLE_MEMBER(SceneRecord, nodes),
    LUCIOLE_MEMBER(SceneRecord, triangles),
    LUCIOLE_MEMBER(SceneRecord, meshes),
    LUCIOLE_MEMBER(SceneRecord, materials),
    LUCIOLE_MEMBER(SceneRecord, textures),
    LUCIOLE_MEMBER(SceneRecord, linear_from_srgb),
    LUCIOLE_MEMBER(SceneRecord, environment),
    LUCIOLE_MEMBER(SceneRecord, root),
    LUCIOLE_MEMBER(SceneRecord, environment_width),
    LUCIOLE_MEMBER(SceneRecord, environment_height),
    LUCIOLE_MEMBER(SceneRecord, environment_radiance),
    LUCIOLE_MEMBER(SurfaceRecord, diffuse_albedo),
    LUCIOLE_MEMBER(SurfaceRecord, emission),
    LUCIOLE_MEMBER(SurfaceRecord, material),
    LUCIOLE_MEMBER(SurfaceRecord, mesh),
    LUCIOLE_MEMBER(SurfaceRecord, triangle),
    LUCIOLE_MEMBER(SurfaceRecord, u),
    LUCIOLE_MEMBER(SurfaceRecord, v),
    LUCIOLE_MEMBER(GeometryPush, scene),
    LUCIOLE_MEMBER(GeometryPush, pixels),
    LUCIOLE_MEMBER(GeometryPush, surfaces),
    LUCIOLE_MEMBER(GeometryPush, unfinished),
    LUCIOLE_MEMBER(GeometryPush, eye),
    LUCIOLE_MEMBER(GeometryPush, forward),
    LUCIOLE_MEMBER(GeometryPush, top_left),
    LUCIOLE_MEMBER(GeometryPush, across),
    LUCIOLE_MEMBER(GeometryPush, down),
    LUCIOLE_MEMBER(GeometryPush, pixel_size),
    LUCIOLE_MEMBER(GeometryPush, width),
    LUCIOLE_MEMBER(GeometryPush, height),
    LUCIOLE_MEMBER(CompositionCounts, not_finite),
    LUCIOLE_MEMBER(CompositionPush, pixels),
    LUCIOLE_MEMBER(CompositionPush, surfaces),
    LUCIOLE_MEMBER(CompositionPush, direct),
    LUCIOLE_MEMBER(CompositionPush, indirect),
    LUCIOLE_MEMBER(CompositionPush, many),
    LUCIOLE_MEMBER(CompositionPush, sums),
    LUCIOLE_MEMBER(CompositionPush, more_sums),
    LUCIOLE_MEMBER(CompositionPush, many_sums),
    LUCIOLE_MEMBER(CompositionPush, picture),
    LUCIOLE_MEMBER(CompositionPush, counts),
    LUCIOLE_MEMBER(CompositionPush, weight),
    LUCIOLE_MEMBER(CompositionPush, width),
    LUCIOLE_MEMBER(CompositionPush, height),
    LUCIOLE_MEMBER(CompositionPush, with_emission),
    LUCIOLE_MEMBER(ToneCurvePush, picture),
    LUCIOLE_MEMBER(ToneCurvePush, codes),
    LUCIOLE_MEMBER(ToneCurvePush, edges),
    LUCIOLE_MEMBER(ToneCurvePush, exposure),
    LUCIOLE_MEMBER(ToneCurvePush, curve),
    LUCIOLE_MEMBER(ToneCurvePush, width),
    LUCIOLE_MEMBER(ToneCurvePush, height),
    LUCIOLE_MEMBER(PixelColour, rgb),
    LUCIOLE_MEMBER(PastSurfaceRecord, position),
    LUCIOLE_MEMBER(PastSurfaceRecord, diffuse_frames),
    LUCIOLE_MEMBER(PastSurfaceRecord, normal),
    LUCIOLE_MEMBER(PastSurfaceRecord, specular_frames),
    LUCIOLE_MEMBER(PastSurfaceRecord, geometric_normal),
    LUCIOLE_MEMBER(PastSurfaceRecord, material),
    LUCIOLE_MEMBER(AccumulationCounts, not_finite),
    LUCIOLE_MEMBER(AccumulationCounts, many_not_finite),
    LUCIOLE_MEMBER(AccumulationFrame, pixels),
    LUCIOLE_MEMBER(AccumulationFrame, surfaces),
    LUCIOLE_MEMBER(AccumulationFrame, sums),
    LUCIOLE_MEMBER(AccumulationFrame, more_sums),
    LUCIOLE_MEMBER(AccumulationFrame, many_sums),
    LUCIOLE_MEMBER(AccumulationFrame, past_surfaces),
    LUCIOLE_MEMBER(AccumulationFrame, past_indirect),
    LUCIOLE_MEMBER(AccumulationFrame, past_many),
    LUCIOLE_MEMBER(AccumulationFrame, present_surfaces),
    LUCIOLE_MEMBER(AccumulationFrame, present_indirect),
    LUCIOLE_MEMBER(AccumulationFrame, present_many),
    LUCIOLE_MEMBER(AccumulationFrame, frames),
    LUCIOLE_MEMBER(AccumulationFrame, counts),
    LUCIOLE_MEMBER(AccumulationFrame, eye),
    LUCIOLE_MEMBER(AccumulationFrame, past_eye),
    LUCIOLE_MEMBER(AccumulationFrame, past_right),
    LUCIOLE_MEMBER(AccumulationFrame, past_up),
    LUCIOLE_MEMBER(AccumulationFrame, past_forward),
    LUCIOLE_MEMBER(AccumulationFrame, past_pixel_size),
    LUCIOLE_MEMBER(AccumulationFrame, past_sub_pixel_x),
    LUCIOLE_MEMBER(AccumulationFrame, past_sub_pixel_y),
    LUCIOLE_MEMBER(AccumulationFrame, way_back),
    LUCIOLE_MEMBER(AccumulationFrame, weight),
    LUCIOLE_MEMBER(AccumulationFrame, most),
    LUCIOLE_MEMBER(AccumulationFrame, width),
    LUCIOLE_MEMBER(AccumulationFrame, height),
    LUCIOLE_MEMBER(AccumulationPush, frame),
};

// Arrays of two records follow each other in this order: where one begins, the sizes before it added up.
struct Array {
  const char* member;
  std::size_t bytes;
};
const Array kArrays[] = {{"diffuse_emitters", 2 * sizeof(DiffuseEmitter)},
                         {"glossy_emitters", 2 * sizeof(GlossyEmitter)},
                         {"many_emitters", 2 * sizeof(ManyEmitter)},
                         {"bound_blocks", 2 * sizeof(BoundBlock)},
                         {"vpls", 2 * sizeof(VplRecord)},
                         {"many_lights", 2 * sizeof(ManyLightRecord)},
                         {"range_frames", 2 * sizeof(RangeFrame)},
                         {"range_pushes", sizeof(RangePush)},
                         {"filter_pushes", sizeof(FilterPush)},
                         {"pixel_lights", 2 * sizeof(PixelLight)},
                         {"filter_counts", 2 * sizeof(FilterCounts)},
                         {"pixel_colours", 2 * sizeof(PixelColour)},
                         {"composition_counts", 2 * sizeof(CompositionCounts)},
                         {"past_surfaces", 2 * sizeof(PastSurfaceRecord)},
                         {"accumulation_counts", 2 * sizeof(AccumulationCounts)},
                         {"pixels", 2 * sizeof(PixelRecord)},
                         {"pixel_sums", 2 * sizeof(PixelSums)},
                         {"tile_counts", 2 * sizeof(TileCounts)},
                         {"subset_ranges", 2 * sizeof(SubsetRange)},
                         {"hierarchy_nodes", 2 * sizeof(HierarchyNode)},
                         {"hierarchy_triangles", 2 * sizeof(HierarchyTriangle)},
                         {"slots", 2 * sizeof(SlotRecord)},
                         {"materials", 2 * sizeof(MaterialRecord)},
                         {"surfaces", 2 * sizeof(SurfaceRecord)}};

const Array kArraysWithAddresses[] = {{"textures", 2 * sizeof(TextureRecord)},
                                      {"meshes", 2 * sizeof(MeshRecord)},
                                      {"scenes", 2 * sizeof(SceneRecord)},
                                      {"geometry_pushes", sizeof(GeometryPush)},
                                      {"shading_pushes", sizeof(ShadingPush)},
                                      {"composition_pushes", sizeof(CompositionPush)},
                                      {"tone_curve_pushes", sizeof(ToneCurvePush)},
                                      {"accumulation_frames", 2 * sizeof(AccumulationFrame)},
                                      {"accumulation_pushes", sizeof(AccumulationPush)}};

TEST(DeviceRecords, have_their_members_where_shaders_have_them) {
  const auto offsets = Layouts(device_records).offsets();
  for (const Expected& expected : kMembers) {
    const auto found = offsets.find(expected.member);
    ASSERT_NE(found, offsets.end()) << expected.member;
    EXPECT_EQ(found->second, expected.offset) << expected.member;
  }
}

TEST(DeviceRecords, are_as_long_as_in_shaders) {
  const auto offsets = Layouts(device_records).offsets();
  std::size_t begin = 0;
  for (const Array& array : kArrays) {
    EXPECT_EQ(offsets.at(std::string("Records.") + array.member), begin) << "before " << array.member;
    begin += array.bytes;
  }
  begin = (begin + 7) / 8 * 8;  // the others start with an address
  for (const Array& array : kArraysWithAddresses) {
    EXPECT_EQ(offsets.at(std::string("Records.") + array.member), begin) << "before " << array.member;
    begin += array.bytes;
  }
}

TEST(DeviceRecords, of_another_layout_are_caught) {
  struct WithAGap {
    float position[3];
    alignas(16) float normal[3];
  };
  EXPECT_NE(Layouts(device_records).offsets().at("DiffuseEmitter.normal"), offsetof(WithAGap, normal));
}

}  // namespace
}  // namespace luciole
