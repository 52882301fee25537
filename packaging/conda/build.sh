#!/usr/bin/env bash
# What recipe.yaml runs. CMAKE_ARGS is conda-forge's: prefix, compilers, where packages are found.
set -euo pipefail
# shellcheck disable=SC2086
cmake -S openmesh -B openmesh/build -G Ninja $CMAKE_ARGS -DCMAKE_INSTALL_PREFIX="$SRC_DIR/openmesh/prefix" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_POSITION_INDEPENDENT_CODE=ON -DCMAKE_POLICY_VERSION_MINIMUM=3.5 -DBUILD_APPS=OFF -DOPENMESH_DOCS=OFF -DOPENMESH_BUILD_SHARED=OFF
cmake --build openmesh/build --target install

# shellcheck disable=SC2086
cmake -S . -B build -G Ninja $CMAKE_ARGS -DCMAKE_BUILD_TYPE=Release -DOpenMesh_ROOT="$SRC_DIR/openmesh/prefix" -DPython_EXECUTABLE="$PYTHON" \
  -DRAYTUBE_PYTHON=REQUIRED -DRAYTUBE_MPI=OFF -DRAYTUBE_TESTS=OFF -DRAYTUBE_BENCH=OFF
cmake --build build
cmake --install build
rm -r "$PREFIX/lib/python3"  # as pip installs it, it is found and listed by Python
RAYTUBE_BUILD=build "$PYTHON" -m pip install . --no-deps --no-build-isolation
