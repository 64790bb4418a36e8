// SPDX-License-Identifier: Apache-2.0
// Records that C++ and shaders share lie alike on both sides: offsets and sizes as the SPIR-V says them.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "ray_tracing/hierarchy_records.h"
#include "real_time/composition/composition_records.h"
#include "real_time/device_scene/scene_records.h"
#include "real_time/direct_light/direct_records.h"
#include "real_time/filtering/accumulation_records.h"
#include "real_time/filtering/filter_records.h"
#include "real_time/geometry_buffer/geometry_records.h"
#include "real_time/geometry_buffer/visibility_records.h"
#include "real_time/light_culling/list_records.h"
#include "real_time/light_culling/sphere_proxy.h"
#include "real_time/light_range/emitters.h"
#include "real_time/light_range/range_records.h"
#include "real_time/reflective_shadow_map/light_map_records.h"
#include "real_time/shading/shading_records.h"
#include "real_time/spirv_layouts.h"
#include "real_time/virtual_point_lights/placement_records.h"

namespace luciole {

extern const gpu::ShaderCode device_records;

namespace {

struct Expected {
  const char* member;
  std::size_t offset;
};
// EACH(Record, member, ...): an Expected of each member.
#define PARENTHESES ()
#define REPEAT(...) REPEAT_4(REPEAT_4(REPEAT_4(REPEAT_4(__VA_ARGS__))))
#define REPEAT_4(...) REPEAT_3(REPEAT_3(REPEAT_3(REPEAT_3(__VA_ARGS__))))
#define REPEAT_3(...) REPEAT_2(REPEAT_2(__VA_ARGS__))
#define REPEAT_2(...) __VA_ARGS__
#define EACH(record, ...) REPEAT(EACH_STEP(record, __VA_ARGS__))
#define EACH_STEP(record, member, ...) \
  {#record "." #member, offsetof(record, member)}, __VA_OPT__(EACH_AGAIN PARENTHESES(record, __VA_ARGS__))
#define EACH_AGAIN() EACH_STEP

// Every member but those that are only there to fill up.
// clang-format off
const Expected kMembers[] = {
    EACH(DiffuseEmitter, position, normal, geometric_normal, incident, intensity, probability_scale, xi, disc,
         f0_max, f90)
    EACH(GlossyEmitter, position, normal, geometric_normal, incident, flux, probability_scale, xi, disc, f0, f90,
         alpha_sq, cos_incident, masking)
    EACH(ManyEmitter, position, axis, intensity, probability_scale, xi, disc, scale, offset, two_sided, squared)
    EACH(BoundBlock, row)
    EACH(VplRecord, position, normal, geometric_normal, incident, flux, diffuse_albedo, f0, f90, ggx_alpha, area,
         key, is_light)
    EACH(ManyLightRecord, position, axis, intensity, scale, offset, two_sided, squared, area, key, is_light)
    EACH(RangeFrame, exposure_over_delta, seed, frame, constant_xi, stratified, stratum_shift, disc, subsets, eye,
         right, up, forward)
    EACH(RangePush, frame, lights, emitters, bounds, count)
    EACH(FilterPush, pixels, sums, more_sums, filtered, counts, right, up, forward, footprint, left_edge, top_edge,
         weight, width, height)
    EACH(PixelLight, diffuse, specular)
    EACH(FilterCounts, not_finite)
    EACH(PixelRecord, position, depth, normal, f90, geometric_normal, ggx_alpha, f0)
    EACH(PixelSums, diffuse, specular, listed, accepted)
    EACH(TileCounts, pixels, listed, accepted, tests)
    EACH(SubsetRange, begin, count)
    EACH(ShadingPush, pixels, emitters, bounds, subsets, sums, tile_counts, eye, right, up, width, height,
         interleave, shift, first_light, light_count)
    EACH(ShadowRecord, scene, unfinished, surface_offset)
    EACH(ShadowedShadingPush, shading, shadows)
    EACH(ShadowedListShadingPush, shading, shadows)
    EACH(HierarchyNode, low_x, low_y, low_z, high_x, high_y, high_z, child)
    EACH(HierarchyTriangle, a, b, c, mesh, triangle, has_holes)
    EACH(TextureRecord, texels, levels, width, height, level_count, srgb, wrap_u, wrap_v, mip_filter,
         magnify_linear, minify_linear)
    EACH(SlotRecord, texture, uv_set, a, b, c, d, offset)
    EACH(MaterialRecord, base_colour_texture, metallic_roughness_texture, normal_texture, emissive_texture,
         base_colour, emission, metallic, dielectric_f0, dielectric_f90, roughness, normal_scale, metallic_override,
         ggx_alpha_override, least_alpha, emits, double_sided)
    EACH(MeshRecord, positions, normals, tangents, colours, uv, indices, material)
    EACH(SceneRecord, nodes, triangles, meshes, materials, textures, linear_from_srgb, environment, root,
         environment_width, environment_height, environment_radiance)
    EACH(SurfaceRecord, diffuse_albedo, emission, material, mesh, triangle, u, v)
    EACH(GeometryPush, scene, pixels, surfaces, unfinished, eye, forward, top_left, across, down, pixel_size, width,
         height)
    EACH(DirectSource, sun, position, direction, colour, scale, offset)
    EACH(LightMapRecord, kind, first_texel, texels, rows, origin, right, up, axis, width, height, cos_outer, ramp,
         flux, solid_angle, parallel_area)
    EACH(CellRecord, row, column)
    EACH(DirectPush, scene, pixels, surfaces, sources, radiance, unfinished, eye, surface_offset, pixel_count,
         first_source, source_count)
    EACH(LightMapPush, scene, maps, cells, lights, counts, unfinished, map_count, texel_count, subsets, is_random,
         seed, frame)
    EACH(PlacementPush, texels, counts, lights, ranges, texel_count, subsets)
    EACH(CompositionCounts, not_finite)
    EACH(CompositionPush, pixels, surfaces, direct, indirect, many, sums, more_sums, many_sums, picture, counts,
         weight, width, height, with_emission)
    EACH(ToneCurvePush, picture, codes, edges, exposure, curve, width, height)
    EACH(PixelColour, rgb)
    EACH(PastSurfaceRecord, position, diffuse_frames, normal, specular_frames, geometric_normal, material)
    EACH(AccumulationCounts, not_finite, many_not_finite)
    EACH(AccumulationFrame, pixels, surfaces, sums, more_sums, many_sums, past_surfaces, past_indirect, past_many,
         present_surfaces, present_indirect, present_many, frames, counts, eye, past_eye, past_right, past_up,
         past_forward, past_pixel_size, past_sub_pixel_x, past_sub_pixel_y, way_back, weight, most, width, height)
    EACH(AccumulationPush, frame)
    EACH(MeshBounds, low, high, triangles, has_holes)
    EACH(DrawRecord, vertices, instances, first_vertex, mesh)
    EACH(Projection, eye, x, y, w, near)
    EACH(DrawsPush, bounds, draws, projection, meshes)
    EACH(VisibilityPush, scene, projection, top_left, across, down)
    EACH(ResolvePush, geometry, visibility)
    EACH(IcosahedronProxy, vertex, edge_from, edge_to, slab_normal, distance)
    EACH(GeodesicProxy, corner, normal, distance)
    EACH(SplatCell, x, y, depth, nearest)
    EACH(PartCounts, pixels, listed, pairs, accepted, tests)
    EACH(PartPush, pixels, depths, occupied, cells, eye, right, up, width, height, interleave)
    EACH(MarkPush, bounds, subsets, depths, occupied, cells, proxy, lists, covering, counts, pixel, width, height,
         interleave, shift, first_light, words)
    EACH(ListShadingPush, pixels, emitters, subsets, sums, depths, lists, covering, counts, eye, width, height,
         interleave, shift, first_light, words)
};
// clang-format on

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
                         {"surfaces", 2 * sizeof(SurfaceRecord)},
                         {"direct_sources", 2 * sizeof(DirectSource)},
                         {"light_maps", 2 * sizeof(LightMapRecord)},
                         {"cells", 2 * sizeof(CellRecord)},
                         {"mesh_bounds", 2 * sizeof(MeshBounds)},
                         {"draws", 2 * sizeof(DrawRecord)},
                         {"icosahedra", 2 * sizeof(IcosahedronProxy)},
                         {"geodesics", 2 * sizeof(GeodesicProxy)},
                         {"splat_cells", 2 * sizeof(SplatCell)},
                         {"part_counts", 2 * sizeof(PartCounts)}};

const Array kArraysWithAddresses[] = {{"textures", 2 * sizeof(TextureRecord)},
                                      {"meshes", 2 * sizeof(MeshRecord)},
                                      {"scenes", 2 * sizeof(SceneRecord)},
                                      {"geometry_pushes", sizeof(GeometryPush)},
                                      {"direct_pushes", sizeof(DirectPush)},
                                      {"light_map_pushes", sizeof(LightMapPush)},
                                      {"placement_pushes", sizeof(PlacementPush)},
                                      {"draws_pushes", sizeof(DrawsPush)},
                                      {"visibility_pushes", sizeof(VisibilityPush)},
                                      {"resolve_pushes", sizeof(ResolvePush)},
                                      {"shadow_records", 2 * sizeof(ShadowRecord)},
                                      {"shadowed_pushes", sizeof(ShadowedShadingPush)},
                                      {"shadowed_list_pushes", sizeof(ShadowedListShadingPush)},
                                      {"shading_pushes", sizeof(ShadingPush)},
                                      {"composition_pushes", sizeof(CompositionPush)},
                                      {"tone_curve_pushes", sizeof(ToneCurvePush)},
                                      {"accumulation_frames", 2 * sizeof(AccumulationFrame)},
                                      {"accumulation_pushes", sizeof(AccumulationPush)},
                                      {"part_pushes", sizeof(PartPush)},
                                      {"mark_pushes", sizeof(MarkPush)},
                                      {"list_shading_pushes", sizeof(ListShadingPush)}};

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
