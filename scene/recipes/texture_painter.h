// SPDX-License-Identifier: Apache-2.0
// Textures made by code: colours and heights as functions of a place on a tile that repeats without a seam.
#pragma once
#include <functional>
#include <string>

#include "scene/scene.h"

namespace luciole::workshop {

// A place on the tile: x to the right, y down, both in [0,1).
using PaintColour = std::function<Vec3(Vec2 place)>;   // linear, in [0,1]
using PaintHeight = std::function<float(Vec2 place)>;  // [m], towards the viewer

enum class Encoding { srgb, linear };

// An image of size x size texels with its mip levels, averaged in linear light. Evaluated at texel centres.
Texture paint(const std::string& name, std::uint32_t size, Encoding encoding, const PaintColour& colour);

// A tangent-space normal map of a height field whose tile is `metres` wide.
Texture paint_normals(const std::string& name, std::uint32_t size, float metres, const PaintHeight& height);

// Gradient-like value noise in about [-1,1] that repeats after `period` cells in both directions.
float tiling_noise(Vec2 place, std::uint32_t period, std::uint32_t seed);
// `octaves` of it, each twice as fine and half as strong; about [-1,1].
float tiling_fractal(Vec2 place, std::uint32_t period, std::uint32_t octaves, std::uint32_t seed);

float smooth_step(float low, float high, float x);
Vec3 blend(Vec3 a, Vec3 b, float t);

}  // namespace luciole::workshop
