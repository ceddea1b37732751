#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing from resources/debian-packages.txt, configures and builds into build/. Sourced by app/run.sh and
# tests/run.sh after a cd to the top of the tree. Usage: [targets=(spindrift ...)] . resources/setup.sh
# extra_packages=(...) are installed as well. Without targets everything is built, tests included. With targets only those are, and a build folder that is configured
# already keeps its settings: whoever runs the tests next finds them as they were.
set -euo pipefail

missing=()
while read -r package; do
  case "$package" in '' | '#'*) continue ;; esac
  dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
done < <(cat resources/debian-packages.txt; printf '%s\n' "${extra_packages[@]:-}")
if [ "${#missing[@]}" -gt 0 ]; then
  echo "Installing ${#missing[@]} Debian packages: ${missing[*]}"
  as_root=()
  if [ "$(id -u)" -ne 0 ]; then as_root=(sudo); fi
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

if [ -z "${targets[*]:-}" ]; then
  cmake --preset release -DSPINDRIFT_TESTS=ON >/dev/null
  cmake --build build
else
  [ -f build/build.ninja ] || cmake --preset release >/dev/null
  cmake --build build --target "${targets[@]}"
fi
