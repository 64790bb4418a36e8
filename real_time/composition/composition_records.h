// SPDX-License-Identifier: Apache-2.0
// What the last kernels of a frame read and write, shared with C++.
#ifndef LUCIOLE_COMPOSITION_RECORDS_H
#define LUCIOLE_COMPOSITION_RECORDS_H
#include "base/shared_record.h"

LUCIOLE_RECORDS_BEGIN

// Pixels that a workgroup of these kernels makes.
const int kPictureGroupColumns = 32, kPictureGroupRows = 4;

// Linear Rec. 709.
struct PixelColour {
  float rgb[3];
};

struct CompositionCounts {
  word_ not_finite;  // pixels that were made black for it
};

// Addresses are 0 for what is not there.
struct CompositionPush {
  address_ pixels;           // PixelRecord
  address_ surfaces;         // SurfaceRecord
  address_ direct;           // PixelColour: radiance by the primary lights
  address_ indirect, many;   // PixelLight, filtered
  address_ sums, more_sums;  // PixelSums of indirect light, if it is not filtered; they are added
  address_ many_sums;        // PixelSums of many lights, likewise
  address_ picture;          // PixelColour
  address_ counts;           // CompositionCounts, from 0
  float weight;              // of the sums
  word_ width, height;
  word_ with_emission;  // 0 or 1
};

// What ToneCurve (image/tone_curve.h) is on the device.
const int kLinearCurve = 0, kPbrNeutralCurve = 1;
const int kCodeEdges = 255;  // of 8-bit codes, in ascending order: where each from 1 on begins

struct ToneCurvePush {
  address_ picture;  // PixelColour
  address_ codes;    // word per pixel: red in the lowest byte, green, blue, 255
  address_ edges;    // float, kCodeEdges of them
  float exposure;    // scale E [m^2 sr/W]
  word_ curve;
  word_ width, height;
};

#if defined(__cplusplus)
static_assert(sizeof(PixelColour) == 12 && sizeof(CompositionCounts) == 4);
static_assert(sizeof(CompositionPush) == 96 && offsetof(CompositionPush, with_emission) == 92);
static_assert(sizeof(ToneCurvePush) == 40 && offsetof(ToneCurvePush, height) == 36);
#endif

LUCIOLE_RECORDS_END

#endif
