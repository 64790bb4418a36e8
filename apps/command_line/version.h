// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace luciole {

extern const char* const kVersion;  // "0.1.0"
extern const char* const kCommit;   // abbreviated, "+" if files were changed; "" outside a git checkout

// For --version: version, commit, and the instruction sets of this processor with the one in use marked.
std::string version_text();

}  // namespace luciole
