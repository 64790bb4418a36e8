// SPDX-License-Identifier: Apache-2.0
// A small scene made of formulas, for the filter's tests and its benchmark: walls, a floor with a step, spheres, sky;
// smooth light that is known exactly, and noise of the kind that interleaved sampling makes.
#pragma once
#include "real_time/shading/radiance.h"

namespace luciole {

struct SyntheticRoom {
  GeometryBuffer geometry;
  Radiance truth;  // without noise
};
SyntheticRoom make_synthetic_room(std::uint32_t width, std::uint32_t height);

// Light whose mean is `truth`: times a factor per sub-region of n x n interleaving (its subset of the lights), times a
// factor per pixel (its roulette). Variances as the renderer has them: a pixel sees 1/n^2 of the lights, so both grow
// with n^2; with n = 8 they are 1/4 and 1. The two parts of the light and their colours share the factors.
Radiance interleaved_noise(const SyntheticRoom& room, std::uint32_t interleave, std::uint64_t seed);

// Mean over surfaces of (a - b)^2 / (b^2 + 0.01 mean(b)^2), of both parts and all channels: relMSE of demodulated
// light.
double relative_error(const SyntheticRoom& room, const Radiance& light);

// From the eye to the sample of a pixel, depth 1.
Vec3 pixel_ray(const GeometryBuffer& geometry, std::uint32_t x, std::uint32_t y);

// A buffer of that size without contents.
void resize_geometry(GeometryBuffer& geometry, std::uint32_t width, std::uint32_t height);
void resize_light(Radiance& light, std::size_t pixels);

}  // namespace luciole
