#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Times tiled culling and its rivals on the Vulkan engine, in turns, and prints a table in Markdown.
#   benchmarks/device_rivals.sh [--device NAME] [--size 480x270] [--vpls 4096] [--interleave 8,1] [--rounds 7] [SHOT ...]
# Builds into $BUILD (default: build). Shots: gallery and cornell. Fails where pictures differ from that of tiled culling.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${BUILD:-build} device='' size=480x270 vpls=4096 interleave=8,1 rounds=7 shots=()

while (($#)); do
  case $1 in
    --device | --size | --vpls | --interleave | --rounds)
      (($# > 1)) || { sed -n '4s/^# *//p' "$0" >&2; exit 2; }
      declare "${1#--}=$2"
      shift 2
      ;;
    -*) sed -n '4s/^# *//p' "$0" >&2 && exit 2 ;;
    *) shots+=("$1") && shift ;;
  esac
done
((${#shots[@]})) || shots=(gallery cornell)

# shellcheck source=benchmarks/statistics.sh
source benchmarks/statistics.sh
[[ -f $build/build.ninja ]] || cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DLUCIOLE_TESTS=OFF
cmake --build "$build" --target luciole > /dev/null
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
ways=(tiled clustered splatting none)
engine=(--engine vulkan)
[[ -n $device ]] && engine+=(--device "$device")

median() { sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

# run SHOT N WAY ROUND: statistics of three frames, whose times are medians, and their mean picture.
run() {
  "$build/luciole" render "$1" --size "$size" --vpls "$vpls" --interleave "$2" --culling "$3" "${engine[@]}" \
    --filter none --accumulate 3 --quiet -o "$work/$3.exr" --statistics "$work/$3.$4.json" > /dev/null
}

row() {
  local shot=$1 n=$2 way=$3 round file=$work/$3.1.json ms tiled
  for ((round = 1; round <= rounds; ++round)); do
    ms=$(value "$work/$way.$round.json" passes_ms/culling_and_shading)
    tiled=$(value "$work/tiled.$round.json" passes_ms/culling_and_shading)
    echo "$ms" >> "$work/$way.ms"
    awk -v a="$ms" -v b="$tiled" 'BEGIN { print a / b }' >> "$work/$way.ratio"
  done
  printf '| %s | %s | %s | %.2f | %.2f | %.2f | %.1f | %.2f |\n' "$shot" "$n" "$way" \
    "$(value "$file" culling_tests_per_pixel/total)" "$(value "$file" lights_listed_per_pixel/total)" \
    "$(value "$file" lights_accepted_per_pixel/total)" "$(median < "$work/$way.ms")" "$(median < "$work/$way.ratio")"
}

printf '| shot | interleaving | culling | tests | listed | accepted | culling + shading [ms] | to tiled |\n'
printf '| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: |\n'
for shot in "${shots[@]}"; do
  for n in ${interleave//,/ }; do
    for ((round = 1; round <= rounds; ++round)); do
      for way in "${ways[@]}"; do run "$shot" "$n" "$way" "$round"; done
    done
    for way in "${ways[@]}"; do
      error=$("$build/luciole" compare "$work/$way.exr" "$work/tiled.exr" | awk '$1 == "rmse" { print $2 }')
      if ! awk -v e="$error" 'BEGIN { exit !(e != "" && e == 0) }'; then
        echo "device_rivals.sh: $shot, interleaving $n: $way makes another picture than tiled (RMSE $error)" >&2
        exit 1
      fi
    done
    for way in "${ways[@]}"; do row "$shot" "$n" "$way"; done
    rm -f "$work"/*.ms "$work"/*.ratio
  done
done
