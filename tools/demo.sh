#!/bin/sh
# The main job, from nothing: installs packages, configures, builds, makes the 1024 x 1024 tables of
# GGX and of Beckmann with their certificates, bakes them, and draws samples from what was baked. The
# arguments are for cmake.
set -eu
cd "$(dirname "$0")/.."

sh tools/install_packages.sh
cmake --preset release -D VNDF_BUILD_TESTS=OFF "$@"
cmake --build --preset release --target tables

for distribution in ggx beckmann; do
  echo
  echo "Samples of $distribution, seen from 60 degrees, alpha 0.5 x 0.2:"
  build/tools/vndf sample "build/tables/$distribution.vndf" --wi 0.866025,0,0.5 --alpha 0.5,0.2 -n 5
done
