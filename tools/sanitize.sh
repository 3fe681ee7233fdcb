#!/bin/sh
# Runs the tests of the library once more with the sanitizers: all but the slowest with those of
# addresses and undefined behaviour, and what runs on several threads with that of data races. The
# arguments are for cmake.
set -eu
cd "$(dirname "$0")/.."

sh tools/install_packages.sh clang libclang-rt-dev
cmake --preset sanitize "$@"
cmake --build --preset sanitize
ctest --preset sanitize --parallel "$(nproc)"

cmake --preset threads "$@"
cmake --build --preset threads --target vndf_concurrency_tests
ctest --preset threads --tests-regex concurrency
