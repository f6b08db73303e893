#!/bin/bash
# Runs clang-tidy with .clang-tidy over the program's sources; fails on any finding.
#   check_tidy.sh [BUILD_FOLDER] [PATTERN]     pattern of the sources' paths, all but the tests if left out
# The build folder (build/release) must be configured: its compile_commands.json tells how each source is compiled.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

build=${1:-build/release}
pattern=${2:-"^$PWD/(core|dynamics|linalg|mesh|fem|reduction|robot|coupling|milling|io|app)/[^/]*\.cpp$"}
[[ -e $build/compile_commands.json ]] || { echo "no $build/compile_commands.json; run ./thinwall first" >&2; exit 2; }
# The sources are compiled by gcc: a warning option that clang does not know is no finding.
run-clang-tidy -quiet -p "$build" -j "$(nproc)" -extra-arg=-Wno-unknown-warning-option "$pattern"
