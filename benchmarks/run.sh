#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Remakes docs/results: benchmarks/run.sh [culling|baselines|speed|kernel|scaling|steadiness|filter|memory|light_choice|
# variance_parts|ray_rate|geometry|equal_time|pbrt ...], all without arguments (equal_time alone takes an hour and three quarters; pbrt only where
# $PBRT names that program, geometry only if asked for, as it needs a Vulkan device). Builds into $BUILD (default: build). Shots of files take part where $LUCIOLE_SCENES names their folder.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${BUILD:-build} results=docs/results
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$results"

[[ -f $build/build.ninja ]] || cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DLUCIOLE_TESTS=OFF
cmake --build "$build" --target luciole benchmarks > "$work/build.log" || { cat "$work/build.log"; exit 1; }
programs=$build/benchmarks
processor=$("$programs/kernel_benchmark" --processor)

has_scenes() { [[ -n ${LUCIOLE_SCENES:-} ]]; }
supports() { "$programs/kernel_benchmark" --supports "$1"; }

# page NAME COMMAND...: what the command prints becomes the page, if it succeeds.
page() {
  local name=$1
  shift
  echo "== $name"
  "$@" > "$work/$name.md"
  mv "$work/$name.md" "$results/$name.md"
}

# shellcheck source=benchmarks/statistics.sh
source benchmarks/statistics.sh

median() { sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

# render NAME SHOT OPTION...: writes $work/NAME.json. Each run is a process of its own, as a user's.
render() {
  local name=$1 shot=$2
  shift 2
  "$build/luciole" render "$shot" --quiet -o "$work/picture.exr" --statistics "$work/$name.json" "$@" > /dev/null
}

# Median of KEY over the runs NAME.1 ... NAME.N.
median_of() {
  local file
  for file in "$work/$1".[0-9]*.json; do value "$file" "$2"; done | median
}

main_shots() { has_scenes && echo sponza sibenik gallery || echo gallery; }

speed() {
  local shot isa run pass runs kinds=()
  for isa in avx512 avx2 baseline; do supports "$isa" && kinds+=("$isa"); done
  printf '# Speed\n\nRemake: `benchmarks/run.sh speed`. Processor: %s.\n\n' "$processor"
  printf '`luciole render SHOT --size 1920x1080 --vpls 65536 --delta 0.001 --isa ISA`; medians [ms] of five runs on the\n'
  printf 'fastest instruction set and of two on the others, each a process of its own. Loading and building the tree\nof '
  printf 'triangles are not in the frame. Lights are means per pixel: listed for its tile half, left by the test of its\n'
  printf 'group, accepted.\n'
  for shot in $(main_shots); do
    for isa in "${kinds[@]}"; do
      runs=2
      [[ $isa == "${kinds[0]}" ]] && runs=5
      for ((run = 1; run <= runs; ++run)); do
        render "$shot.$isa.$run" "$shot" --size 1920x1080 --vpls 65536 --delta 0.001 --isa "$isa"
      done
    done
    printf '\n## %s\n\n| pass |' "$shot"
    printf ' %s |' "${kinds[@]}"
    printf '\n| --- |'
    printf ' ---: |%.0s' "${kinds[@]}"
    for pass in $(passes "$work/$shot.${kinds[0]}.1.json"); do speed_row "$shot" "$pass" "passes_ms/$pass" %.1f; done
    speed_row "$shot" '**frame**' frame_ms %.0f
    speed_row "$shot" 'pairs per second' light_pixel_evaluations_per_second %.2e
    printf '\n\n| lights per pixel | total | diffuse | glossy |\n| --- | ---: | ---: | ---: |'
    for key in listed evaluated accepted; do
      printf '\n| %s |' "$key"
      for lobe in total diffuse glossy; do
        printf ' %.2f |' "$(value "$work/$shot.${kinds[0]}.1.json" "lights_${key}_per_pixel/$lobe")"
      done
    done
    printf '\n'
  done
}

# speed_row SHOT TITLE KEY FORMAT: one column per instruction set of `kinds`.
speed_row() {
  local kind
  printf '\n| %s |' "$2"
  for kind in "${kinds[@]}"; do printf " $4 |" "$(median_of "$1.$kind" "$3")"; done
}

memory() {
  local vpls shot
  shot=$(main_shots | cut -d' ' -f1)
  printf '# Memory\n\nRemake: `benchmarks/run.sh memory`. Processor: %s.\n\n' "$processor"
  printf 'Largest resident set of `luciole render %s --size 1920x1080 --vpls N`, scene and tree of triangles\nincluded.\n' \
    "$shot"
  printf '\n| virtual point lights | peak [GiB] | frame [ms] |\n| ---: | ---: | ---: |\n'
  for vpls in 65536 1048576; do
    render memory "$shot" --size 1920x1080 --vpls "$vpls"
    printf '| %d | %.2f | %.0f |\n' "$vpls" \
      "$(awk -v b="$(value "$work/memory.json" peak_memory_bytes)" 'BEGIN { print b / 2^30 }')" \
      "$(value "$work/memory.json" frame_ms)"
  done
}

# Cycles per light and 16 pixels that the ports of the inner loops need, and what llvm-mca expects with latencies and
# the length of the queues: lines "NAME CYCLES" and "simulated_NAME CYCLES".
port_bounds() {
  local compiler mca=$1
  compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[^=]*=//p' "$build/CMakeCache.txt")
  "$compiler" -std=c++20 -O3 -fPIC -I. -mavx512f -mavx512dq -mavx512vl -mavx512bw -mavx2 -mfma -w -S \
    benchmarks/marked_loops.cpp -o "$work/loops.s"
  "$mca" -mcpu=icelake-server "$work/loops.s" 2> /dev/null |
    awk '/Code Region - / { name = $NF }
         /Iterations:/ { iterations = $NF }
         /Total Cycles:/ { print "simulated_" name, $NF / iterations }
         /Block RThroughput/ { print name, $NF }'
}

kernel() {
  local shot mca
  shot=$(main_shots | cut -d' ' -f1)
  mca=$(command -v llvm-mca || command -v llvm-mca-14 || true)
  if supports avx512 && [[ -n $mca ]]; then port_bounds "$mca" > "$work/bounds.txt"; fi
  touch "$work/bounds.txt"
  "$programs/kernel_benchmark" "$shot" "$work/bounds.txt"
}

filter() {
  local isa
  printf '# The filter\n\nRemake: `benchmarks/run.sh filter`. Processor: %s. What was tried and why:\n' "$processor"
  printf '[decisions](../decisions/filter.md).\n'
  for isa in avx512 avx2 baseline; do
    supports "$isa" || continue
    printf '\n## %s, 1920x1080\n\n```\n' "$isa"
    "$programs/filter_benchmark" --size 1920x1080 --runs 5 --isa "$isa"
    printf '```\n'
  done
}

# Every choice of lights for 30 s on every scene, the rivals that count for two minutes: an hour and three quarters.
equal_time() {
  local scenes=('recipe:lamps?count=60000' 'recipe:lamps?count=5000' 'recipe:lamps?count=1000000'
    'recipe:lamps?count=60000&glossy=0.15')
  has_scenes && scenes+=(lost-empire sports-car)
  cat << 'TEXT'
# Path tracing in equal time

TEXT
  printf 'Remake: `benchmarks/run.sh equal_time`. Processor: %s.\n\n' "$processor"
  cat << 'TEXT'
1280x720; every choice of lights gets 30 s on all cores, and culling, the tree and uniform choice go on to two minutes, in
whole samples of the picture; relMSE is what was measured times the time taken over the time given. The reference is the
mean of two renders of other random numbers, and the variance that their difference tells is taken off: errors are against
the truth, not against the reference's noise.
Clamped ranges are biased: their error does not fall as time passes.
TEXT
  "$programs/equal_time_benchmark" 30,120 120 1280x720 "${scenes[@]}"
}

ray_rate() {
  local shots
  read -ra shots <<< "$(main_shots)"
  "$programs/ray_rate_benchmark" 'recipe:lamps?count=60000' "${shots[@]}"
}

geometry() {
  local shots
  read -ra shots <<< "$(main_shots)"
  "$programs/geometry_benchmark" "${shots[@]}"
}

variance_parts() {
  local scenes=('recipe:lamps?count=5000' 'recipe:lamps?count=60000' 'recipe:lamps?count=60000&glossy=0.15')
  has_scenes && scenes+=(lost-empire sports-car)
  "$programs/variance_parts_benchmark" "${scenes[@]}"
}

# Against pbrt-v4 where $PBRT names its program: the same scene, which `luciole make` writes for it.
pbrt() {
  local count bounces samples
  printf '# Beside pbrt-v4\n\nRemake: `PBRT=path/to/pbrt benchmarks/run.sh pbrt`. Processor: %s.\n\n' "$processor"
  cat << 'TEXT'
`luciole make lamps count=N matte=1 --bounces B -o lamps.pbrt` is what pbrt renders: integrator `path`, light sampler
`bvh`, box filter, 640x360. Luciole gets the seconds that pbrt took (without loading), on the same cores in the same run.
Reference: Luciole, four times as long, with other random numbers; its own variance, a quarter of that of the shorter
render, is taken off all errors. The last two columns compare pbrt's light tree with ours (`--lights tree`) at as many
samples: the rival that the other pages measure against is a fair one where the last is near one or above.

| lamps | bounces | s | samples, pbrt | samples, Luciole | relMSE, pbrt | relMSE, Luciole | ratio | mean, pbrt to Luciole | tree's relMSE at equal samples | pbrt's to our tree's |
| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |
TEXT
  for count in 5000 60000; do
    for bounces in 1 3; do
      samples=$((bounces == 1 ? 16 : 8))
      pbrt_row "$count" "$bounces" "$samples"
    done
  done
}

pbrt_row() {
  local count=$1 bounces=$2 samples=$3 seconds common key
  "$build/luciole" make lamps "count=$count" matte=1 --size 640x360 --bounces "$bounces" --samples "$samples" \
    -o "$work/lamps.pbrt" > /dev/null
  # Its last progress line ends in the seconds of rendering.
  seconds=$(cd "$work" && "$PBRT" --seed 7 lamps.pbrt 2> /dev/null | tr '\r' '\n' | sed -n 's/.*(\([0-9.]*\)s).*/\1/p' | tail -n 1)
  common=("recipe:lamps?count=$count&matte=1" --method path --bounces "$bounces" --size 640x360 --pixel-filter box --quiet)
  "$build/luciole" render "${common[@]}" --time "$seconds" -o "$work/ours.exr" --statistics "$work/ours.json"
  "$build/luciole" render "${common[@]}" --samples "$samples" --lights tree -o "$work/tree.exr"
  "$build/luciole" render "${common[@]}" --time "$(awk -v s="$seconds" 'BEGIN { print 4 * s }')" --seed 99 -o "$work/reference.exr"
  for key in lamps ours tree; do
    "$build/luciole" compare "$work/$key.exr" "$work/reference.exr" > "$work/$key.txt"
  done
  awk -v count="$count" -v bounces="$bounces" -v seconds="$seconds" -v samples="$samples" \
    -v ours_samples="$(value "$work/ours.json" samples_per_pixel)" '
    FNR == 1 { ++file }
    $1 == "relmse" { error[file] = $2 }
    $1 == "mean_ratio" && file == 1 { mean = $2 }
    END { own = error[2] * 4 / 5; for (f = 1; f <= 3; ++f) error[f] -= own / 4
          printf "| %d | %d | %.1f | %d | %d | %.4g | %.4g | %.1f | %.4f | %.4g | %.2f |\n", count, bounces, seconds, samples,
            ours_samples, error[1], error[2], error[1] / error[2], mean, error[3], error[1] / error[3] }' \
    "$work/lamps.txt" "$work/ours.txt" "$work/tree.txt"
}

pages=("$@")
((${#pages[@]})) || pages=(speed memory kernel filter scaling steadiness culling baselines light_choice variance_parts
  ray_rate equal_time)
[[ -n ${PBRT:-} ]] && ((! $#)) && pages+=(pbrt)
for name in "${pages[@]}"; do
  case $name in
    speed | memory | kernel | filter | variance_parts | ray_rate | geometry | equal_time | pbrt) page "$name" "$name" ;;
    scaling | steadiness | culling | baselines | light_choice) page "$name" "$programs/${name}_benchmark" ;;
    *)
      echo "run.sh: no page '$name'" >&2
      exit 2
      ;;
  esac
done
