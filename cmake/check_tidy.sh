#!/bin/bash
# Runs clang-tidy with .clang-tidy over the program's sources; fails on any finding.
#   check_tidy.sh [PATTERN]     pattern of the sources' paths; the whole program, without the tests, if left out
# Most of the time goes to the headers of Eigen and CGAL. So the whole program is read in batches of one folder's files
# (a unity build, a fifth of the time), and files of a pattern each by itself. Nothing is built.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

mkdir -p build
build=$PWD/build/tidy
pattern=${1:-"^$build/.*/unity_[0-9a-z_]*\.cxx$|^$PWD/(core|dynamics|linalg|mesh|fem|reduction|robot|coupling|milling|io|app)/[^/]*\.cpp$"}
batches=ON
[[ $# -eq 0 ]] || batches=OFF
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
  -DCMAKE_UNITY_BUILD=$batches -DCMAKE_UNITY_BUILD_BATCH_SIZE=8 >"$build.log" 2>&1 || { cat "$build.log" >&2; exit 2; }
# The sources are compiled by gcc: a warning option that clang does not know is no finding.
run-clang-tidy -quiet -p "$build" -j "$(nproc)" -extra-arg=-Wno-unknown-warning-option "$pattern"
