// SPDX-License-Identifier: Apache-2.0
#include "offline/film/film.h"

#include <emmintrin.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "base/assert.h"
#include "base/parallel.h"

namespace luciole {
namespace {

constexpr std::int64_t kFull = std::numeric_limits<std::int64_t>::max();
constexpr double kValueSteps = 0x1p28;                             // per display unit; albedo and normal: per 1
constexpr double kSquareSteps = 0x1p20;                            // per squared display unit
constexpr double kLargestValue = 0x1p30, kLargestSquare = 0x1p42;  // of one sample; steps stay below 2^62
constexpr double kLargestFeature = Film::kLargestFeature;
constexpr std::size_t kGrain = 4096;  // [pixels]
constexpr auto kSquares = Film::kSquares, kAlbedo = Film::kAlbedo, kNormal = Film::kNormal;

// A sum that is full stays full: min(a + b, full) is associative for a, b >= 0.
std::int64_t add_up_to_full(std::int64_t a, std::int64_t b) {
  if (a == kFull || b == kFull || (b > 0 && a > kFull - b)) return kFull;
  return b < 0 && a < -kFull - b ? -kFull : a + b;
}

// To nearest. The library's llrint is a call, because it may report errors.
std::int64_t steps(double value, double steps_per_unit) { return _mm_cvtsd_si64(_mm_set_sd(value * steps_per_unit)); }

// A component of albedo or normal. Their sums are signed and small: kMostSamples of any size fit.
std::int64_t bounded_steps(float value) {
  return std::isfinite(value) ? steps(std::clamp(double(value), -kLargestFeature, kLargestFeature), kValueSteps) : 0;
}

// True if the sample was whole: else it was clipped or dropped.
bool add_sample(Film::Pixel& sums, const FilmSample& sample, double exposure) {
  const double radiance[3] = {sample.radiance.x, sample.radiance.y, sample.radiance.z};
  const bool finite = std::isfinite(radiance[0] + radiance[1] + radiance[2]);  // doubles: finite floats stay finite
  bool whole = finite;
  for (std::size_t i = 0; i < 3; ++i) {
    // One channel that is not finite makes a wrong colour: all three go.
    const double asked = finite ? radiance[i] * exposure : 0;
    const double value = std::clamp(asked, -kLargestValue, kLargestValue);
    whole = whole && value == asked;
    sums[i] = add_up_to_full(sums[i], steps(value, kValueSteps));
    const double square = std::min(value * value, kLargestSquare);
    sums[kSquares + i] = add_up_to_full(sums[kSquares + i], steps(square, kSquareSteps));
  }
  const float albedo[3] = {sample.albedo.x, sample.albedo.y, sample.albedo.z};
  const float normal[3] = {sample.normal.x, sample.normal.y, sample.normal.z};
  for (std::size_t i = 0; i < 3; ++i) {
    sums[kAlbedo + i] += bounded_steps(albedo[i]);
    sums[kNormal + i] += bounded_steps(normal[i]);
  }
  return whole;
}

// [display units]
double mean(const Film::Pixel& sums, std::size_t i, double count) { return double(sums[i]) / (count * kValueSteps); }

// Of the mean of `count` samples, two at least [display units^2]. Where the sum of squares is full, all that is known
// is that values are hardly ever negative: then it is at most mean^2.
double variance_of_mean(const Film::Pixel& sums, std::size_t i, double count) {
  const double m = mean(sums, i, count);
  if (sums[kSquares + i] == kFull) return m * m;
  const double mean_square = double(sums[kSquares + i]) / (count * kSquareSteps);
  return std::max((mean_square - m * m) / (count - 1), 0.0);
}

float to_float(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kLargest, kLargest));
}

}  // namespace

Film::Film(std::uint32_t width, std::uint32_t height, float exposure, std::uint64_t first_sample)
    : width_(width),
      height_(height),
      exposure_(exposure),
      range_{first_sample, first_sample},
      pixels_(std::size_t(width) * height) {}

void Film::add(const std::vector<FilmSample>& samples) {
  LUCIOLE_ASSERT_EQ(samples.size(), pixels_.size());
  std::atomic<std::uint64_t> not_whole{0};
  parallel_for(pixels_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::uint64_t here = 0;
    for (std::size_t i = begin; i < end; ++i) here += !add_sample(pixels_[i], samples[i], exposure_);
    not_whole += here;
  });
  saturated_ += not_whole;
  ++range_.end;
}

bool Film::merge(const Film& other) {
  if (width_ != other.width_ || height_ != other.height_ || exposure_ != other.exposure_) return false;
  const bool follows = range_.end == other.range_.first, precedes = other.range_.end == range_.first;
  if (!follows && !precedes) return false;
  parallel_for(pixels_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Pixel& sums = pixels_[i];
      for (std::size_t k = 0; k < kAlbedo; ++k) sums[k] = add_up_to_full(sums[k], other.pixels_[i][k]);
      for (std::size_t k = kAlbedo; k < kSums; ++k) sums[k] += other.pixels_[i][k];
    }
  });
  range_ = follows ? SampleRange{range_.first, other.range_.end} : SampleRange{other.range_.first, range_.end};
  saturated_ += other.saturated_;
  return true;
}

const std::vector<std::string>& Film::layer_names() {
  static const std::vector<std::string> names = {"albedo", "normal", "variance"};
  return names;
}

Image Film::image(const std::vector<std::string>& layers) const {
  Image image;
  image.width = width_, image.height = height_;
  const double count = double(std::max<std::uint64_t>(range_.count(), 1)), exposure = exposure_;
  const auto fill = [&](const std::string& name, auto value_of) {
    std::vector<float>& channel = image.channels[name];
    channel.resize(pixels_.size());
    parallel_for(pixels_.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) channel[i] = to_float(value_of(pixels_[i]));
    });
  };
  constexpr const char* kColours[] = {"R", "G", "B"};
  constexpr const char* kAxes[] = {"X", "Y", "Z"};
  for (std::size_t c = 0; c < 3; ++c) {
    fill(kColours[c], [&](const Pixel& sums) { return mean(sums, c, count) / exposure; });
    for (const std::string& layer : layers) {
      const std::string colour = layer + "." + kColours[c];
      if (layer == "albedo") fill(colour, [&](const Pixel& sums) { return mean(sums, kAlbedo + c, count); });
      if (layer == "normal") {
        fill(layer + "." + kAxes[c], [&](const Pixel& sums) { return mean(sums, kNormal + c, count); });
      }
      if (layer == "variance") {
        const auto variance = [&](const Pixel& sums) {
          return count < 2 ? 0 : variance_of_mean(sums, c, count) / (exposure * exposure);
        };
        fill(colour, variance);
      }
    }
  }
  return image;
}

double Film::relative_error() const {
  if (range_.count() < 2 || pixels_.empty()) return std::numeric_limits<double>::infinity();
  const double count = double(range_.count());
  // Sums of fixed blocks, added in order: the same number on any number of threads.
  const std::size_t blocks = (pixels_.size() + kGrain - 1) / kGrain;
  const auto sum_over_pixels = [&](auto value_of) {
    std::vector<double> sums(blocks);
    parallel_for(blocks, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t block = begin; block < end; ++block) {
        const std::size_t stop = std::min(pixels_.size(), (block + 1) * kGrain);
        for (std::size_t i = block * kGrain; i < stop; ++i) {
          for (std::size_t c = 0; c < 3; ++c) sums[block] += value_of(pixels_[i], c);
        }
      }
    });
    double total = 0;
    for (const double sum : sums) total += sum;
    return total / (3.0 * double(pixels_.size()));
  };
  const double picture_mean = sum_over_pixels([&](const Pixel& sums, std::size_t c) { return mean(sums, c, count); });
  if (picture_mean == 0) return 0;  // all samples of all pixels agree: black
  const double floor = 0.01 * picture_mean * picture_mean;
  return std::sqrt(sum_over_pixels([&](const Pixel& sums, std::size_t c) {
    const double m = mean(sums, c, count);
    return variance_of_mean(sums, c, count) / (m * m + floor);
  }));
}

Film Film::from_sums(std::uint32_t width, std::uint32_t height, float exposure, SampleRange range,
                     std::uint64_t saturated, std::vector<Pixel> pixels) {
  LUCIOLE_ASSERT_EQ(pixels.size(), std::size_t(width) * height);
  Film film(0, 0, exposure, range.first);
  film.width_ = width, film.height_ = height;
  film.range_ = range;
  film.saturated_ = saturated;
  film.pixels_ = std::move(pixels);
  return film;
}

}  // namespace luciole
