#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Feeds every reader with mutated files until one breaks:
#   fuzz.sh [--whole-core] [SECONDS for each reader | --in-all SECONDS of processors | --runs RUNS for each reader] [READER ...]
# --whole-core: the readers that need most of core, whose program takes long to build.
# --runs is for nights: 1,000,000 runs of one reader take minutes to hours. A reader that has had its runs (counted in
# build-fuzz/runs/READER since the program was last built) is passed by, so that what was stopped goes on where it was.
# What broke one lies in build-fuzz/crashes; put it into tests/fuzz/corpus/READER, where the normal test suite reads it too.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
target=fuzz_readers
if [ "${1:-}" = --whole-core ]; then
  target=fuzz_whole_core
  shift
fi
in_all=
runs=
case "${1:-}" in
  --in-all)
    in_all=$2
    shift
    ;;
  --runs)
    runs=$2
    shift
    ;;
esac
amount=${1:-10}
if ! [[ $amount =~ ^[1-9][0-9]*$ ]]; then
  echo "fuzz.sh: \"$amount\" is no number of seconds or runs; allowed: a whole number above 0" >&2
  exit 2
fi
shift || true
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target "$target"
program=build-fuzz/bin/$target
readers=("$@")
if [ "${#readers[@]}" -eq 0 ]; then mapfile -t readers < <("$program" 2>&1 | tail -n +2); fi
if [ "${#readers[@]}" -eq 0 ]; then
  echo "$program names no reader" >&2
  exit 1
fi
if [ -n "$in_all" ]; then amount=$(((in_all + ${#readers[@]} - 1) / ${#readers[@]})); fi
mkdir -p build-fuzz/runs
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
# Feeds one reader.
feed() {
  local reader=$1 limit=-max_total_time=$amount done_before=0 counted=build-fuzz/runs/$1
  mkdir -p "build-fuzz/found/$reader" "build-fuzz/crashes/$reader"
  if [ -n "$runs" ]; then
    if [ "$counted" -nt "$program" ]; then done_before=$(<"$counted"); fi
    if [ "$done_before" -ge "$runs" ]; then
      echo "$reader: $done_before runs before"
      return 0
    fi
    limit=-runs=$((runs - done_before))
  fi
  # The same mutations each time, but where runs are counted: what went before is not done again.
  local seed=$((done_before + 1))
  if "$program" --reader="$reader" "$limit" -seed="$seed" -rss_limit_mb=2048 -malloc_limit_mb=1200 -timeout=20 -max_len=65536 \
    -artifact_prefix="build-fuzz/crashes/$reader/" -print_final_stats=1 -print_funcs=0 "build-fuzz/found/$reader" "tests/fuzz/corpus/$reader" \
    >"build-fuzz/$reader.log" 2>&1; then
    local executed
    executed=$(sed -n 's/^stat::number_of_executed_units: *//p' "build-fuzz/$reader.log")
    if [ -n "$runs" ]; then echo $((done_before + executed)) >"$counted"; fi
    echo "$reader: $((done_before + executed)) runs"
  else
    echo "$reader: broken, see build-fuzz/$reader.log"
    return 1
  fi
}
export -f feed
export amount runs program
# As many at once as there are processors.
printf '%s\n' "${readers[@]}" | xargs -P "$(nproc)" -I '{}' bash -c 'feed {}'
