// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <set>
#include <vector>

#include "equations/test_support.h"

namespace luciole::test {

TEST(TinyEncryption, thirty_two_rounds_are_the_published_cipher) {
  f32::RandomWords zero{0, 0};
  const f32::RandomWords cipher = f32::tiny_encryption(zero, {0, 0, 0, 0}, 32);
  EXPECT_EQ(cipher.first, 0x41ea3a0au);  // the test vector of the reference implementation
  EXPECT_EQ(cipher.second, 0x94baa940u);
  EXPECT_NE(f32::tiny_encryption(zero, {0, 0, 0, 0}, 31).first, 0x41ea3a0au);
}

TEST(RandomWords, depend_on_every_part_of_their_key) {
  const auto words = [](std::uint32_t seed, std::uint32_t frame, std::uint32_t index, std::uint32_t dimension) {
    return f32::random_words(seed, frame, index, dimension).first;
  };
  const std::set<std::uint32_t> all = {words(0, 0, 0, 0), words(1, 0, 0, 0), words(0, 1, 0, 0), words(0, 0, 1, 0),
                                       words(0, 0, 0, 1)};
  EXPECT_EQ(all.size(), 5u);
}

TEST(RandomWords, are_fixed_for_good) {  // shaders are compared with these
  const f32::RandomWords words = f32::random_words(1, 2, 3, 4);
  EXPECT_EQ(words.first, 0xcf5ccf25u);
  EXPECT_EQ(words.second, 0x255dd4a1u);
}

// Chi-square of 256 bins over neighbouring indices: 255 degrees of freedom, standard deviation sqrt(510).
double chi_square_z(const std::vector<double>& xi) {
  std::vector<double> bins(256, 0.0);
  for (double x : xi) bins[static_cast<std::size_t>(x * 256)] += 1;
  const double expected = static_cast<double>(xi.size()) / 256;
  double chi = 0;
  for (double b : bins) chi += (b - expected) * (b - expected) / expected;
  return (chi - 255) / std::sqrt(510.0);
}

TEST(UnitReal, is_uniform_over_lights_and_over_frames) {
  std::vector<double> over_lights, over_frames, counted;
  for (std::uint32_t i = 0; i < 100000; ++i) {
    over_lights.push_back(f64::unit_real(f64::random_words(7, 3, i, 0).first));
    over_frames.push_back(f64::unit_real(f64::random_words(7, i, 3, 0).second));
    counted.push_back(f64::unit_real(i * 40000));  // stops short of 2^32
  }
  EXPECT_LT(std::abs(chi_square_z(over_lights)), kSigmas);
  EXPECT_LT(std::abs(chi_square_z(over_frames)), kSigmas);
  EXPECT_GT(std::abs(chi_square_z(counted)), kSigmas);
}

TEST(UnitReal, has_the_same_bits_in_every_language) {
  const auto bits_of = [](std::uint32_t u) {
    const float x = f32::unit_real(u);
    std::uint32_t bits;
    std::memcpy(&bits, &x, sizeof(bits));
    return bits;
  };
  EXPECT_EQ(bits_of(0u), 0x2f000000u);           // 2^-33
  EXPECT_EQ(bits_of(1u), 0x2fc00000u);           // 1.5 * 2^-32
  EXPECT_EQ(bits_of(0x80000000u), 0x3f000000u);  // 1/2 + 2^-33 rounds to 1/2
  EXPECT_EQ(bits_of(0x12345678u), 0x3d91a2b4u);
  EXPECT_EQ(bits_of(0xffffffffu), 0x3f7fffffu);  // never 1
}

TEST(UnitReal, never_reaches_zero_or_one_and_never_falls) {
  float before = 0;
  for (std::uint32_t u : {0u, 1u, 255u, 256u, 0x00ffffffu, 0x7fffffffu, 0xfffffeffu, 0xffffff80u, 0xffffffffu}) {
    const float xi = f32::unit_real(u);
    EXPECT_GT(xi, 0.0f);
    EXPECT_LT(xi, 1.0f);
    EXPECT_GE(xi, before);
    before = xi;
  }
  EXPECT_EQ(static_cast<float>(0x00ffffff00000000 + 0x80000000ull) * 0x1p-56f, 1.0f) << "without the limit it is 1";
}

TEST(ComplementBits, gives_one_minus_xi) {
  for (std::uint32_t u : {0u, 77u, 0x12345678u, 0xf0000000u}) {
    EXPECT_NEAR(f64::unit_real(f64::complement_bits(u)), 1 - f64::unit_real(u), 0x1p-23);
  }
  EXPECT_GT(std::abs(f64::unit_real(~77u + 0x100000u) - (1 - f64::unit_real(77u))), 0x1p-23);
}

TEST(StratifiedBits, put_one_number_in_each_stratum_of_any_run) {
  for (std::uint32_t first : {0u, 64u, 4096u - 32u}) {
    std::set<std::uint32_t> strata, random_strata;
    for (std::uint32_t i = 0; i < 32; ++i) {
      strata.insert((f32::stratified_bits(first + i, 0) >> 27) & 31);
      random_strata.insert(f32::random_words(0, 0, first + i, 0).first >> 27);
    }
    EXPECT_EQ(strata.size(), 32u);
    EXPECT_LT(random_strata.size(), 32u);  // what independent numbers do
  }
}

TEST(StratifiedBits, keep_each_lights_number_uniform_over_frames) {
  std::vector<double> shifted, unshifted;
  for (std::uint32_t frame = 0; frame < 100000; ++frame) {
    shifted.push_back(f64::unit_real(f64::stratified_bits(12345, f64::random_words(1, frame, 0, 0).first)));
    unshifted.push_back(f64::unit_real(f64::stratified_bits(12345, 0)));
  }
  EXPECT_LT(std::abs(chi_square_z(shifted)), kSigmas);
  EXPECT_GT(std::abs(chi_square_z(unshifted)), kSigmas);
}

// Standard deviation over frames of the number of lights with xi < p.
double deviation_of_survivors(bool stratified) {
  const std::uint32_t lights = 65536;
  const int frames = 64;
  double sum = 0, sum_sq = 0;
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    const std::uint32_t shift = f32::random_words(5, frame, 0, 0).first;
    double count = 0;
    for (std::uint32_t i = 0; i < lights; ++i) {
      const std::uint32_t bits = stratified ? f32::stratified_bits(i, shift) : f32::random_words(5, frame, i, 1).first;
      count += f32::unit_real(bits) < 0.01f ? 1 : 0;
    }
    sum += count, sum_sq += count * count;
  }
  return std::sqrt(sum_sq / frames - sum / frames * sum / frames);
}

TEST(StratifiedBits, steady_the_number_of_survivors) {
  EXPECT_LT(deviation_of_survivors(true), 1.0);
  EXPECT_NEAR(deviation_of_survivors(false), std::sqrt(65536 * 0.01 * 0.99), 8.0);
}

TEST(MortonCode, interleaves_the_bits_of_three_coordinates) {
  EXPECT_EQ(f32::morton_code(1, 0, 0), 1u);
  EXPECT_EQ(f32::morton_code(0, 1, 0), 2u);
  EXPECT_EQ(f32::morton_code(0, 0, 1), 4u);
  EXPECT_EQ(f32::morton_code(1023, 1023, 1023), 0x3fffffffu);
  EXPECT_EQ(f32::morton_code(2, 0, 0), 8u);
  EXPECT_EQ(f32::reverse_bits(0x00000001u), 0x80000000u);
  EXPECT_EQ(f32::reverse_bits(0x12345678u), 0x1e6a2c48u);
}

}  // namespace luciole::test
