#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Feeds every reader with mutated files until one breaks: fuzz.sh [SECONDS for each reader | --in-all SECONDS] [READER ...]
# What broke one lies in build-fuzz/crashes; put it into tests/fuzz/corpus/READER, where the normal test suite reads it too.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
in_all=
if [ "${1:-}" = --in-all ]; then
  in_all=$2
  shift
fi
seconds=${1:-10}
shift || true
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target fuzz_readers
program=build-fuzz/bin/fuzz_readers
readers=("$@")
if [ "${#readers[@]}" -eq 0 ]; then mapfile -t readers < <("$program" 2>&1 | tail -n +2); fi
if [ "${#readers[@]}" -eq 0 ]; then
  echo "$program names no reader" >&2
  exit 1
fi
if [ -n "$in_all" ]; then seconds=$(((in_all + ${#readers[@]} - 1) / ${#readers[@]})); fi
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
status=0
for reader in "${readers[@]}"; do
  mkdir -p "build-fuzz/found/$reader" "build-fuzz/crashes/$reader"
  if "$program" --reader="$reader" -max_total_time="$seconds" -rss_limit_mb=2048 -malloc_limit_mb=1200 -timeout=20 -max_len=65536 \
    -artifact_prefix="build-fuzz/crashes/$reader/" -print_final_stats=1 -print_funcs=0 "build-fuzz/found/$reader" "tests/fuzz/corpus/$reader" \
    >"build-fuzz/$reader.log" 2>&1; then
    echo "$reader: $(sed -n 's/^stat::number_of_executed_units: *//p' "build-fuzz/$reader.log") runs"
  else
    echo "$reader: broken, see build-fuzz/$reader.log"
    status=1
  fi
done
exit "$status"
