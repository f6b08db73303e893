#!/bin/bash
# Installs the packages on a clean Debian 12, made for the purpose, and tries them there; a minute or two. .ci/run calls
# it. Exit 0 with a line that begins with SKIPPED where such a system cannot be made: it takes root, mmdebstrap and a
# network.
#   clean_debian.sh FOLDER     with the *.deb, for instance build/package/packages
set -euo pipefail
debs=$(readlink -f "$1")
here=$(dirname "$(readlink -f "$0")")

skip() {
  echo "SKIPPED: the packages were not tried on a clean Debian: $1"
  exit 0
}

[[ -n $(compgen -G "$debs/*.deb") ]] || { echo "there are no packages in $debs" >&2; exit 1; }
[[ $(id -u) -eq 0 ]] || skip "it takes root"
command -v mmdebstrap >/dev/null || skip "it takes mmdebstrap (packages.txt)"
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mmdebstrap --variant=minbase --dpkgopt=force-unsafe-io --include=g++,pkg-config bookworm "$root" || skip "mmdebstrap could not make one"
unshare --pid --fork --mount-proc="$root/proc" true || skip "processes of its own cannot be had here (unshare)"

mkdir "$root/debs" "$root/examples"
cp "$debs"/*.deb "$root/debs"
cp -r "$here"/../../examples/. "$root/examples"
cp -r "$here/../../cases/ding-2010" "$root/case"
cp /etc/resolv.conf "$root/etc/resolv.conf"

# With a /proc of its own, which is gone with the command.
inside() {
  unshare --pid --fork --mount-proc="$root/proc" \
    chroot "$root" env DEBIAN_FRONTEND=noninteractive PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"
}
inside apt-get update || skip "nothing can be fetched inside it"
inside sh -c 'apt-get install -y --no-install-recommends /debs/*.deb'
inside thinwall --version
inside thinwall doctor
inside thinwall run /case --out /tmp/results -q
# shellcheck disable=SC2016  # expanded inside
inside sh -c 'c++ -std=c++20 /examples/cpp/plate_modes.cpp -o /tmp/plate $(pkg-config --cflags --libs thinwall) && /tmp/plate'
inside python3 /examples/python/lobes_from_frf.py
inside python3 /examples/python/ding_2010.py /tmp/results
printf 'the packages work on a clean Debian\n'
