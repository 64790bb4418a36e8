// SPDX-License-Identifier: Apache-2.0
// GLB, by chunks: the mutator changes the JSON or the binary chunk and writes a container with right lengths around
// them nine times in ten, so that mutations reach the readers behind the container.
#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

#include "tests/fuzz/fuzz_limits.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using Bytes = std::vector<std::uint8_t>;

std::uint32_t word_at(const std::uint8_t* data, std::size_t offset) {
  std::uint32_t word;
  std::memcpy(&word, data + offset, 4);
  return word;
}

void append_word(Bytes& bytes, std::uint32_t word) {
  const auto* begin = reinterpret_cast<const std::uint8_t*>(&word);
  bytes.insert(bytes.end(), begin, begin + 4);
}

struct Chunks {
  Bytes json, binary;
};

// The chunks of a container as far as they go; anything else is taken for JSON.
Chunks split(const std::uint8_t* data, std::size_t size) {
  if (size < 20 || word_at(data, 0) != 0x46546c67) return {Bytes(data, data + size), {}};
  Chunks chunks;
  const std::size_t json_size = std::min<std::size_t>(word_at(data, 12), size - 20);
  chunks.json.assign(data + 20, data + 20 + json_size);
  const std::size_t next = 20 + json_size;
  if (size - next > 8) chunks.binary.assign(data + next + 8, data + size);
  return chunks;
}

Bytes joined(Chunks chunks) {
  while (chunks.json.size() % 4 != 0) chunks.json.push_back(' ');
  while (chunks.binary.size() % 4 != 0) chunks.binary.push_back(0);
  Bytes file;
  append_word(file, 0x46546c67);
  append_word(file, 2);
  append_word(file, static_cast<std::uint32_t>(28 + chunks.json.size() + chunks.binary.size()));
  append_word(file, static_cast<std::uint32_t>(chunks.json.size()));
  append_word(file, 0x4e4f534a);
  file.insert(file.end(), chunks.json.begin(), chunks.json.end());
  append_word(file, static_cast<std::uint32_t>(chunks.binary.size()));
  append_word(file, 0x004e4942);
  file.insert(file.end(), chunks.binary.begin(), chunks.binary.end());
  return file;
}

void mutate(Bytes& bytes, std::size_t room) {
  const std::size_t size = bytes.size();
  if (size + room == 0) return;  // the library's mutations write to at least one byte
  bytes.resize(size + room);
  bytes.resize(LLVMFuzzerMutate(bytes.data(), size, size + room));
}

#if defined(LUCIOLE_PLANT_OUT_OF_BOUNDS_READ)
// The mistake that a hand-written GLB reader makes: the chunk's length is believed.
volatile std::uint8_t sink;
void read_like_a_careless_reader(const std::uint8_t* data, std::size_t size) {
  if (size < 28 || word_at(data, 0) != 0x46546c67 || word_at(data, 16) != 0x4e4f534a) return;
  const std::size_t length = word_at(data, 12);
  if (length > size) return;  // should be size - 20
  const Bytes copy(data, data + size);
  if (length > 0) sink = copy.data()[20 + length - 1];
}
#endif

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  std::minstd_rand random(seed);
  if (random() % 10 == 0) return LLVMFuzzerMutate(data, size, max_size);
  Chunks chunks = split(data, size);
  const std::size_t used = chunks.json.size() + chunks.binary.size() + 36;
  const std::size_t room = used < max_size ? std::min<std::size_t>(max_size - used, 256) : 0;
  mutate(random() % 3 == 0 ? chunks.binary : chunks.json, room);
  const Bytes file = joined(std::move(chunks));
  if (file.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(file.begin(), file.end(), data);
  return file.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
#if defined(LUCIOLE_PLANT_OUT_OF_BOUNDS_READ)
  read_like_a_careless_reader(data, size);
#endif
  luciole::fuzz::use(luciole::load_gltf({data, size}, "fuzz.glb", luciole::no_files(), luciole::fuzz::limits()));
  return 0;
}
