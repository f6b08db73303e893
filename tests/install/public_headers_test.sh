#!/bin/bash
# The check of the public headers must object to each kind of violation and to nothing else.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
# shellcheck source=expect.sh source-path=SCRIPTDIR
source "$here/expect.sh"
python=${1:-python3}
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir "$tree/mesh"
touch "$tree/mesh/box.hpp" "$tree/mesh/long_name.hpp" "$tree/mesh/sweep.hpp"

verdict() {  # lines of mesh/mesh.hpp
  printf '%s\n' "$@" >"$tree/mesh/mesh.hpp"
  "$python" "$here/../../cmake/check_public_headers.py" "$tree" 2>&1 || true
}

expect_equal "all told, over two lines" "every header is public or internal" \
  "$(verdict '// All that mesh/ offers to other programs.' '// Internal: long_name,' '// sweep.' '#include "mesh/box.hpp"')"
expect_equal "one forgotten" "mesh/mesh.hpp: sweep.hpp is neither included nor named as internal" \
  "$(verdict '// Internal: long_name.' '#include "mesh/box.hpp"')"
expect_equal "one gone" "mesh/mesh.hpp: bend.hpp does not exist" \
  "$(verdict '// Internal: long_name, sweep, bend.' '#include "mesh/box.hpp"')"
expect_equal "one twice" "mesh/mesh.hpp: box.hpp is included and named as internal" \
  "$(verdict '// Internal: long_name, sweep, box.' '#include "mesh/box.hpp"')"
finish
