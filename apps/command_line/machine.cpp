// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/machine.h"

#include <unistd.h>

#include <fstream>

namespace luciole {

std::string processor_name() {
  std::ifstream listing("/proc/cpuinfo");
  for (std::string line; std::getline(listing, line);) {
    if (line.rfind("model name", 0) != 0) continue;
    const std::size_t colon = line.find(": ");
    if (colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::uint64_t physical_memory_bytes() {
  const long pages = sysconf(_SC_PHYS_PAGES), page_bytes = sysconf(_SC_PAGE_SIZE);
  return pages > 0 && page_bytes > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_bytes) : 0;
}

}  // namespace luciole
