#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Renders every scene and every valid sample below $LUCIOLE_SCENES small, by the file's own camera or one that frames it,
# and puts the pictures together: docs/contact_sheet_1.png, ... Findings: docs/contact_sheet.md.
#   docs/contact_sheet.sh [PROGRAM] [BUILD_FOLDER]     default: build/luciole and build
set -euo pipefail
cd "$(dirname "$0")/.."
program=${1:-build/luciole}
build=${2:-build}
scenes=${LUCIOLE_SCENES:-scenes}
[[ -d $scenes ]] || { echo "contact_sheet.sh: no folder '$scenes'; set LUCIOLE_SCENES" >&2; exit 1; }
cmake --build "$build" --target contact_sheet > /dev/null

pictures=$(mktemp -d)
trap 'rm -rf "$pictures"' EXIT
list=$pictures/list

# take NAME WHAT: one picture of WHAT, or the sentence that says why there is none.
take() {
  local name=$1 what=$2 picture said
  picture=$pictures/$(tr -c 'A-Za-z0-9\n' _ <<< "$name").exr
  if said=$("$program" render "$what" --scenes "$scenes" -o "$picture" --size 240x160 --vpls 16384 --interleave 4 \
    --accumulate 4 --jitter --quiet 2>&1); then
    printf '%s\t%s\n' "$name" "$picture" >> "$list"
  else
    printf '%s\t%s\n' "$name" "$(sed "s|$scenes/||; s|^luciole: ||" <<< "$said" | tr '\n\t' '  ')" >> "$list"
  fi
}

for shot in shots/*.toml; do take "shot $(basename "$shot" .toml)" "$shot"; done
for recipe in cornell ring gallery lights lamps; do take "recipe $recipe" "recipe:$recipe"; done
while read -r file; do take "$file" "$scenes/$file"; done < <(
  cd "$scenes"
  find . \( -name '*.gltf' -o -name '*.glb' -o -name '*.obj' \) -not -path './malformed/*' -printf '%P\n' |
    LC_ALL=C sort
)
"$build/docs/tools/contact_sheet" "$list" docs/contact_sheet
