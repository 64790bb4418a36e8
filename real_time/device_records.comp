// SPDX-License-Identifier: Apache-2.0
// Names every record that C++ and shaders share: device_records_test.cpp reads from its SPIR-V where their members lie.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "real_time/composition/composition_records.h"
#include "real_time/filtering/accumulation_records.h"
#include "real_time/filtering/filter_records.h"
#include "ray_tracing/hierarchy_records.h"
#include "real_time/device_scene/scene_records.h"
#include "real_time/direct_light/direct_records.h"
#include "real_time/geometry_buffer/geometry_records.h"
#include "real_time/geometry_buffer/visibility_records.h"
#include "real_time/light_culling/list_records.h"
#include "real_time/light_culling/sphere_proxy.h"
#include "real_time/light_range/emitters.h"
#include "real_time/light_range/range_records.h"
#include "real_time/reflective_shadow_map/light_map_records.h"
#include "real_time/shading/shading_records.h"
#include "real_time/virtual_point_lights/placement_records.h"

layout(local_size_x = 1) in;
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer Records {
  DiffuseEmitter diffuse_emitters[2];
  GlossyEmitter glossy_emitters[2];
  ManyEmitter many_emitters[2];
  BoundBlock bound_blocks[2];
  VplRecord vpls[2];
  ManyLightRecord many_lights[2];
  RangeFrame range_frames[2];
  RangePush range_pushes[1];
  FilterPush filter_pushes[1];
  PixelLight pixel_lights[2];
  FilterCounts filter_counts[2];
  PixelColour pixel_colours[2];
  CompositionCounts composition_counts[2];
  PastSurfaceRecord past_surfaces[2];
  AccumulationCounts accumulation_counts[2];
  PixelRecord pixels[2];
  PixelSums pixel_sums[2];
  TileCounts tile_counts[2];
  SubsetRange subset_ranges[2];
  HierarchyNode hierarchy_nodes[2];
  HierarchyTriangle hierarchy_triangles[2];
  SlotRecord slots[2];
  MaterialRecord materials[2];
  SurfaceRecord surfaces[2];
  DirectSource direct_sources[2];
  LightMapRecord light_maps[2];
  CellRecord cells[2];
  MeshBounds mesh_bounds[2];
  DrawRecord draws[2];
  IcosahedronProxy icosahedra[2];
  GeodesicProxy geodesics[2];
  SplatCell splat_cells[2];
  PartCounts part_counts[2];
  TextureRecord textures[2];
  MeshRecord meshes[2];
  SceneRecord scenes[2];
  GeometryPush geometry_pushes[1];
  DirectPush direct_pushes[1];
  LightMapPush light_map_pushes[1];
  PlacementPush placement_pushes[1];
  DrawsPush draws_pushes[1];
  VisibilityPush visibility_pushes[1];
  ResolvePush resolve_pushes[1];
  ShadowRecord shadow_records[2];
  ShadowedShadingPush shadowed_pushes[1];
  ShadowedListShadingPush shadowed_list_pushes[1];
  ShadingPush shading_pushes[1];
  CompositionPush composition_pushes[1];
  ToneCurvePush tone_curve_pushes[1];
  AccumulationFrame accumulation_frames[2];
  AccumulationPush accumulation_pushes[1];
  PartPush part_pushes[1];
  MarkPush mark_pushes[1];
  ListShadingPush list_shading_pushes[1];
};
layout(push_constant, scalar) uniform Push { Records records; };

void main() { records.diffuse_emitters[0].xi = 0.0; }
