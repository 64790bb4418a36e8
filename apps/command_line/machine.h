// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>

namespace luciole {

// The processor's own name, for figures that depend on it; "unknown" where the system does not tell.
std::string processor_name();

// Memory of this machine [bytes].
std::uint64_t physical_memory_bytes();

}  // namespace luciole
