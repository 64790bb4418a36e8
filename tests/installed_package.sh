#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs a finished build, builds both examples outside the tree against it, and runs them.
#   installed_package.sh BUILD_FOLDER SCRATCH_FOLDER [EXAMPLE ...]
set -euo pipefail
build=$1
scratch=$2
shift 2
[ $# -gt 0 ] || set -- render_a_scene tiled_lighting
here=$(cd "$(dirname "$0")" && pwd)

rm -rf "$scratch"
mkdir -p "$scratch"
cmake --install "$build" --prefix "$scratch/first_place" > "$scratch/install.log"
mv "$scratch/first_place" "$scratch/prefix"  # a package must not remember where it was installed
if grep -rlF -e "$(dirname "$here")" -e first_place "$scratch/prefix/lib" --include='*.cmake'; then
  echo "The package's files above name folders of this machine."
  exit 1
fi

for example in "$@"; do
  cp -r "$here/examples/$example" "$scratch/$example"
  echo "== $example"
  cmake -S "$scratch/$example" -B "$scratch/$example/build" -G Ninja -DCMAKE_PREFIX_PATH="$scratch/prefix" \
    > "$scratch/$example/configure.log"
  cmake --build "$scratch/$example/build" > "$scratch/$example/build.log" || {
    cat "$scratch/$example/build.log"
    exit 1
  }
  cd "$scratch/$example"
  case $example in
    render_a_scene) build/render_a_scene && test -s picture.png ;;
    tiled_lighting)
      # What an engine programmer changes: two includes, two lines.
      diff clamped.comp stochastic.comp > change.diff || true
      cat change.diff
      test "$(grep -c '^<' change.diff)" = 2
      test "$(grep -c '^> #include' change.diff)" = 2
      test "$(grep -c '^>' change.diff)" = 4
      build/tiled_lighting 128 64 4096
      ;;
  esac
done
