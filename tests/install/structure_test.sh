#!/bin/bash
# The check of the sources' structure objects to a ring of headers and to a folder that is too full, and to nothing else.
#   structure_test.sh PYTHON
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
# shellcheck source=expect.sh source-path=SCRIPTDIR
source "$here/expect.sh"
python=${1:-python3}
export PYTHONDONTWRITEBYTECODE=1
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

check() { "$python" "$here/../../cmake/check_structure.py" "$tree" || true; }
mkdir -p "$tree/core"
echo '#include "core/b.hpp"' >"$tree/core/a.hpp"
echo '#include <vector>' >"$tree/core/b.hpp"
expect_contains "headers in order" "no header includes itself" "$(check)"
echo '#include "core/a.hpp"' >"$tree/core/b.hpp"
expect_contains "a ring" "core/a.hpp -> core/b.hpp -> core/a.hpp" "$(check)"
echo '' >"$tree/core/b.hpp"
for i in $(seq 60); do touch "$tree/core/file$i.cpp"; done
expect_contains "a full folder" "core/ holds 62 sources; at most 60" "$(check)"
finish
