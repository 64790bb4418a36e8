#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs page_test.mjs, or says why not and ends with 77, which ctest reports as skipped.
#   page_test.sh LUCIOLE SCRATCH_FOLDER
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)

skip() {
  echo "skipped: $1 is not installed; ./do test installs it"
  exit 77
}

command -v node > /dev/null || skip "node"
browser=$(command -v chromium || command -v chromium-browser) || skip "chromium"
[[ -d $here/node_modules/playwright-core ]] || skip "playwright-core"
exec node "$here/page_test.mjs" "$browser" "$@"
