#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The Debian package as a user gets it: packed twice with the same hash, installed by apt into a Debian 12 that holds
# nothing but its base system, started there and self-tested. Needs what tests/run.sh has built, mmdebstrap, and root or user
# namespaces. Prints how long each part took.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"

part() { echo "$1 $((SECONDS - since)) s"; since=$SECONDS; }
since=$SECONDS

for turn in first second; do
  (umask 022 && cpack --config build/CPackConfig.cmake -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip -B "$work/$turn" >/dev/null)
done
package=$(cd "$work/first" && ls spindrift_*.deb)
sha256sum "$work/first/$package" "$work/second/$package" | sed "s|$work/||"
cmp "$work/first/$package" "$work/second/$package"
part "packed twice, same hash:"

cat >"$work/inside.sh" <<'INSIDE'
set -e
# Nothing that the package does not name: recommended packages stay out.
apt-get update -qq
DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends /tmp/spindrift.deb >/dev/null
export HOME=/root XDG_RUNTIME_DIR=/tmp/run QT_QPA_PLATFORM=offscreen LC_ALL=C.UTF-8
mkdir -m 700 -p /tmp/run
spindrift --version
spindrift-cli --version
spindrift-fe --version
spindrift --startup-time
spindrift --self-test
spindrift-cli manual --out /tmp/manual.pdf
cmp /tmp/manual.pdf /usr/share/doc/spindrift/manual.pdf
INSIDE
mmdebstrap --quiet --variant=apt --dpkgopt=force-unsafe-io --customize-hook="copy-in $work/inside.sh /tmp" \
  --customize-hook="upload $work/first/$package /tmp/spindrift.deb" \
  --customize-hook='chroot "$1" bash /tmp/inside.sh' bookworm /dev/null
part "installed into a clean root, started and self-tested:"
