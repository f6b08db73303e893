# shellcheck shell=bash
# Assertions for shell tests; `finish` ends the test with the count of failures.

failures=0

expect_equal() {  # what, expected, actual
  [[ $2 == "$3" ]] && return
  printf 'FAILED: %s\n  expected: %s\n  actual:   %s\n' "$1" "$2" "$3"
  failures=$((failures + 1))
}

expect_contains() {  # what, needle, haystack
  [[ $3 == *"$2"* ]] && return
  printf 'FAILED: %s\n  expected to contain: %s\n  actual: %s\n' "$1" "$2" "$3"
  failures=$((failures + 1))
}

finish() {
  [[ $failures -eq 0 ]] || { printf '%d expectations failed\n' "$failures"; exit 1; }
  printf 'all expectations hold\n'
}
