#!/bin/bash
# The include check must object to each kind of violation and to nothing else.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
# shellcheck source=expect.sh source-path=SCRIPTDIR
source "$here/expect.sh"
python=${1:-python3}
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

mkdir -p "$tree"/{core,dynamics,mesh,io/results,tests/io}
touch "$tree"/core/error.hpp "$tree"/mesh/tet_mesh.hpp "$tree"/tests/io/scratch.hpp

verdict() { "$python" "$here/../../cmake/check_includes.py" "$tree" 2>&1 || true; }

only() {  # path, line: the one source of the tree
  printf '%s\n' "$2" >"$tree/$1"
  verdict
  rm "$tree/$1"
}

fine="every include looks downwards"
expect_equal "downwards" "$fine" "$(only mesh/a.cpp '#include "core/error.hpp"')"
expect_equal "beside a test" "$fine" "$(only tests/io/a.cpp '#include "scratch.hpp"')"
expect_equal "VTK in its file" "$fine" "$(only io/results/vtu.cpp '#include <vtkCellArray.h>')"
expect_equal "upwards" 'core/a.cpp:1: core/ may not include mesh/' "$(only core/a.cpp '#include "mesh/tet_mesh.hpp"')"
expect_equal "sideways" 'dynamics/a.hpp:1: dynamics/ may not include mesh/' \
  "$(only dynamics/a.hpp '  #  include "mesh/tet_mesh.hpp"')"
expect_contains "VTK elsewhere" 'mesh/a.cpp:1: <vtkCellArray.h> belongs to' "$(only mesh/a.cpp '#include <vtkCellArray.h>')"
expect_contains "not from the root" 'does not exist' "$(only mesh/a.cpp '#include "tet_mesh.hpp"')"
expect_contains "ours in angle brackets" 'include it with quotes' "$(only mesh/a.cpp '#include <core/error.hpp>')"
finish
