#!/bin/bash
# Other programs against an installed thinwall: a clean prefix, the examples by find_package and by pkg-config, compiled
# without and with wider vector units than the library, their numbers against closed forms.
#   programs_test.sh BUILD CMAKE CXX PYTHON
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
# shellcheck source=expect.sh source-path=SCRIPTDIR
source "$here/expect.sh"
command -v pkg-config >/dev/null || { echo "skipped: it takes pkg-config (packages.txt)"; exit 77; }
build=$1 cmake=$2 cxx=$3 python=$4
root=$here/../..
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
prefix=$tree/prefix

for component in library dev; do
  "$cmake" --install "$build" --prefix "$prefix" --component $component >"$tree/install.log"
done
header_folders=$(cd "$prefix/include/thinwall" && ls)
expect_equal "a header folder a library folder" "case core coupling distributed dynamics fem identification io learning linalg mesh milling posture reduction regression robot setup study" \
  "$(xargs <<<"$header_folders")"
expect_equal "no header names another from the sources' root" "" \
  "$(grep -rnE '#include "(core|mesh|io)/' "$prefix/include" || true)"
expect_equal "nothing installed names the place it was built" "" \
  "$(grep -rlI "$(readlink -f "$root")" "$prefix" || true)"

# --- find_package
"$cmake" -S "$root/examples/cpp" -B "$tree/examples" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_PREFIX_PATH="$prefix" >"$tree/configure.log"
"$cmake" --build "$tree/examples" >"$tree/build.log" || cat "$tree/build.log"
"$tree/examples/plate_modes" >"$tree/plate_modes.txt"
"$tree/examples/couple_robot" >"$tree/couple_robot.txt"
"$tree/examples/lobes_from_frf" "$root/examples/data/tip.csv" >"$tree/lobes_from_frf.txt"
expect_equal "the examples against closed forms" "closed forms hold" \
  "$("$python" "$here/closed_forms.py" "$tree" 2>&1 || true)"

# --- pkg-config, for vector units narrower and wider than the library's
# By the compiler that is Debian's c++ where there is one, because the library may have been made by another.
cxx=$(command -v g++ || echo "$cxx")
library=$(dirname "$(find "$prefix/lib" -name libthinwall.so)")
export PKG_CONFIG_PATH=$library/pkgconfig LD_LIBRARY_PATH=$library
read -ra flags < <(pkg-config --cflags thinwall)
read -ra libs < <(pkg-config --libs thinwall)
expect_equal "pkg-config's version" "$(sed -n 's/^project(thinwall VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")" \
  "$(pkg-config --modversion thinwall)"
compile() { "$cxx" -std=c++20 -O1 "$@" "${libs[@]}"; }
units=(-march=x86-64)
grep -qw avx2 /proc/cpuinfo && units+=(-mavx2)
grep -qw avx512f /proc/cpuinfo && units+=("-mavx512f -mfma -w")  # gcc 12 warns of its own AVX-512 headers
for unit in "${units[@]}"; do
  # shellcheck disable=SC2086  # several words
  compile $unit "${flags[@]}" "$here/alignment.cpp" -o "$tree/alignment"
  expect_equal "compiled with $unit" "alignment holds" "$("$tree/alignment" 2>&1 || true)"
done

# --- the program of docs/cpp.md
mkdir "$tree/wall"
awk '/^```/ { inside = 0 } inside { print } /^```cpp/ { inside = 1 }' "$root/docs/cpp.md" >"$tree/wall/main.cpp"
awk '/^```/ { inside = 0 } inside { print } /^```cmake/ { inside = 1 }' "$root/docs/cpp.md" >"$tree/wall/CMakeLists.txt"
"$cmake" -S "$tree/wall" -B "$tree/wall/build" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_PREFIX_PATH="$prefix" >"$tree/configure.log"
"$cmake" --build "$tree/wall/build" >"$tree/build.log" || cat "$tree/build.log"
# A clamped-free plate strip has 475 Hz, 3.516/(2 pi) sqrt(E h^2/(12 rho (1 - nu^2)))/L^2; the wall, twice as wide as
# high, some 1 % less, for its ends are not held from curving.
first=$("$tree/wall/build/wall" | sed -n 's/^.*first mode \([0-9.]*\) Hz.*$/\1/p')
expect_equal "the program of docs/cpp.md, $first Hz" yes \
  "$(awk -v hz="$first" 'BEGIN { print (hz > 475 * 0.985 && hz < 475 * 1.001 ? "yes" : "no") }')"

# --- every folder's public header, and what becomes of one without the library's alignment
for folder in $header_folders; do echo "#include <thinwall/$folder/$folder.hpp>"; done >"$tree/all.cpp"
expect_equal "all public headers in one file" "" \
  "$("$cxx" -std=c++20 -Wall -Wextra -Wshadow -fsyntax-only "${flags[@]}" "$tree/all.cpp" 2>&1 || true)"
read -ra without_pins < <(pkg-config --cflags-only-I thinwall)
echo '#include <thinwall/core/core.hpp>' >"$tree/bare.cpp"
expect_contains "without the two definitions" "compile with -DEIGEN_MAX_ALIGN_BYTES=32" \
  "$("$cxx" -std=c++20 -fsyntax-only "${without_pins[@]}" "$tree/bare.cpp" 2>&1 || true)"
finish
