#!/bin/bash
# The Debian packages of a build: looked into, unpacked into a root of their own and used from there. A step of .ci/run,
# as is installing them on a clean system, which takes a network: clean_debian.sh.
#   packages_test.sh BUILD FOLDER     FOLDER with the *.deb that BUILD made, for instance build/package/packages
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
# shellcheck source=expect.sh source-path=SCRIPTDIR
source "$here/expect.sh"
command -v pkg-config >/dev/null || { echo "SKIPPED: the packages were not looked into: it takes pkg-config"; exit 0; }
build=$1 debs=$2
cached() { sed -n "s/^$1:[A-Z]*=//p" "$build/CMakeCache.txt"; }
cxx=$(cached CMAKE_CXX_COMPILER)
python=$(cached THINWALL_PYTHON_EXECUTABLE)  # none where the module is not built
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

interface=$(sed -n 's/^project(thinwall VERSION \([0-9]*\.[0-9]*\).*/\1/p' "$here/../../CMakeLists.txt")
library=libthinwall$interface
mpi=$(find "$build/app" -name thinwall-mpi)  # none where MUMPS is not installed
names=(libthinwall-dev "$library" ${python:+python3-thinwall} thinwall ${mpi:+thinwall-mpi})
expect_equal "the packages" "${names[*]}" \
  "$(for deb in "$debs"/*.deb; do dpkg-deb -f "$deb" Package; done | LC_ALL=C sort | xargs)"

deb_of() { echo "$debs"/"$1"_*.deb; }
depends() { dpkg-deb -f "$(deb_of "$1")" Depends; }
paths() { dpkg-deb -c "$(deb_of "$1")" | awk '{ print $6 }'; }

root=$tree/root
for name in "${names[@]}"; do
  dpkg-deb -x "$(deb_of "$name")" "$root"
  expect_contains "$name: copyright" "/usr/share/doc/$name/copyright" "$(paths "$name")"
  expect_contains "$name: change log" "/usr/share/doc/$name/changelog.gz" "$(paths "$name")"
  expect_equal "$name: nothing outside /usr" "" "$(paths "$name" | grep -v '^\./usr/' | grep -v '^\./$' || true)"
  expect_equal "$name: owned by root" "" "$(dpkg-deb -c "$(deb_of "$name")" | grep -v ' root/root ' || true)"
done
cpu_only=$(cached THINWALL_NATIVE)
version=$(dpkg-deb -f "$(deb_of thinwall)" Version)
expect_equal "a build for this processor says so" "$cpu_only" "$([[ $version == *+native ]] && echo ON || echo OFF)"

# --- what they depend on, and what not
expect_contains "the program's libraries" "libtet1.5" "$(depends thinwall)"
expect_contains "the library's libraries" "libcholmod3" "$(depends "$library")"
expect_equal "headers of their own library" "$library (= $version), libeigen3-dev (>= 3.4)" "$(depends libthinwall-dev)"
expect_equal "the program needs no development package" "" "$(depends thinwall | tr ',' '\n' | grep -e '-dev' || true)"
expect_equal "the library exists for its soname" "libthinwall.so.$interface" \
  "$(find "$root/usr/lib" -name "libthinwall.so.$interface" -exec objdump -p {} + |
    awk '$1 == "SONAME" { print $2 }')"

if [[ -n $mpi ]]; then
  expect_contains "the ranks' libraries" "libmumps" "$(depends thinwall-mpi)"
  expect_equal "the program needs no MPI" "" "$(depends thinwall "$library" | tr ',' '\n' | grep -e mpi -e mumps || true)"
fi

# --- the words of the program, and whose they are that its page holds
expect_equal "the manual page" "$(<"$here/../../docs/thinwall.1")" "$(zcat "$root/usr/share/man/man1/thinwall.1.gz")"
for shell in bash:bash-completion/completions/thinwall zsh:zsh/vendor-completions/_thinwall \
  fish:fish/vendor_completions.d/thinwall.fish; do
  expect_equal "completion of ${shell%:*}" "$("$root/usr/bin/thinwall" completion "${shell%:*}")" \
    "$(<"$root/usr/share/${shell#*:}")"
done
# The field's text is the file's: a blank before each line, a dot for an empty one.
expect_contains "the licences of the page" "$(sed 's/^$/./; s/^/ /' "$here/../../web/dist/LICENSES.txt")" \
  "$(<"$root/usr/share/doc/thinwall/copyright")"
for name in plotly three fflate; do
  expect_contains "the licence of $name" "$name" "$(<"$here/../../web/dist/LICENSES.txt")"
done

# --- used from there
expect_contains "the program runs" "thinwall ${version%+native}" "$("$root/usr/bin/thinwall" --version 2>&1)"
folder=$(dirname "$(find "$root/usr/lib" -name libthinwall.so)")
export PKG_CONFIG_PATH=$folder/pkgconfig LD_LIBRARY_PATH=$folder
read -ra flags < <(pkg-config --cflags --libs thinwall)
"$cxx" -std=c++20 -O1 "$here/../../examples/cpp/couple_robot.cpp" -o "$tree/couple_robot" "${flags[@]}"
expect_contains "a program built against them" "routes differ by" "$("$tree/couple_robot")"
if [[ -n $python ]]; then
  expect_contains "the module's Python" "python3 (>= 3." "$(depends python3-thinwall)"
  expect_contains "the module's NumPy" "python3-numpy" "$(depends python3-thinwall)"
  expect_equal "the module is imported" "$root/usr/lib/python3/dist-packages/thinwall/__init__.py ${version%+native}" \
    "$(PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$root/usr/lib/python3/dist-packages "$python" -c \
      'import thinwall; print(thinwall.__file__, thinwall.__version__)' 2>&1)"
fi

# --- lintian, where it is installed: neither errors nor warnings
if command -v lintian >/dev/null; then
  expect_equal "lintian" "" "$(lintian --fail-on none "$debs"/*.deb 2>/dev/null | grep '^[EW]:' || true)"
fi
finish
