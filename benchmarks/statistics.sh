# SPDX-License-Identifier: Apache-2.0
# Shell functions over the statistics that `luciole render` writes. Sourced.

# Value of KEY in a statistics file: "passes_ms/culling" is the line "culling" below the first "passes_ms", which of
# several frames is their median.
value() {
  awk -v path="$2" '
    BEGIN { depth = split(path, name, "/"); at = 1 }
    { line = $0; sub(/^ */, "", line)
      if (index(line, "\"" name[at] "\":") == 1) {
        if (at < depth) { at++; next }
        sub(/^[^:]*: */, "", line); sub(/,$/, "", line); print line; exit } }' "$1"
}

# The names of the passes of a statistics file.
passes() {
  awk '/"passes_ms"/ { inside = 1; next } inside && /}/ { exit } inside { split($0, part, "\""); print part[2] }' "$1"
}
