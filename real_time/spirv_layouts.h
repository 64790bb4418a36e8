// SPDX-License-Identifier: Apache-2.0
// For tests: where the members of structs lie, as SPIR-V says.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "gpu/shader_code.h"

namespace luciole {

// What SPIR-V tells of structs ("Physical Layout of a SPIR-V Module and Instruction" of its specification).
class Layouts {
 public:
  explicit Layouts(const gpu::ShaderCode& code) {
    const std::size_t words = code.bytes / 4;
    for (std::size_t at = 5; at < words; at += code.words[at] >> 16) read(code.words + at);
  }

  // "struct.member" -> offset in bytes.
  std::map<std::string, std::uint32_t> offsets() const {
    std::map<std::string, std::uint32_t> result;
    for (const auto& [key, offset] : offset_of_) {
      const auto structure = name_of_.find(key.first);
      const auto member = member_name_.find(key);
      if (structure != name_of_.end() && member != member_name_.end()) {
        result[structure->second + "." + member->second] = offset;
      }
    }
    return result;
  }

 private:
  static std::string text(const std::uint32_t* words) { return reinterpret_cast<const char*>(words); }

  void read(const std::uint32_t* instruction) {
    constexpr std::uint32_t kName = 5, kMemberName = 6, kMemberDecorate = 72, kOffset = 35;
    const std::uint32_t* const operands = instruction + 1;
    switch (instruction[0] & 0xffffu) {
      case kName:
        name_of_[operands[0]] = text(operands + 1);
        break;
      case kMemberName:
        member_name_[{operands[0], operands[1]}] = text(operands + 2);
        break;
      case kMemberDecorate:
        if (operands[2] == kOffset) offset_of_[{operands[0], operands[1]}] = operands[3];
        break;
      default:
        break;
    }
  }

  using Member = std::pair<std::uint32_t, std::uint32_t>;  // id of the struct, place in it
  std::map<std::uint32_t, std::string> name_of_;
  std::map<Member, std::string> member_name_;
  std::map<Member, std::uint32_t> offset_of_;
};

}  // namespace luciole
