// SPDX-License-Identifier: Apache-2.0
#include "scene/glb_container.h"

#include <cstring>
#include <string>

#include "scene/file_fault.h"

namespace luciole {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67;        // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;    // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004e4942;  // "BIN"
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

// Little-endian, as the format says and as every processor that this is built for stores it.
std::uint32_t word_at(std::span<const std::uint8_t> bytes, std::size_t offset) {
  std::uint32_t word;
  std::memcpy(&word, bytes.data() + offset, sizeof word);
  return word;
}

void check_header(std::span<const std::uint8_t> file) {
  if (file.size() < kHeaderBytes) fail("GLB_UNEXPECTED_END_OF_HEADER", "", "the file ends inside the GLB header");
  if (!is_glb(file)) fail("GLB_INVALID_MAGIC", "", "does not start with \"glTF\"");
  const std::uint32_t version = word_at(file, 4), length = word_at(file, 8);
  if (version != 2) fail("GLB_INVALID_VERSION", "", "has GLB version " + std::to_string(version) + ", not 2");
  if (length < kHeaderBytes + kChunkHeaderBytes) {
    fail("GLB_LENGTH_TOO_SMALL", "", "says that it is " + std::to_string(length) + " bytes long, too few for a GLB");
  }
  if (length > file.size()) {
    fail("GLB_LENGTH_MISMATCH", "",
         "says that it is " + std::to_string(length) + " bytes long but has " + std::to_string(file.size()));
  }
}

}  // namespace

bool is_glb(std::span<const std::uint8_t> file) { return file.size() >= 4 && word_at(file, 0) == kMagic; }

GlbChunks split_glb(std::span<const std::uint8_t> file) {
  check_header(file);
  file = file.first(word_at(file, 8));  // what follows is not ours
  GlbChunks chunks;
  std::size_t index = 0;
  for (std::size_t offset = kHeaderBytes; offset < file.size(); ++index) {
    const std::string object = "chunk " + std::to_string(index);
    if (file.size() - offset < kChunkHeaderBytes) {
      fail("GLB_UNEXPECTED_END_OF_CHUNK_HEADER", object, "the file ends inside its header");
    }
    const std::size_t length = word_at(file, offset);
    const std::uint32_t kind = word_at(file, offset + 4);
    offset += kChunkHeaderBytes;
    if (length > file.size() - offset) fail("GLB_CHUNK_TOO_BIG", object, "reaches past the end of the file");
    if (length % 4 != 0) fail("GLB_CHUNK_LENGTH_UNALIGNED", object, "its length is not a multiple of 4");
    if (index == 0 && kind != kJsonChunk) fail("GLB_UNEXPECTED_FIRST_CHUNK", object, "is not the JSON chunk");
    if (kind == kJsonChunk) {
      if (index != 0) fail("GLB_DUPLICATE_CHUNK", object, "is a second JSON chunk");
      chunks.json = {reinterpret_cast<const char*>(file.data()) + offset, length};
    } else if (kind == kBinaryChunk) {
      if (chunks.binary) fail("GLB_DUPLICATE_CHUNK", object, "is a second binary chunk");
      if (index != 1) fail("GLB_UNEXPECTED_BIN_CHUNK", object, "is a binary chunk that does not follow the JSON chunk");
      chunks.binary = file.subspan(offset, length);
    }
    offset += length;
  }
  return chunks;
}

}  // namespace luciole
