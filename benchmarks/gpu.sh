#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Times the passes of the Vulkan engine, after its pictures were found to be the CPU engine's.
#   benchmarks/gpu.sh [--device NAME] [--size 1920x1080] [--vpls 65536,1048576] [--frames 50] [--peak TFLOPS,TB/s]
#                     [--front auto] [--store FOLDER] [SHOT ...]
# Builds into $BUILD (default: build). Shots: sponza, sibenik and gallery where $LUCIOLE_SCENES names the scenes' folder,
# else gallery. Pictures of the CPU engine are kept in FOLDER (default: out/gpu) and made where they are missing. Writes
# docs/results/CHIP/culling_and_shading.md, with the times of all passes below it; with the device's peak rates it says how
# far from its floors each time is; and, for the first of the counts, shading_variants.md. Five frames more warm the device
# up, but with --frames 1, for software Vulkan: then the frame that is checked is the one that is timed, and there are no
# variants.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${BUILD:-build} device='' size=1920x1080 vpls=65536,1048576 frames=50 peak='' front=auto store=out/gpu shots=()
# The mean square error relative to the picture that a light more or less at the edge of its range may make; other random
# numbers make more than a hundred times as much.
most_error=1e-4

usage() {
  sed -n '4,5s/^# *//p' "$0" >&2
  exit 2
}

while (($#)); do
  case $1 in
    --device | --size | --vpls | --frames | --peak | --front | --store)
      (($# > 1)) || usage
      declare "${1#--}=$2"
      shift 2
      ;;
    -*) usage ;;
    *) shots+=("$1") && shift ;;
  esac
done
if ((!${#shots[@]})); then
  shots=(gallery)
  [[ -n ${LUCIOLE_SCENES:-} ]] && shots=(sponza sibenik gallery)
fi

# shellcheck source=benchmarks/statistics.sh
source benchmarks/statistics.sh
[[ -f $build/build.ninja ]] || cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DLUCIOLE_TESTS=OFF
cmake --build "$build" --target luciole operations_benchmark shading_variants_benchmark > /dev/null
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$store"
engine=(--engine vulkan --front cpu)
whole=(--engine vulkan --front "$front")
[[ -n $device ]] && engine+=(--device "$device") && whole+=(--device "$device")
"$build/benchmarks/operations_benchmark" > "$work/operations"

render() { "$build/luciole" render "$@" --size "$size" --quiet > /dev/null; }
noisy() { render "$@" --filter none; }
error_of() { "$build/luciole" compare "$1" "$2" | awk '$1 == "relmse" { print $2 }'; }

# cpu_picture SHOT COUNT LOBES: FOLDER/NAME.exr and .json, unless they are there.
cpu_picture() {
  local name=$store/$1-$2-$3-$size
  [[ -f $name.exr && -f $name.json ]] && return
  noisy "$1" --vpls "$2" --lobes "$3" -o "$name.exr" --statistics "$name.json"
}

# The same picture, or the end.
check() {
  local name=$1-$2-$3-$size error
  noisy "$1" --vpls "$2" --lobes "$3" "${engine[@]}" -o "$work/picture.exr" --statistics "$work/one.json"
  error=$(error_of "$work/picture.exr" "$store/$name.exr")
  if ! awk -v e="$error" -v most="$most_error" 'BEGIN { exit !(e <= most) }'; then
    echo "gpu.sh: $1 with $2 VPLs, $3 lobes: relMSE to the CPU's picture is $error, more than $most_error" >&2
    exit 1
  fi
  printf '%s' "$error"
}

# Milliseconds that the device needs for operations, and for bytes, at its peak rates.
floors() {
  awk -v size="$size" -v peak="$peak" -v vpls="$2" -v lobes="$3" -v tests="$(value "$1" culling_tests_per_pixel/total)" \
    -v ld="$(value "$1" lights_listed_per_pixel/diffuse)" -v lg="$(value "$1" lights_listed_per_pixel/glossy)" \
    -v ad="$(value "$1" lights_accepted_per_pixel/diffuse)" -v ag="$(value "$1" lights_accepted_per_pixel/glossy)" '
    { count[$1] = $2 }
    END {
      split(size, side, "x"); split(peak, rate, ","); pixels = side[1] * side[2]; kinds = lobes == "all" ? 2 : 1
      per_pixel = tests * count["sphere_test"] + ld * count["diffuse_listed"] + ad * count["diffuse_accepted"]
      per_pixel += lg * count["glossy_listed"] + ag * count["glossy_accepted"]
      operations = pixels * per_pixel
      bytes = pixels * (count["bytes_per_pixel"] + kinds * count["bytes_per_pixel_and_kind"])
      if (lobes != "glossy") bytes += vpls * count["diffuse_bytes_per_light"]
      if (lobes != "diffuse") bytes += vpls * count["glossy_bytes_per_light"]
      printf "%.3g %.3g", operations / 1e9, bytes / 1e6
      if (peak != "") printf " %.3g %.3g", operations / rate[1] / 1e9, bytes / rate[2] / 1e9
      printf "\n"
    }' "$work/operations"
}

row() {
  local shot=$1 count=$2 lobes=$3 error cpu=$store/$1-$2-$3-$size.json shading ranges numbers
  cpu_picture "$shot" "$count" "$lobes"
  error=$(check "$shot" "$count" "$lobes")
  cp "$work/one.json" "$work/times.json"
  ((frames == 1)) || noisy "$shot" --vpls "$count" --lobes "$lobes" "${engine[@]}" --accumulate "$((frames + 5))" \
    -o "$work/mean.exr" --statistics "$work/times.json"
  ranges=$(value "$work/times.json" passes_ms/light_range)
  shading=$(value "$work/times.json" passes_ms/culling_and_shading)
  floors "$work/times.json" "$count" "$lobes" > "$work/floors"
  read -ra numbers < "$work/floors"
  printf '| %s | %s | %s | %.2f | %.2f | %.2f | %s | %.3f | %.3f | %.2f |' "$shot" "$count" "$lobes" \
    "$(value "$work/times.json" culling_tests_per_pixel/total)" "$(value "$work/times.json" lights_listed_per_pixel/total)" \
    "$(value "$work/times.json" lights_accepted_per_pixel/total)" "$error" "$ranges" "$shading" \
    "$(awk -v a="$(value "$cpu" passes_ms/culling)" -v b="$(value "$cpu" passes_ms/shading)" -v v="$shading" \
      'BEGIN { print (a + b) / v }')"
  printf ' %s |' "${numbers[@]}"
  printf '\n'
}

table() {
  local shot count lobes floor_titles='' floor_lines=''
  if [[ -n $peak ]]; then
    floor_titles=' operations at peak [ms] | bytes at peak [ms] |'
    floor_lines=' ---: | ---: |'
  fi
  printf '\n| shot | VPLs | lobes | tests | listed | accepted | relMSE to the CPU | ranges [ms] | culling + shading [ms] | '
  printf 'CPU engine, times as long | operations [10^9] | bytes [10^6] |%s\n' "$floor_titles"
  printf '| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |%s\n' "$floor_lines"
  for shot in "${shots[@]}"; do
    for count in ${vpls//,/ }; do
      for lobes in diffuse glossy all; do row "$shot" "$count" "$lobes"; done
    done
  done
}

# All passes of frames whose view is made anew each time, filtered; and how far a still one is from the CPU's: pixels at
# edges may show the other surface, which must be less than other random numbers make.
passes_row() {
  local shot=$1 count=$2 name=$store/$1-$2-filtered-$size error other pass seed
  for seed in 1 2; do
    [[ -f $name-$seed.exr ]] || render "$shot" --vpls "$count" --seed "$seed" -o "$name-$seed.exr"
  done
  render "$shot" --vpls "$count" "${whole[@]}" -o "$work/picture.exr" -o "$work/picture.png" \
    --statistics "$work/passes.json"
  error=$(error_of "$work/picture.exr" "$name-1.exr") other=$(error_of "$name-2.exr" "$name-1.exr")
  if ! awk -v e="$error" -v other="$other" 'BEGIN { exit !(e <= other) }'; then
    echo "gpu.sh: $shot with $count VPLs: relMSE to the CPU's picture is $error; that of other random numbers is $other" >&2
    exit 1
  fi
  ((frames == 1)) || render "$shot" --vpls "$count" "${whole[@]}" --jitter --frames "0-$((frames + 4))" \
    -o "$work/frame####.png" --statistics "$work/passes.json"
  if [[ -z ${pass_names:-} ]]; then
    pass_names=$(passes "$work/passes.json")
    printf '\n| shot | VPLs | relMSE to the CPU |'
    for pass in $pass_names; do printf ' %s |' "${pass//_/ }"; done
    printf ' frame |\n| --- | ---: | ---: |'
    for pass in $pass_names; do printf ' ---: |'; done
    printf ' ---: |\n'
  fi
  printf '| %s | %s | %s |' "$shot" "$count" "$error"
  for pass in $pass_names; do printf ' %.3f |' "$(value "$work/passes.json" "passes_ms/$pass")"; done
  printf ' %.3f |\n' "$(value "$work/passes.json" frame_ms)"
}

all_passes() {
  local shot count
  for shot in "${shots[@]}"; do
    for count in ${vpls//,/ }; do passes_row "$shot" "$count"; done
  done
}

table > "$work/table"
all_passes > "$work/all_passes"
chip=$(value "$work/times.json" device | tr -d '"')
folder=docs/results/$(tr '[:upper:]' '[:lower:]' <<< "${chip%% (*}" | tr -cs '[:alnum:]\n' '_' | sed 's/_*$//')
mkdir -p "$folder"
{
  printf '# Culling and shading on %s\n\nRemake: `benchmarks/gpu.sh --size %s --vpls %s --frames %s' "$chip" "$size" "$vpls" "$frames"
  [[ $front != auto ]] && printf ' --front %s' "$front"
  [[ -n $peak ]] && printf ' --peak %s' "$peak"
  printf '`.\n\n'
  if ((frames == 1)); then
    printf 'Each time is that of one frame, by timestamps of the device: a second run may differ by a fifth.'
  else
    printf 'Medians by timestamps of the device over the frames and five more, of which a median does not feel the first.'
  fi
  cat << 'TEXT'
 Tests (light against tile), listed and
accepted pairs are means per pixel. The CPU engine's time is that of one frame on the same machine's processor. Operations
and bytes are the least that the frame asks for: what each test, listed and accepted pair computes
(`benchmarks/operations_benchmark.cpp`; a multiply-add is two, a division or root four), each pixel and light read once
and each sum written once.
TEXT
  cat "$work/table"
  cat << 'TEXT'

## All passes

TEXT
  if ((frames == 1)); then
    printf 'Milliseconds of one frame, with the filter.'
  else
    printf 'Medians of milliseconds over frames whose view is made anew each time (`--jitter`), with the filter.'
  fi
  cat << 'TEXT'
 Transfer is what
the clock of the CPU shows beyond the timestamps. The relative error is that of one still frame: where an edge passes
through the middle of a pixel, the two engines may show different surfaces.
TEXT
  cat "$work/all_passes"
} > "$work/page.md"
mv "$work/page.md" "$folder/culling_and_shading.md"
echo "$folder/culling_and_shading.md"
((frames > 1)) || exit 0
"$build/benchmarks/shading_variants_benchmark" "$device" "$size" "${vpls%%,*}" "$frames" "${shots[@]}" > "$work/variants.md"
mv "$work/variants.md" "$folder/shading_variants.md"
echo "$folder/shading_variants.md"
