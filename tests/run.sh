#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The test command: installs what is missing, builds and runs every test. Prints how long each part took.
# With --fuzz every reader is fed with mutated files afterwards, five minutes of processors (preset fuzz, tests/fuzz/fuzz.sh),
# with --clean-root the Debian package is installed into an empty Debian (tests/package/clean_root.sh), both at the same time.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
fuzz=
clean_root=
for option in "$@"; do
  case "$option" in
    --fuzz) fuzz=yes ;;
    --clean-root) clean_root=yes ;;
    *)
      echo "unknown option \"$option\"; allowed: --fuzz, --clean-root, or none" >&2
      exit 2
      ;;
  esac
done
started=$SECONDS
targets=()
extra_packages=()
if [ -n "$fuzz" ]; then mapfile -t extra_packages <resources/debian-packages-fuzz.txt; fi
. resources/setup.sh
built=$SECONDS
export QT_QPA_PLATFORM=offscreen LC_ALL=C.UTF-8
set +e
# One more than there are processors: tests of the window wait for its clock now and then.
ctest --test-dir build --output-on-failure -j "$(($(nproc) + 1))" --timeout 600 | tee build/ctest.log
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
tested=$SECONDS
fuzzing=
if [ -n "$fuzz" ]; then
  (tests/fuzz/fuzz.sh --in-all 300 >build/fuzz.log 2>&1 && echo "mutated files $((SECONDS - tested)) s" >>build/fuzz.log) &
  fuzzing=$!
fi
if [ -n "$clean_root" ]; then tests/package/clean_root.sh || status=1; fi
if [ -n "$fuzzing" ]; then
  wait "$fuzzing" || status=1
  cat build/fuzz.log
fi
exit "$status"
