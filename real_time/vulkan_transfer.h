// SPDX-License-Identifier: Apache-2.0
// Between the CPU's doors and the device's records.
#pragma once
#include "real_time/filtering/filter_records.h"
#include "real_time/geometry_buffer/geometry_buffer.h"
#include "real_time/light_range/light_range_pass.h"
#include "real_time/light_range/subset_layout.h"
#include "real_time/many_lights/many_lights.h"
#include "real_time/shading/shading_pass.h"
#include "real_time/shading/shading_records.h"
#include "real_time/virtual_point_lights/virtual_point_lights.h"

namespace luciole {

void pack(const GeometryBuffer& geometry, PixelRecord* to);                              // one per pixel
void pack(const VirtualPointLights& lights, const SubsetLayout& layout, VplRecord* to);  // one per entry
void pack(const ManyLights& lights, const SubsetLayout& layout, ManyLightRecord* to);    // likewise
void pack(const SubsetLayout& layout, SubsetRange* to);                                  // one per subset

// Back, in the order of their keys.
void unpack(const VplRecord* from, std::size_t entries, VirtualPointLights& lights);

// What the lights of one kind gave: adds to the planes of `out`, which are cleared, and to its counts.
//   weight  n^2
void unpack(const GeometryBuffer& geometry, LightKind kind, const PixelSums* sums, float weight, ShadingOutputs& out);
void unpack(LightKind kind, const TileCounts* tiles, std::size_t count, ShadingOutputs& out);

// What the filter made, into planes of that many pixels.
void unpack(const PixelLight* from, std::size_t pixels, Radiance& light);

}  // namespace luciole
