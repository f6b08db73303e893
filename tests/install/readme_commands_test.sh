#!/bin/bash
# CI calls the commands of the README's section "Two commands" and no others that the README shows.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
# shellcheck source=expect.sh source-path=SCRIPTDIR
source "$here/expect.sh"
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

mkdir "$tree/.ci"
cp "$here/../../.ci/run" "$tree/.ci/run"

commands_of() {  # text of the README
  printf '%s\n' "$1" >"$tree/README.md"
  "$tree/.ci/run" commands 2>&1 || true
}

section=$'## Two commands\n\n    ./thinwall run cases/first\n    ./thinwall test\n'
both=$'    ./thinwall run cases/first\n    ./thinwall test'
expect_equal "others elsewhere" "$both" \
  "$(commands_of "    ./thinwall test early
$section
## Text of another section

    ./thinwall run cases/second    another case")"
expect_contains "two of a kind" 'shows 2 commands ./thinwall run, not one' \
  "$(commands_of "$section"$'    ./thinwall run cases/second\n')"
expect_contains "none" 'shows 0 commands ./thinwall run, not one' "$(commands_of '## Two commands')"
expect_equal "this README" 2 "$("$here/../../.ci/run" commands | wc -l)"
finish
