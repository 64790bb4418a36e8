// SPDX-License-Identifier: Apache-2.0
// OBJ and MTL: every file that the scene names is the input once more, so that one input exercises both grammars.
#include "tests/fuzz/fuzz_limits.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const luciole::FileReader itself = [=](const std::string&) {
    return luciole::Result<luciole::Bytes>({data, data + size});
  };
  luciole::fuzz::use(luciole::load_obj({data, size}, "fuzz.obj", itself, luciole::fuzz::limits()));
  return 0;
}
