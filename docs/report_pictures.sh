#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Remakes docs/pictures/report.jpg and report_phone.jpg: two ways to choose a lamp, 8 samples each, held against 128; and,
# where ./do reproduce th17-fig10 has made its page, reproduction.jpg of that.
# Needs what ./do test installs; takes a few minutes.
#   docs/report_pictures.sh [PROGRAM]     default: build/luciole
set -euo pipefail
cd "$(dirname "$0")/.."
program=$(realpath "${1:-build/luciole}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

render() {
  local name=$1
  shift
  "$program" render lamps --method path --size 400x225 --bounces 2 "$@" -o "$work/$name.exr"
}
render culling --samples 8
render uniform --samples 8 --lights uniform
render truth --samples 128 --seed 2
(cd "$work" && "$program" report --compare culling.exr uniform.exr --reference truth.exr -o page)
for picture in "1200x700 report" "360x740 report_phone"; do
  read -r size name <<< "$picture"
  node report/browser/screenshot.mjs "$(command -v chromium)" "$work/page" "$size" "docs/pictures/$name.jpg"
done
if [[ -d out/report/th17-fig10 ]]; then
  node report/browser/screenshot.mjs "$(command -v chromium)" out/report/th17-fig10 1200x900 docs/pictures/reproduction.jpg "Lights per pixel"
fi
