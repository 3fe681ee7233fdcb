#!/bin/sh
# Installs what the build and the tests need on Debian 12, and the packages that the arguments name,
# as root or through sudo.
set -eu

packages="g++ cmake ninja-build libboost-dev libhdf5-dev libopenexr-dev catch2 libcli11-dev
  libfmt-dev libhwy-dev libmuparser-dev nlohmann-json3-dev gnuplot-nox libbenchmark-dev
  doxygen doxygen-awesome-css zlib1g-dev libpng-dev libtiff-dev
  libembree-dev help2man dpkg-dev file"

missing=""
for package in $packages "$@"; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' ||
    missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=""
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "as root, or with sudo: apt-get install$missing" >&2; exit 1; }
  as_root="sudo"
fi
$as_root apt-get update -qq
$as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing
