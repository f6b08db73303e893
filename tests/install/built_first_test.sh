#!/bin/bash
# `cmake --install` after a build of the program alone builds what else it installs, and only that; a small project stands
# for the large one.
#   built_first_test.sh CMAKE CC
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
# shellcheck source=expect.sh source-path=SCRIPTDIR
source "$here/expect.sh"
cmake=$1 cc=$2
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

echo 'int main(void) { return 0; }' >"$tree/program.c"
echo 'int one(void) { return 1; }' >"$tree/library.c"
cat >"$tree/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(small C)
include($(readlink -f "$here/../../cmake/ThinwallBuiltFirst.cmake"))
add_executable(program program.c)
add_library(library SHARED library.c)
add_library(other SHARED EXCLUDE_FROM_ALL library.c)
thinwall_built_first(program runtime)
install(TARGETS program RUNTIME COMPONENT runtime)
thinwall_built_first(library library)
install(TARGETS library LIBRARY COMPONENT library)
END
"$cmake" -S "$tree" -B "$tree/build" -DCMAKE_C_COMPILER="$cc" >"$tree/log"
"$cmake" --build "$tree/build" --target program >"$tree/log"
"$cmake" --install "$tree/build" --prefix "$tree/prefix" >"$tree/log" 2>&1 || cat "$tree/log"
expect_equal "the program and the library" "bin/program lib/liblibrary.so" \
  "$(cd "$tree/prefix" && find . -type f | sed 's|^./||' | LC_ALL=C sort | xargs)"
expect_equal "nothing else is built" "no" "$([[ -e $tree/build/libother.so ]] && echo yes || echo no)"

touch "$tree/library.c"
before=$(stat -c %Y "$tree/build/liblibrary.so")
"$cmake" --install "$tree/build" --prefix "$tree/second" >"$tree/log" 2>&1 || cat "$tree/log"
expect_equal "what is there is installed as it is" "$before" "$(stat -c %Y "$tree/build/liblibrary.so")"
finish
