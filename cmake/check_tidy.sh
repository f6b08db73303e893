#!/bin/bash
# Runs clang-tidy with .clang-tidy over the program's sources; fails on any finding.
#   check_tidy.sh               the whole program, without the tests
#   check_tidy.sh --changed     files changed since the last release, or in the last twenty commits if there is none, and
#                               a share of the others that differs from day to day, in some two minutes on two idle processors
#   check_tidy.sh PATTERN       files whose paths match, each by itself
# Most of the time goes to the headers of Eigen and CGAL. Files are therefore analysed in the batches in which they are
# compiled (THINWALL_BATCHES), which takes a third of the time, and files of a pattern each by itself. Nothing is built.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

at_least=6 at_most=10  # batches: what changed, up to the second, and of the rest so many as make up the first
build=$PWD/build/tidy
folders="core|dynamics|linalg|distributed|mesh|fem|reduction|robot|coupling|regression|identification|milling|learning|posture|io|setup|case|study|report|app"

configure() {  # batches or not
  mkdir -p build
  cmake --preset tidy -DTHINWALL_BATCHES="$1" >"$build.log" 2>&1 || { cat "$build.log" >&2; exit 2; }
}

analyse() {  # patterns
  run-clang-tidy -quiet -p "$build" -j "$(nproc)" "$@"
}

batches() { sed -nE "s#^ *\"file\": \"(($build|$PWD)/($folders)/.*\.(cxx|cpp))\".*#\1#p" "$build/compile_commands.json"; }

changed_sources() {  # a header stands for the source of its name, or, without one, for the first that includes it
  local since file source
  since=$(git describe --tags --abbrev=0 2>/dev/null || git rev-parse -q --verify HEAD~20 2>/dev/null) || return 0
  git diff --name-only --diff-filter=d "$since" -- '*.cpp' '*.hpp' | while read -r file; do
    source=${file%.hpp}
    source=${source%.cpp}.cpp
    [[ -e $source ]] || source=$(git grep -l "#include \"$file\"" -- '*.cpp' | grep -m 1 -E "^($folders)/" || true)
    [[ -z $source ]] || echo "$source"
  done | sort -u
}

# Writes all batches to the file in_turn, those with a changed source first, and sets `chosen`, how many are read. Where
# in the list the rest begins follows from the commit's day.
in_turn() {
  local all day first batch touched=() others=()
  changed_sources >"$build/changed"
  mapfile -t all < <(batches | sort -u)
  day=$(($(git log -1 --format=%ct 2>/dev/null || date +%s) / 86400))
  first=$((day * at_least % ${#all[@]}))
  for batch in "${all[@]:first}" "${all[@]:0:first}"; do
    if { echo "$batch"; grep -h '^#include' "$batch"; } | grep -qFf "$build/changed"; then
      touched+=("$batch")
    else
      others+=("$batch")
    fi
  done
  printf '%s\n' "${touched[@]}" "${others[@]}" | sed '/^$/d' >"$build/in_turn"
  chosen=$((${#touched[@]} < at_least ? at_least : ${#touched[@]} > at_most ? at_most : ${#touched[@]}))
}

case ${1:-} in
  "")
    configure ON
    analyse "^($build|$PWD)/($folders)/.*\.(cxx|cpp)$"
    ;;
  --changed)
    configure ON
    in_turn
    head -n "$chosen" "$build/in_turn" | sed 's/.*/^&$/' >"$build/patterns"
    printf '%d of %d batches of sources\n' "$(wc -l <"$build/patterns")" "$(wc -l <"$build/in_turn")"
    mapfile -t patterns <"$build/patterns"
    analyse "${patterns[@]}"
    ;;
  *)
    configure OFF
    analyse "$1"
    ;;
esac
