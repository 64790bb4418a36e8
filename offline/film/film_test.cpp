// SPDX-License-Identifier: Apache-2.0
#include "offline/film/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/parallel.h"

namespace luciole {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

using Pass = std::vector<FilmSample>;

// Heavy tails: values over twelve orders of magnitude, whose float sum depends on the order.
std::vector<Pass> random_passes(std::size_t pixels, std::size_t count, float exposure = 1) {
  std::mt19937 random(7);
  std::lognormal_distribution<float> radiance(0, 4);
  std::uniform_real_distribution<float> direction(-1, 1);
  std::vector<Pass> passes(count, Pass(pixels));
  for (Pass& pass : passes) {
    for (FilmSample& sample : pass) {
      sample.radiance = Vec3(radiance(random), radiance(random), radiance(random)) * (1 / exposure);
      sample.albedo = Vec3(0.1f, 0.7f, std::abs(direction(random)));
      sample.normal = Vec3(direction(random), direction(random), -0.5f);
    }
  }
  return passes;
}

Film film_of(const std::vector<Pass>& passes, std::size_t first, std::size_t end, std::uint32_t width,
             float exposure = 1) {
  Film film(width, static_cast<std::uint32_t>(passes.front().size()) / width, exposure, first);
  for (std::size_t i = first; i < end; ++i) film.add(passes[i]);
  return film;
}

Film constant_film(std::uint32_t width, std::uint32_t height, float exposure, Vec3 radiance, int samples) {
  Film film(width, height, exposure);
  const Pass pass(std::size_t(width) * height, FilmSample{radiance, Vec3(0, 0, 0), Vec3(0, 0, 0)});
  for (int i = 0; i < samples; ++i) film.add(pass);
  return film;
}

void expect_same(const Film& a, const Film& b) {
  EXPECT_EQ(a.pixels(), b.pixels());
  EXPECT_EQ(a.range(), b.range());
  EXPECT_EQ(a.saturated(), b.saturated());
}

TEST(Film, any_split_merged_in_any_order_gives_the_same_bits) {
  const std::vector<Pass> passes = random_passes(17 * 3, 60);
  const Film whole = film_of(passes, 0, passes.size(), 17);
  std::mt19937 random(1);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Film> parts;
    for (std::size_t first = 0; first < passes.size();) {
      const std::size_t end = std::min<std::size_t>(passes.size(), first + 1 + random() % 20);
      parts.push_back(film_of(passes, first, end, 17));
      first = end;
    }
    while (parts.size() > 1) {  // two neighbours at random become one, either into the other
      const std::size_t left = random() % (parts.size() - 1), right = left + 1;
      if (random() % 2) {
        ASSERT_TRUE(parts[left].merge(parts[right]));
      } else {
        ASSERT_TRUE(parts[right].merge(parts[left]));
        parts[left] = parts[right];
      }
      parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(right));
    }
    expect_same(parts.front(), whole);
  }
}

TEST(Film, the_split_is_hard_sums_of_floats_would_differ) {
  const std::vector<Pass> passes = random_passes(64, 60);
  int differing = 0;
  for (std::size_t pixel = 0; pixel < 64; ++pixel) {
    float whole = 0, first = 0, second = 0;
    for (std::size_t i = 0; i < passes.size(); ++i) {
      const float value = passes[i][pixel].radiance.x;
      whole += value;
      (i < 25 ? first : second) += value;
    }
    differing += whole != first + second;
  }
  EXPECT_GT(differing, 16);
}

TEST(Film, one_and_many_threads_give_the_same_bits) {
  const std::vector<Pass> passes = random_passes(301 * 67, 3);
  std::vector<Film> films;
  std::vector<double> errors;
  for (const int threads : {1, 2, 3}) {
    with_threads(threads, [&] {
      films.push_back(film_of(passes, 0, 3, 301));
      errors.push_back(films.back().relative_error());
    });
  }
  for (std::size_t i = 1; i < films.size(); ++i) {
    expect_same(films[i], films[0]);
    EXPECT_EQ(errors[i], errors[0]);
  }
}

TEST(Film, merging_refuses_gaps_overlaps_and_other_pictures) {
  const std::vector<Pass> passes = random_passes(12, 10);
  const Film film = film_of(passes, 2, 6, 4);
  const auto refused = [&](const Film& other) {
    Film kept = film;
    const bool merged = kept.merge(other);
    EXPECT_EQ(kept.pixels(), film.pixels());
    EXPECT_EQ(kept.range(), film.range());
    return !merged;
  };
  EXPECT_TRUE(refused(film_of(passes, 7, 9, 4)));     // gap behind
  EXPECT_TRUE(refused(film_of(passes, 0, 1, 4)));     // gap before
  EXPECT_TRUE(refused(film_of(passes, 5, 8, 4)));     // overlap behind
  EXPECT_TRUE(refused(film_of(passes, 0, 3, 4)));     // overlap before
  EXPECT_TRUE(refused(film));                         // itself
  EXPECT_TRUE(refused(film_of(passes, 6, 8, 3)));     // other size, as many pixels
  EXPECT_TRUE(refused(film_of(passes, 6, 8, 4, 2)));  // other exposure
  Film good = film;
  EXPECT_TRUE(good.merge(film_of(passes, 6, 8, 4)));  // the control
  EXPECT_EQ(good.range(), (SampleRange{2, 8}));
}

TEST(Film, samples_that_do_not_fit_are_counted_and_do_little_harm) {
  const float bad[] = {kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN(), -2e9f, 2e9f};
  const float kept[] = {0, 0, 0, -0x1p30f, 0x1p30f};
  for (int i = 0; i < 5; ++i) {
    Film film(2, 1, 1);
    film.add({{Vec3(1, bad[i], 1), Vec3(0, 0, 0), Vec3(0, 0, 0)}, {Vec3(3, 3, 3), Vec3(0, 0, 0), Vec3(0, 0, 0)}});
    EXPECT_EQ(film.saturated(), 1u);
    const Image image = film.image();
    EXPECT_EQ(image.channels.at("G")[0], kept[i]);
    EXPECT_EQ(image.channels.at("R")[0], std::isfinite(bad[i]) ? 1.0f : 0.0f);  // a wrong colour goes whole
    EXPECT_EQ(image.channels.at("G")[1], 3.0f);
  }
  EXPECT_EQ(constant_film(2, 1, 1, Vec3(0x1p30f, 0, 1), 1).saturated(), 0u);  // the largest that fits
}

TEST(Film, negative_samples_count_as_they_are) {
  Film film = constant_film(1, 1, 1, Vec3(-3, -3, -1), 1);
  film.add({{Vec3(5, 3, -1), Vec3(0, 0, 0), Vec3(0, 0, 0)}});
  EXPECT_EQ(film.saturated(), 0u);
  const Image image = film.image({"variance"});
  EXPECT_EQ(image.channels.at("R")[0], 1.0f);
  EXPECT_EQ(image.channels.at("G")[0], 0.0f);
  EXPECT_EQ(image.channels.at("B")[0], -1.0f);
  EXPECT_EQ(image.channels.at("variance.R")[0], 16.0f);  // (4^2 + 4^2) / 2 / (2 - 1)
  EXPECT_EQ(image.channels.at("variance.G")[0], 9.0f);
}

TEST(Film, features_that_are_no_numbers_are_dropped) {
  Film film(1, 1, 1);
  film.add({{Vec3(1, 1, 1), Vec3(kInfinity, 0.5f, 1e30f), Vec3(0, -kInfinity, -1)}});
  const Image image = film.image({"albedo", "normal"});
  EXPECT_EQ(image.channels.at("albedo.R")[0], 0.0f);
  EXPECT_EQ(image.channels.at("albedo.G")[0], 0.5f);
  EXPECT_EQ(image.channels.at("albedo.B")[0], 16.0f);
  EXPECT_EQ(image.channels.at("normal.Y")[0], 0.0f);
  EXPECT_EQ(image.channels.at("normal.Z")[0], -1.0f);
}

TEST(Film, full_sums_stay_full_in_any_order) {
  Film one = constant_film(1, 1, 1, Vec3(0x1p30f, 1, 0), 40), two(1, 1, 1, 40);
  two.add({{Vec3(5, 5, 5), Vec3(0, 0, 0), Vec3(0, 0, 0)}});
  Film joined = two;
  ASSERT_TRUE(joined.merge(one));
  ASSERT_TRUE(one.merge(two));
  expect_same(one, joined);
  EXPECT_EQ(one.pixels()[0][0], std::numeric_limits<std::int64_t>::max());
  const Image image = one.image({"variance"});
  EXPECT_FLOAT_EQ(image.channels.at("variance.R")[0], std::pow(image.channels.at("R")[0], 2.0f));  // all that is known
}

TEST(Film, the_mean_is_exact_to_rounding) {
  const std::vector<Pass> passes = random_passes(50, 37);
  const Image image = film_of(passes, 0, 37, 50).image({"albedo", "normal"});
  for (std::size_t i = 0; i < 50; ++i) {
    long double radiance = 0, normal = 0;
    for (const Pass& pass : passes) {
      radiance += std::nearbyint((long double)(pass[i].radiance.y) * 0x1p28L);
      normal += std::nearbyint((long double)(pass[i].normal.x) * 0x1p28L);
    }
    EXPECT_FLOAT_EQ(image.channels.at("G")[i], static_cast<float>(radiance / 37 / 0x1p28L));
    EXPECT_FLOAT_EQ(image.channels.at("normal.X")[i], static_cast<float>(normal / 37 / 0x1p28L));
    EXPECT_FLOAT_EQ(image.channels.at("albedo.R")[i], 0.1f);
  }
}

TEST(Film, a_constant_picture_is_exact_for_tiny_and_huge_exposures) {
  for (const float exposure : {1e-30f, 1e-6f, 1.0f, 3e4f, 1e30f}) {
    const Vec3 radiance = Vec3(0.25f, 1.0f, 700.0f) * (1 / exposure);
    const Film film = constant_film(3, 2, exposure, radiance, 7);
    EXPECT_EQ(film.saturated(), 0u);
    const Image image = film.image({"variance"});
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(image.channels.at("R")[i] / radiance.x, 1, 1e-7) << exposure;
      EXPECT_NEAR(image.channels.at("B")[i] / radiance.z, 1, 1e-7) << exposure;
    }
    EXPECT_LT(film.relative_error(), 1e-3) << exposure;
  }
  // Rounding to whole steps, not towards zero: else the mean of dark pixels falls.
  Film dark = constant_film(1, 1, 1, Vec3(0.75f, 0.25f, 0) * 0x1p-28f, 1);
  EXPECT_EQ(dark.pixels()[0][0], 1);
  EXPECT_EQ(dark.pixels()[0][1], 0);
}

// The variance of the mean of n samples from a two-valued distribution: with probability 1/4 the value 4, else 0 has
// variance 3. Over many pixels its estimate is known to a fraction that the fourth moment gives.
TEST(Film, the_variance_is_that_of_the_mean) {
  constexpr std::uint32_t kSide = 256, kSamples = 16;
  std::mt19937 random(3);
  Film film(kSide, kSide, 0.5f);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    Pass pass(kSide * kSide);
    for (FilmSample& sample : pass) sample.radiance = Vec3(1, 1, 1) * (random() % 4 == 0 ? 4.0f : 0.0f);
    film.add(pass);
  }
  const Image image = film.image({"variance"});
  const double pixels = kSide * kSide;
  double variance = 0, square_of_mean_error = 0;
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    variance += image.channels.at("variance.G")[i] / pixels;
    square_of_mean_error += std::pow(image.channels.at("G")[i] - 1.0, 2) / pixels;
  }
  const double expected = 3.0 / kSamples;
  // Central moments 3 and 21: var(s^2) = (21 - 9 (n - 3) / (n - 1)) / n, and one mean of s^2 / n per pixel.
  const double sigma =
      std::sqrt((21 - 9.0 * (kSamples - 3) / (kSamples - 1)) / kSamples) / kSamples / std::sqrt(pixels);
  EXPECT_NEAR(variance, expected, 4 * sigma);
  EXPECT_NEAR(square_of_mean_error, expected, 0.02 * expected);
  // The likely mistakes: divided by n instead of n - 1; the variance of one sample.
  EXPECT_GT(std::abs(variance * (kSamples - 1) / kSamples - expected), 8 * sigma);
  EXPECT_GT(std::abs(variance * kSamples - expected), 8 * sigma);
}

TEST(Film, the_relative_error_predicts_the_true_one_and_falls_as_one_over_the_root_of_samples) {
  constexpr std::uint32_t kSide = 64;
  std::mt19937 random(5);
  std::exponential_distribution<float> radiance(1);
  Film film(kSide, kSide, 1);
  EXPECT_EQ(film.relative_error(), std::numeric_limits<double>::infinity());
  double errors[2] = {};
  for (int i = 1; i <= 256; ++i) {
    Pass pass(kSide * kSide);
    for (FilmSample& sample : pass) sample.radiance = Vec3(radiance(random), radiance(random), radiance(random));
    film.add(pass);
    if (i == 1) {
      EXPECT_EQ(film.relative_error(), std::numeric_limits<double>::infinity());
    }
    if (i == 64) errors[0] = film.relative_error();
    if (i == 256) errors[1] = film.relative_error();
  }
  EXPECT_NEAR(errors[0], 1 / std::sqrt(1.01) / 8, 0.01);
  EXPECT_NEAR(errors[0] / errors[1], 2, 0.1);
  EXPECT_EQ(constant_film(4, 4, 1, Vec3(0, 0, 0), 2).relative_error(), 0);
}

TEST(Film, memory_is_96_bytes_per_pixel) { EXPECT_EQ(sizeof(Film::Pixel), 96u); }

}  // namespace
}  // namespace luciole
