#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The test command: installs what is missing, builds and runs every test. Prints how long each part took.
# With --fuzz every reader is fed with mutated files afterwards, five minutes in all (preset fuzz, tests/fuzz/fuzz.sh).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
fuzz=
case "${1:-}" in
  '') ;;
  --fuzz) fuzz=yes ;;
  *)
    echo "unknown option \"$1\"; allowed: --fuzz, or none" >&2
    exit 2
    ;;
esac
started=$SECONDS
targets=()
extra_packages=()
if [ -n "$fuzz" ]; then mapfile -t extra_packages <resources/debian-packages-fuzz.txt; fi
. resources/setup.sh
built=$SECONDS
export QT_QPA_PLATFORM=offscreen LC_ALL=C.UTF-8
set +e
ctest --test-dir build --output-on-failure -j "$(nproc)" --timeout 600 | tee build/ctest.log
status=${PIPESTATUS[0]}
set -e
failed=$(sed -n 's/^[0-9]*% tests passed, \([0-9]*\) tests failed out of \([0-9]*\)$/\1/p' build/ctest.log)
total=$(sed -n 's/^[0-9]*% tests passed, \([0-9]*\) tests failed out of \([0-9]*\)$/\2/p' build/ctest.log)
echo "set-up and build $((built - started)) s, tests $((SECONDS - built)) s"
if [ -z "$total" ] || [ "$total" -eq 0 ]; then
  echo "no test ran" >&2
  exit 1
fi
echo "$((total - failed)) passed, $failed failed"
if [ -n "$fuzz" ]; then
  tested=$SECONDS
  tests/fuzz/fuzz.sh --in-all 300 || status=1
  echo "mutated files $((SECONDS - tested)) s"
fi
exit "$status"
