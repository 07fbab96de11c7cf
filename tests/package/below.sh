#!/usr/bin/env bash
# Copyright (c) 2026 the sward authors
# SPDX-License-Identifier: MIT
#
#   below.sh SWARD
# Configures a project that has sward as a subdirectory, on a machine without OpenMesh, GLFW, CLI11 and GoogleTest: there
# are the four libraries that draw and nothing else, static or, with BUILD_SHARED_LIBS, shared.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat > "$work/CMakeLists.txt" << 'END'
cmake_minimum_required(VERSION 3.25)
project(engine LANGUAGES CXX)
add_subdirectory("${SWARD}" sward)
foreach(name IN ITEMS terrain gl terrain_gl vegetation)
  if(NOT TARGET sward::${name})
    message(FATAL_ERROR "there is no sward::${name}")
  endif()
  get_target_property(type sward::${name} TYPE)
  if(NOT type STREQUAL EXPECTED_TYPE)
    message(FATAL_ERROR "sward::${name} is a ${type}, not a ${EXPECTED_TYPE}")
  endif()
endforeach()
foreach(target IN ITEMS sward_scene sward_image_io sward_mesh_source sward sward_host hello_headless)
  if(TARGET ${target})
    message(FATAL_ERROR "${target} is built below another project")
  endif()
endforeach()
if(SWARD_WERROR OR SWARD_TESTS OR SWARD_INSTALL OR DEFINED openimageio_FOUND)
  message(FATAL_ERROR "warnings as errors, tests, install rules or OpenImageIO are on below another project")
endif()
END
missing=()
for package in OpenMesh glfw3 CLI11 GTest nlohmann_json; do missing+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"); done
configure() {
  cmake -S "$work" -B "$work/build" "-DSWARD=$1" "${missing[@]}" "${@:2}" > "$work/log" 2>&1 ||
    { cat "$work/log" >&2; exit 1; }
}
configure "$1" -DEXPECTED_TYPE=STATIC_LIBRARY
rm -rf "$work/build"
configure "$1" -DEXPECTED_TYPE=SHARED_LIBRARY -DBUILD_SHARED_LIBS=ON
