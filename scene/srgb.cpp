// SPDX-License-Identifier: Apache-2.0
#include "scene/srgb.h"

#include <algorithm>
#include <cmath>

namespace luciole {
namespace {

std::array<float, 256> decoding_table(bool srgb) {
  std::array<float, 256> table;
  for (int i = 0; i < 256; ++i) {
    const float encoded = static_cast<float>(i) / 255.0f;
    table[static_cast<std::size_t>(i)] = srgb ? linear_from_srgb(encoded) : encoded;
  }
  return table;
}

constexpr int kBuckets = 4096;

// For each bucket of linear values the code of its lower end, and for each code the linear value where it gives way to
// the next one: encoding is a look-up and, in the dark end, a few steps; no power function per texel.
struct EncodingTables {
  std::array<std::uint8_t, kBuckets + 1> code_at_bucket;
  std::array<float, 256> upper_limit;
};

EncodingTables encoding_tables() {
  EncodingTables tables;
  for (int code = 0; code < 255; ++code) {
    tables.upper_limit[static_cast<std::size_t>(code)] = linear_from_srgb((static_cast<float>(code) + 0.5f) / 255.0f);
  }
  tables.upper_limit[255] = 2.0f;
  std::uint8_t code = 0;
  for (int bucket = 0; bucket <= kBuckets; ++bucket) {
    while (static_cast<float>(bucket) / kBuckets >= tables.upper_limit[code]) ++code;
    tables.code_at_bucket[static_cast<std::size_t>(bucket)] = code;
  }
  return tables;
}

}  // namespace

float linear_from_srgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

const std::array<float, 256> kLinearFromSrgb8 = decoding_table(true);
const std::array<float, 256> kLinearFrom8 = decoding_table(false);

std::uint8_t srgb8_from_linear(float linear) {
  static const EncodingTables tables = encoding_tables();
  const float value = std::clamp(linear, 0.0f, 1.0f);
  std::uint8_t code = tables.code_at_bucket[static_cast<std::size_t>(value * kBuckets)];
  while (value >= tables.upper_limit[code]) ++code;
  return code;
}

}  // namespace luciole
