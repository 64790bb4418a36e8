#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Everything one does with a checkout. ./do without argument lists what works.
set -euo pipefail
cd "$(dirname "$0")"

usage() {
  cat <<'TEXT'
./do demo      install what is missing, build, render the gallery to out/demo.png, out/demo.exr, out/demo.json
./do build     install what is missing, build the program: build/luciole
./do test      install what is missing, build, run all tests
./do check     sanitizers, fuzzing, source format (long; what a release must pass)
./do reproduce [NAME ...] [--quick] [--document FILE]
               remake figures and tables of the papers, all or those named, and show them: out/report/index.html;
               goes on where it was interrupted. All of them take an hour or two; --quick takes minutes and proves nothing
./do bench     build and run the benchmarks, all or those named: remakes docs/results
./do format    format all C++ sources
TEXT
}

# The packages of the named parts of packages.txt.
packages_of() {
  awk -v parts=" $* " '/^\[/ { part = substr($1, 2, length($1) - 2); next }
                       /^[a-z0-9]/ && index(parts, " " part " ") { print $1 }' packages.txt
}

# Installs those that are missing, without a question. Other systems than Debian's must bring them along.
need() {
  command -v dpkg-query > /dev/null || return 0
  local missing=() package as_root=()
  for package in $(packages_of "$@"); do
    # A program of the package's name will do: some packages of nodejs bring npm along.
    [[ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null || true)" == installed ]] ||
      command -v "$package" > /dev/null || missing+=("$package")
  done
  ((${#missing[@]})) || return 0
  echo "installing: ${missing[*]}"
  ((EUID == 0)) || as_root=(sudo)
  export DEBIAN_FRONTEND=noninteractive
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" > /dev/null < /dev/null
}

# What drives the browser in the test of the report's page, in the version that package-lock.json names.
need_browser_driver() {
  local folder=report/browser
  [[ $folder/node_modules/.package-lock.json -nt $folder/package-lock.json ]] && return
  command -v npm > /dev/null || return 0  # the test will say that it is skipped
  echo "installing: playwright-core"
  (cd "$folder" && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error)
}

# configure FOLDER OPTION...: a ninja build in FOLDER; ccache where it is installed.
configure() {
  local folder=$1
  shift
  local launcher=()
  command -v ccache > /dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  cmake -S . -B "$folder" -G Ninja --log-level=WARNING "${launcher[@]}" "$@"
}

build_program() {
  configure build -DCMAKE_BUILD_TYPE=Release -DLUCIOLE_TESTS="${1:-OFF}"
}

cpp_sources() {
  find apps base benchmarks docs equations examples gpu image offline ray_tracing real_time report scene shot tests \
    \( -name '*.h' -o -name '*.cpp' -o -name '*.inc' \) -print0 2> /dev/null
}

demo() {
  need run
  build_program
  cmake --build build --target luciole
  mkdir -p out
  # A million lights for the caustics, eight jittered frames against the stairs at edges: half a minute on two cores.
  build/luciole render gallery --vpls 1048576 --accumulate 8 --jitter -o out/demo.png -o out/demo.exr --statistics out/demo.json
  echo "the picture:   $PWD/out/demo.png"
  echo "linear, EXR:   $PWD/out/demo.exr"
  echo "what it cost:  $PWD/out/demo.json"
}

build() {
  need run
  build_program
  cmake --build build --target luciole
  echo "the program: $PWD/build/luciole"
}

# What ctest says at its end, and why tests were skipped.
run_tests() {
  local folder=$1 log=$1/tests.log status=0
  shift
  ctest --test-dir "$folder" --parallel "$(nproc)" --output-on-failure --no-tests=error "$@" > "$log" 2>&1 || status=$?
  if ((status)); then cat "$log"; else tail -n 12 "$log"; fi
  return $status
}

test_all() {
  need run test report reproduce
  need_browser_driver
  build_program ON
  cmake --build build
  run_tests build
}

check() {
  need run test check reproduce
  tests/check.sh
}

# Remakes docs/results, or only the pages that are named.
bench() {
  need run test bench
  build_program
  benchmarks/run.sh "$@"
}

# Needs no browser: the page is for whatever one has.
reproduce() {
  need run reproduce
  build_program
  cmake --build build --target luciole
  exec python3 reproduce/reproduce.py build/luciole "$@"
}

format() {
  need check
  cpp_sources | xargs -0 clang-format -i
}

case "${1:-}" in
  demo) demo ;;
  build) build ;;
  test) test_all ;;
  check) check ;;
  bench) bench "${@:2}" ;;
  reproduce) reproduce "${@:2}" ;;
  format) format ;;
  '' | help | -h | --help) usage ;;
  *)
    echo "do: there is no '$1'; this works:" >&2
    usage >&2
    exit 2
    ;;
esac
