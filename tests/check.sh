#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What ./do check runs: unit tests under the address and undefined-behaviour sanitizers and under the thread sanitizer, a
# planted race, two minutes of fuzzing per target, the papers' figures at small sizes, the device's kernels under validation,
# and the format of all sources.
# Every part runs; any failure fails.
#   LUCIOLE_FUZZ_SECONDS   time per fuzz target, 120 by default
set -uo pipefail
cd "$(dirname "$0")/.." || exit

failures=()
launcher=()
command -v ccache > /dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
# clang: both compilers are exercised by the project. CMakeLists.txt gives sanitized code -O1.
common=(-G Ninja --log-level=WARNING "${launcher[@]}" -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14
  -DCMAKE_BUILD_TYPE=Release -DLUCIOLE_ASSERTIONS=ON)
# Address space randomisation of new kernels leaves too little room for the thread sanitizer's shadow.
steady=()
setarch "$(uname -m)" -R true 2> /dev/null && steady=(setarch "$(uname -m)" -R)
export LLVM_SYMBOLIZER_PATH=${LLVM_SYMBOLIZER_PATH:-/usr/bin/llvm-symbolizer-14}
export ASAN_SYMBOLIZER_PATH=$LLVM_SYMBOLIZER_PATH TSAN_SYMBOLIZER_PATH=$LLVM_SYMBOLIZER_PATH

part() {
  local name=$1 start=$SECONDS
  shift
  echo "== $name"
  if "$@"; then echo "== $name: passed in $((SECONDS - start)) s"; else
    echo "== $name: FAILED after $((SECONDS - start)) s"
    failures+=("$name")
  fi
}

# Without the tests that read whole scenes of others: minutes, and nothing that samples of them do not show.
unit_tests() {
  local folder=$1 whole_scenes='*_in_sponza:*_among_real_scenes:*_their_readme_counts'
  cmake --build "$folder" > "$folder/build.log" 2>&1 || { tail -n 60 "$folder/build.log"; return 1; }
  GTEST_FILTER="-$whole_scenes" "${steady[@]}" ctest --test-dir "$folder" -L unit --parallel "$(nproc)" --no-tests=error \
    --output-on-failure > "$folder/tests.log" 2>&1 ||
    { tail -n 200 "$folder/tests.log"; return 1; }
  tail -n 6 "$folder/tests.log"
}

address() {
  cmake -S . -B build-address "${common[@]}" -DLUCIOLE_SANITIZE=address,undefined || return 1
  ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1 UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1 \
    unit_tests build-address
}

thread() {
  cmake -S . -B build-thread "${common[@]}" -DLUCIOLE_SANITIZE=thread || return 1
  TSAN_OPTIONS="suppressions=$PWD/tests/thread_sanitizer.supp halt_on_error=1" unit_tests build-thread
}

# The suppressions must not hide a race of ours.
planted_race() {
  local log=build-thread/planted_race.log
  TSAN_OPTIONS="suppressions=$PWD/tests/thread_sanitizer.supp exitcode=66" \
    "${steady[@]}" build-thread/tests/planted_race > "$log" 2>&1
  local status=$?
  if ((status == 66)) && grep -q 'data race' "$log"; then return 0; fi
  echo "the planted race was not reported (exit code $status)"
  cat "$log"
  return 1
}

# The readers must survive two minutes each, from the bundled and the shared samples on; and the planted read past the
# end must be found in that time, or the fuzzing proves nothing.
fuzz() {
  local seconds=${LUCIOLE_FUZZ_SECONDS:-120} format
  cmake -S . -B build-fuzz "${common[@]}" -DLUCIOLE_FUZZERS=ON -DLUCIOLE_TESTS=OFF || return 1
  cmake --build build-fuzz --target fuzz_gltf fuzz_glb fuzz_obj fuzz_glb_planted > build-fuzz/build.log 2>&1 ||
    { tail -n 60 build-fuzz/build.log; return 1; }
  # Two at a time, one thread each.
  fuzz_reader gltf "$seconds" & local first=$!
  fuzz_reader glb "$seconds" & local second=$!
  local status=0
  wait "$first" || status=1
  wait "$second" || status=1
  fuzz_reader obj "$seconds" & first=$!
  if fuzz_one fuzz_glb_planted glb "$seconds"; then
    echo "the planted read past the end was not found in $seconds s"
    status=1
  elif ! grep -aq 'AddressSanitizer: heap-buffer-overflow' build-fuzz/fuzz_glb_planted.log; then
    tail -n 60 build-fuzz/fuzz_glb_planted.log
    status=1
  fi
  wait "$first" || status=1
  return $status
}

# fuzz_reader FORMAT SECONDS
fuzz_reader() {
  fuzz_one "fuzz_$1" "$1" "$2" || { tail -n 60 "build-fuzz/fuzz_$1.log"; return 1; }
  echo "fuzz_$1: $(grep -a '^Done' "build-fuzz/fuzz_$1.log")"
}

# fuzz_one TARGET EXTENSION SECONDS
fuzz_one() {
  local corpus=build-fuzz/corpus/$1 samples=${LUCIOLE_SCENES:-scenes}
  mkdir -p "$corpus"
  # Whole scenes are too slow to mutate: samples of at most 64 KiB.
  [[ -d $samples ]] && find "$samples" -name "*.$2" -size -64k -exec cp -n -t "$corpus" {} +
  "build-fuzz/tests/fuzz/$1" -max_total_time="$3" -timeout=20 -rss_limit_mb=4096 \
    -artifact_prefix="build-fuzz/$1-" "$corpus" > "build-fuzz/$1.log" 2>&1
}

# Every recipe from its commands to its page, at sizes that prove nothing but that.
reproduce_quick() {
  mkdir -p out
  ./do reproduce --quick > out/reproduce-quick.log 2>&1 || { tail -n 20 out/reproduce-quick.log; return 1; }
  tail -n 1 out/reproduce-quick.log
}

# Each access of each kernel of a frame that is made on the device by rays, which software Vulkan compiles for minutes even if
# it does not optimise.
validated_front() {
  [[ -x build/luciole ]] || ./do build || return 1
  mkdir -p out
  GALLIVM_PERF=nopt MESA_SHADER_CACHE_DISABLE=true build/luciole render "recipe:gallery?detail=0.05" --size 64x48 \
    --vpls 256 --engine vulkan --front rays --direct-shadows --temporal 4 --vulkan-validation --quiet -o out/validated.png
}

formatted() {
  local wrong
  wrong=$(find apps base benchmarks equations examples gpu image offline ray_tracing real_time report scene shot tests \
    \( -name '*.h' -o -name '*.cpp' \) -print0 2> /dev/null |
    xargs -0 clang-format --dry-run --Werror 2>&1 | grep -oE '^[^: ]+\.(h|cpp):' | sort -u)
  [[ -z $wrong ]] || { echo "not formatted (./do format mends it):"; echo "$wrong"; return 1; }
}

part "source format" formatted
part "address and undefined-behaviour sanitizers" address
part "thread sanitizer" thread
part "planted race" planted_race
part "fuzzing" fuzz
part "the papers' figures, quick" reproduce_quick
part "validation inside the kernels of the device's front" validated_front

if ((${#failures[@]})); then
  printf 'check failed: %s\n' "${failures[@]}"
  exit 1
fi
echo "check passed in $((SECONDS / 60)) min"
