#!/bin/bash
# Fails, with the places, if the layout of a source differs from .clang-format.  check_format.sh --fix corrects it.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

mode=(--dry-run --Werror)
[[ ${1:-} == --fix ]] && mode=(-i)
find core dynamics linalg distributed mesh fem reduction robot coupling regression identification milling learning posture io setup case study report app python tests fuzz examples bench \
  \( -name '*.cpp' -o -name '*.hpp' \) -print0 | xargs -0 clang-format "${mode[@]}"
