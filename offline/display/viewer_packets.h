// SPDX-License-Identifier: Apache-2.0
// What the image viewer tev understands: packets of a length (4 bytes, itself included), a kind (1 byte) and fields,
// all little-endian; text ends in a zero byte.
#pragma once
#include <cstdint>
#include <string>

#include "image/image.h"

namespace luciole {

// An image of that name, black, with channels R, G, B: replaces one of the same name.
std::string create_image_packet(const std::string& name, std::uint32_t width, std::uint32_t height);

// Rows first_row ... first_row + rows - 1 of it, from the channels R, G, B.
std::string update_image_packet(const std::string& name, const Image& picture, std::uint32_t first_row,
                                std::uint32_t rows);

}  // namespace luciole
