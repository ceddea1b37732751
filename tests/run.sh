#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The test command: installs what is missing, builds and runs every test. Prints how long each part took.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
started=$SECONDS
targets=()
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
exit "$status"
