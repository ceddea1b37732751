#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# study_as_batch.sh SPINDRIFT_CLI HIDDEN_EFFECT_STUDY COVERAGE_STUDY: both studies alone and as batches in
# chunks. The table that is gathered is the study's own, but for what it says of time.
set -euo pipefail
cli=$(realpath "$1") hidden=$(realpath "$2") coverage=$(realpath "$3")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
store=plant.sqlite

# batch NAME FIRST LAST CHUNK RUN...: works on it, and writes NAME.jsonl.
batch() {
  local name=$1 first=$2 last=$3 chunk=$4 run
  shift 4
  run=$(printf ',"%s"' "$@")
  printf '{"format":"spindrift-batch","version":1,"name":"%s","work":"command","seeds":[%s,%s],"chunk":%s,"options":{"run":[%s]}}' \
    "$name" "$first" "$last" "$chunk" "${run:1}" >"$name.json"
  "$cli" batch "$name.json" --processes 2 --store "$store"
  "$cli" batch status "$name" --store "$store" --results "$name.jsonl"
}

same() {
  diff <(grep -v -e ' ms' "$1") <(grep -v -e ' ms' "$2") || { echo "$3: what is gathered is not what the study says alone"; exit 1; }
}

options=(--campaigns 8 --seed 3 --kind nothing --list)
"$hidden" "${options[@]}" >alone.txt
campaigns=$(sed -n 's/^\([0-9]*\) campaigns.*/\1/p' alone.txt)
[ "$campaigns" -ge 4 ]
batch hidden 0 $((campaigns - 1)) 3 "$hidden" "${options[@]}" --item '{seed}'
"$hidden" "${options[@]}" --gather hidden.jsonl >gathered.txt
same alone.txt gathered.txt hidden_effect_study
# A part of the answers, or those of other seeds, is no study.
head -n 2 hidden.jsonl >part.jsonl
if "$hidden" "${options[@]}" --gather part.jsonl; then echo "a part was taken for the whole"; exit 1; fi
if "$hidden" --campaigns 8 --seed 4 --kind nothing --gather hidden.jsonl; then echo "another study was taken for this one"; exit 1; fi

"$coverage" 12 >alone.txt
batch coverage 0 11 4 "$coverage" 1 --seed '{seed}'
"$coverage" --gather coverage.jsonl >gathered.txt
same alone.txt gathered.txt coverage_study
