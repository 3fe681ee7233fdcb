#!/bin/sh
# Passes the tests, from nothing: installs packages, configures with the arguments, builds and runs
# ctest.
set -eu
cd "$(dirname "$0")/.."

sh tools/install_packages.sh
cmake --preset release -D VNDF_BUILD_TESTS=ON "$@"
cmake --build --preset release
ctest --preset release --parallel "$(nproc)"
