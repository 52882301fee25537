#!/usr/bin/env bash
# What recipe.yaml runs. CMAKE_ARGS is conda-forge's: prefix, compilers, where packages are found.
set -euo pipefail
# shellcheck disable=SC2086
cmake -S . -B build -G Ninja $CMAKE_ARGS -DCMAKE_BUILD_TYPE=Release -DPython_EXECUTABLE="$PYTHON" \
  -DRAYTUBE_PYTHON=REQUIRED -DRAYTUBE_MPI=OFF -DRAYTUBE_TESTS=OFF -DRAYTUBE_BENCH=OFF
cmake --build build
cmake --install build
rm -r "$PREFIX/lib/python3"  # as pip installs it, it is found and listed by Python
RAYTUBE_BUILD=build "$PYTHON" -m pip install . --no-deps --no-build-isolation
