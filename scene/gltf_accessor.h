// SPDX-License-Identifier: Apache-2.0
// Accessors: typed, strided, normalised, sparse views of bytes (glTF 2.0, 3.6.2), checked before a byte is read.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scene/gltf_document.h"

namespace luciole::gltf {

// GL constants, as the format stores them.
enum class ComponentType : std::uint32_t {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  float32 = 5126,
};

struct AccessorShape {
  std::string label;
  ComponentType component_type = ComponentType::float32;
  std::uint32_t components = 1;  // 1 SCALAR .. 4 VEC4; 16 MAT4
  bool normalised = false;
  std::uint64_t count = 0;
};

// What the JSON says. MAT2 and MAT3, whose columns are padded and which nothing here uses, are refused.
AccessorShape accessor_shape(const Document& document, std::size_t accessor);

// Whether all that the accessor refers to is there, sparse indices included.
void check_accessor_bytes(Document& document, std::size_t accessor);

// count * components values. Integers become floats as the format says (normalised or not); every value is finite.
std::vector<float> read_floats(Document& document, std::size_t accessor);

// SCALAR, unsigned, not normalised: indices.
std::vector<std::uint32_t> read_indices(Document& document, std::size_t accessor);

}  // namespace luciole::gltf
