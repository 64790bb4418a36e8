// SPDX-License-Identifier: Apache-2.0
#include "apps/command_line/version.h"

#include "real_time/settings.h"

namespace luciole {

std::string version_text() {
  std::string text = std::string("luciole ") + kVersion;
  if (*kCommit != '\0') text += std::string(" (commit ") + kCommit + ")";
  text += "\ninstruction sets:";
  const Result<Isa> best = choose_isa(Isa::automatic);
  for (const Isa isa : {Isa::avx512, Isa::avx2, Isa::baseline}) {
    if (!choose_isa(isa)) continue;
    text += " " + to_string(isa) + (best && *best == isa ? " (in use)" : "");
  }
  return text;
}

}  // namespace luciole
