#!/bin/bash
# Runs clang-tidy with .clang-tidy over the program's sources; fails on any finding.
#   check_tidy.sh               the whole program, without the tests
#   check_tidy.sh --changed     ten batches of files: up to seven that have changed since the last release, or in the last
#                               twenty commits if there is none, and of the others a share that differs from day to day
#   check_tidy.sh PATTERN       files whose paths match, each by itself
# Most of the time goes to the headers of Eigen and CGAL. Files are therefore analysed in the batches in which they are
# compiled (THINWALL_BATCHES), which takes a third of the time, and files of a pattern each by itself. Nothing is built.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

most=10 share=3  # batches that are read, and how many of them at least are of those that have not changed
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

# Writes the batches that are read to the file chosen, and their patterns to the file patterns. Where the share of those
# that have not changed begins follows from the commit's day.
choose() {
  local all day first batch touched=() others=()
  changed_sources >"$build/changed"
  mapfile -t all < <(batches | sort -u)
  day=$(($(git log -1 --format=%ct 2>/dev/null || date +%s) / 86400))
  first=$((day * share % ${#all[@]}))
  for batch in "${all[@]:first}" "${all[@]:0:first}"; do
    if { echo "$batch"; grep -h '^#include' "$batch"; } | grep -qFf "$build/changed"; then
      touched+=("$batch")
    else
      others+=("$batch")
    fi
  done
  touched=("${touched[@]:0:most - share}")
  printf '%s\n' "${touched[@]}" "${others[@]:0:most - ${#touched[@]}}" | sed '/^$/d' >"$build/chosen"
  sed 's/.*/^&$/' "$build/chosen" >"$build/patterns"
  printf '%d of %d batches of sources\n' "$(wc -l <"$build/chosen")" "${#all[@]}"
}

case ${1:-} in
  "")
    configure ON
    analyse "^($build|$PWD)/($folders)/.*\.(cxx|cpp)$"
    ;;
  --changed)
    configure ON
    choose
    mapfile -t patterns <"$build/patterns"
    analyse "${patterns[@]}"
    ;;
  *)
    configure OFF
    analyse "$1"
    ;;
esac
