#!/bin/bash
# Fails, naming the places, if a source is not laid out as .clang-format says.  check_format.sh --fix mends it.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

mode=(--dry-run --Werror)
[[ ${1:-} == --fix ]] && mode=(-i)
find core dynamics linalg mesh fem reduction robot coupling milling io setup case study report app python tests fuzz examples \
  \( -name '*.cpp' -o -name '*.hpp' \) -print0 | xargs -0 clang-format "${mode[@]}"
