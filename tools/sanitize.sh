#!/bin/sh
# Runs tests of the library once more with sanitizers: what meets bytes from outside or works on
# memory by hand with those of addresses and undefined behaviour, and what runs on several threads
# with that of data races. The other tests only compute, and would take ten times as long as these.
# The arguments are for cmake.
set -eu
cd "$(dirname "$0")/.."
programs="vndf_runtime_tests vndf_distribution_tests vndf_file_tests vndf_kernel_tests vndf_batch_tests
  vndf_report_tests vndf_concurrency_tests"

# anything_of NAMES... is the regular expression of the names and of the fuzzers' corpora.
anything_of() {
  echo "^($(echo "$*" | tr ' ' '|')|fuzz_.*)\$"
}

sh tools/install_packages.sh clang libclang-rt-dev
cmake --preset sanitize "$@"
cmake --build --preset sanitize --target fuzzers $programs
ctest --preset sanitize --parallel "$(nproc)" --tests-regex "$(anything_of $programs)"

cmake --preset threads "$@"
cmake --build --preset threads --target vndf_concurrency_tests
ctest --preset threads --tests-regex "^vndf_concurrency_tests\$"
