// SPDX-License-Identifier: Apache-2.0
// A fault of a scene file. The readers throw it where they see it; load_scene.cpp, the door, catches it and names the
// file. It never leaves this room.
#pragma once
#include <stdexcept>
#include <string>

namespace luciole {

// what() reads "<object>: <sentence> (<CODE>)". The codes are those of the Khronos glTF validator where it has one.
class FileFault : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

//   code      for example "ACCESSOR_INDEX_OOB"
//   object    for example "accessor 3"; empty if the whole file is meant
//   sentence  what is wrong, without a full stop
[[noreturn]] void fail(const std::string& code, const std::string& object, const std::string& sentence);

// Text from a file, as it may be shown on a terminal: printable ASCII and UTF-8, shortened.
std::string printable(const std::string& text);

}  // namespace luciole
