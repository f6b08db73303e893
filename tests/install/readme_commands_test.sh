#!/bin/bash
# CI calls the commands of the README's section "Two commands" and no others that the README shows; a step that fails or
# is skipped is not one that passed. Of the dearest tests CI does a fifth each time.
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
# shellcheck source=expect.sh source-path=SCRIPTDIR
source "$here/expect.sh"
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

mkdir "$tree/.ci"
cp "$here"/../../.ci/{run,steps.sh} "$tree/.ci"

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

printf '%s\n' "$section" >"$tree/README.md"
step() { "$tree/.ci/run" step "$@" 2>&1 || echo "code $?"; }
expect_contains "a step that passes" "=== a: passed in 0 s" "$(step a echo fine)"
expect_contains "one that fails" "=== a: FAILED after 0 s
=== FAILED: a (logs in build/ci-logs)
code 1" "$(step a false)"
skipped=$(step a printf 'SKIPPED: no browser\nmore\n')
expect_contains "one that is skipped" "=== a: SKIPPED: no browser
=== SKIPPED: a" "$skipped"
expect_equal "it does not pass" "" "$(grep -e passed -e code <<<"$skipped" || true)"
expect_contains "one that is skipped and fails" "=== FAILED: a" "$(step a sh -c 'echo SKIPPED: a part; exit 1')"

expect_equal "this README" 2 "$("$here/../../.ci/run" commands | wc -l)"
expect_contains "a slow step that is not there" "no step \"thread\"; there are sanitizers" "$("$here/../../.ci/slow" thread 2>&1 || true)"

# Each of the dear tests is run in one of five hours, and the hours share them alike.
dear=$(awk '$1 !~ /^#/ && $2 >= 4 { print $1 }' "$here/../seconds.txt" | sort)
left_out=$(for hour in 0 1 2 3 4; do "$here/../../cmake/dear_tests.sh" "$hour" | tr '|' '\n' | tr -d '^$[]'; done | sort)
expect_equal "each is left out four times" "$dear" "$(uniq -c <<<"$left_out" | awk '$1 == 4 { print $2 }')"
expect_equal "and none more often" "" "$(uniq -c <<<"$left_out" | awk '$1 != 4 { print $2 }')"
finish
