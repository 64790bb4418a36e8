#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Kills a path tracing run at random times, COUNT times, resumes it each time, and compares the picture with that of a run
# that was left in peace. At most the interval between two checkpoints may be lost by a kill.
#   tests/kill_and_resume.sh PROGRAM [COUNT] [RENDER OPTIONS...]
#   tests/kill_and_resume.sh build/luciole 50 lamps --size 640x360 --samples 200
set -euo pipefail
program=$(realpath "${1:?the program: build/luciole}")
count=${2:-50}
shift $(($# < 2 ? $# : 2))
(($#)) || set -- lamps --size 320x180 --samples 150
every=0.3 # [s]
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$program" render "$@" --method path --quiet -o "$folder/whole.exr"
resume() { exec "$program" render "$@" --method path --quiet --checkpoint "$folder/sums.exr" \
  --checkpoint-every "$every" --resume -o "$folder/resumed.exr"; }

killed=0 tries=0
while ((killed < count)); do
  rm -f "$folder/resumed.exr"
  resume "$@" &
  process=$!
  sleep "$(awk -v seed="$((++tries))" 'BEGIN { srand(seed); print 0.05 + 3 * rand() }')"
  kill -9 "$process" 2> /dev/null || true
  status=0
  wait "$process" 2> /dev/null || status=$?
  case $status in
    0) # it was done before: compared, and from the start again
      cmp "$folder/whole.exr" "$folder/resumed.exr" || exit 1
      rm -f "$folder/sums.exr"
      ;;
    137) killed=$((killed + 1)) ;;
    *) echo "exit code $status after $killed kills" && exit 1 ;;
  esac
done
(resume "$@")
cmp "$folder/whole.exr" "$folder/resumed.exr"
left=$(find "$folder" -name '*.partial-*' | wc -l)
((left == 0)) || { echo "$left unfinished files were left behind"; exit 1; }
echo "$killed kills: the picture is the same, bit for bit"
