// SPDX-License-Identifier: Apache-2.0
// glTF as text; external files cannot be had.
#include "tests/fuzz/fuzz_limits.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  luciole::fuzz::use(luciole::load_gltf({data, size}, "fuzz.gltf", luciole::no_files(), luciole::fuzz::limits()));
  return 0;
}
