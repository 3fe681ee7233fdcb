#!/bin/sh
# Passes the tests, from nothing: installs packages, also those with which shaders run on the
# processor and those of the Python module, configures with the arguments, builds and runs ctest.
set -eu
cd "$(dirname "$0")/.."

sh tools/install_packages.sh glslang-tools spirv-cross libvulkan-dev mesa-vulkan-drivers chromium-common \
  python3-dev python3-numpy python3-pytest python3-matplotlib pybind11-dev mypy
cmake --preset release -D VNDF_BUILD_TESTS=ON "$@"
cmake --build --preset release
ctest --preset release --parallel "$(nproc)"
