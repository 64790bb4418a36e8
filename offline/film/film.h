// SPDX-License-Identifier: Apache-2.0
// Door: what samples add up to. Sums are whole numbers, so that adding is associative: any split of the samples into
// parts, threads or sessions gives the same bits.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/vector.h"
#include "image/image.h"

namespace luciole {

// One sample of one pixel.
struct FilmSample {
  Vec3 radiance;  // [W/(m^2 sr)]
  Vec3 albedo;    // of the first surface, as denoisers expect it; sky: 0
  Vec3 normal;    // shading normal of the first surface, world space; sky: 0
};

// Samples first ... end - 1 of every pixel.
struct SampleRange {
  std::uint64_t first = 0, end = 0;
  std::uint64_t count() const { return end - first; }
  friend bool operator==(const SampleRange&, const SampleRange&) = default;
};

class Film {
 public:
  // Sums per pixel: radiance and its square per channel (RGB), albedo (RGB), normal (XYZ).
  static constexpr std::size_t kSums = 12, kRadiance = 0, kSquares = 3, kAlbedo = 6, kNormal = 9;
  using Pixel = std::array<std::int64_t, kSums>;
  static constexpr double kLargestFeature = 16;  // of albedo and normal
  static constexpr std::uint64_t kMostSamples = std::uint64_t(1) << 30;

  // exposure: display value per radiance. Sums count steps of 2^-28 (squares 2^-20) display units, whatever the
  // exposure is; albedo and normal 2^-28, up to 16. A single sample is clipped at 2^30 display units to both sides and
  // dropped, as zero, where it is not finite: both are counted. Samples may be negative, where the colour of one light
  // is set right by those of others (ChosenLight::colour_apart). A pixel whose samples sum to more than 2^35 display
  // units stays there (which of several splits gets it there may differ by its negative samples alone); one whose
  // squares sum to more than 2^43 has no estimate of its variance but its bound, mean^2.
  Film(std::uint32_t width, std::uint32_t height, float exposure, std::uint64_t first_sample = 0);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  float exposure() const { return exposure_; }
  SampleRange range() const { return range_; }
  std::uint64_t saturated() const { return saturated_; }  // samples that were clipped or dropped
  const std::vector<Pixel>& pixels() const { return pixels_; }

  // One sample of every pixel, width * height of them: sample range().end.
  void add(const std::vector<FilmSample>& samples);

  // Another part of the same picture, whose samples follow or precede this one's. False, and nothing changed, if sizes
  // or exposures differ, or the ranges leave a gap or overlap.
  bool merge(const Film& other);

  // The mean as "R", "G", "B"; layers by name: albedo, normal, variance (of the mean, per channel).
  Image image(const std::vector<std::string>& layers = {}) const;
  static const std::vector<std::string>& layer_names();

  // sqrt of the estimated relMSE: mean over pixels and channels of variance / (mean^2 + 0.01 (picture's mean)^2).
  // Infinite below two samples. What few samples have not met yet is not in it.
  double relative_error() const;

  // For film_file.h: a film from its sums.
  static Film from_sums(std::uint32_t width, std::uint32_t height, float exposure, SampleRange range,
                        std::uint64_t saturated, std::vector<Pixel> pixels);

 private:
  std::uint32_t width_, height_;
  float exposure_;
  SampleRange range_;
  std::uint64_t saturated_ = 0;
  std::vector<Pixel> pixels_;
};

}  // namespace luciole
