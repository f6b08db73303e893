#!/bin/bash
# Runs clang-tidy with .clang-tidy over the program's sources; fails on any finding.
#   check_tidy.sh [PATTERN]     pattern of the sources' paths; the whole program, without the tests, if left out
# Most of the time goes to the headers of Eigen and CGAL. So the whole program is read in batches of one folder's files
# (a unity build, a third of the time), and files of a pattern each by itself. Nothing is built.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

mkdir -p build
build=$PWD/build/tidy
folders="core|dynamics|linalg|mesh|fem|reduction|robot|coupling|milling|io|setup|case|study|report|app"
pattern=${1:-"^($build|$PWD)/($folders)/.*\.(cxx|cpp)$"}
batches=ON
[[ $# -eq 0 ]] || batches=OFF
cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON \
  -DCMAKE_UNITY_BUILD=$batches -DCMAKE_UNITY_BUILD_BATCH_SIZE=8 >"$build.log" 2>&1 || { cat "$build.log" >&2; exit 2; }
sed -i 's/ -fcx-limited-range//g' "$build/compile_commands.json"  # gcc's, which clang does not know
# The sources are compiled by gcc, which also finds what shadows what, and not across the files of a batch.
run-clang-tidy -quiet -p "$build" -j "$(nproc)" -extra-arg=-Wno-unknown-warning-option \
  -extra-arg=-Wno-shadow "$pattern"
