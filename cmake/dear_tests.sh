#!/bin/bash
# Prints a regular expression of the dear tests that are not run this time, for `ctest --exclude-regex`. Dear are those
# that take four seconds and more (tests/seconds.txt); together they take four fifths of the time of all. Each time a
# fifth of them is run, by their seconds, and which fifth follows from the hour of the last commit. A run of all
# tests is `./thinwall test`.
#   dear_tests.sh [HOUR]    HOUR, a whole number, stands for that of the last commit
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

shares=5
hour=${1:-$(($(git log -1 --format=%ct 2>/dev/null || date +%s) / 3600))}
[[ $hour =~ ^[0-9]+$ ]] || { echo "usage: dear_tests.sh [HOUR]   HOUR is a whole number, not \"$hour\"" >&2; exit 2; }
# The next in order of seconds goes to the share that has fewest so far.
awk '$1 !~ /^#/ && $2 >= 4 { print $2, $1 }' tests/seconds.txt | sort -k 1,1nr -k 2 |
  awk -v shares="$shares" -v now="$((10#$hour % shares))" '
    { least = 0
      for (i = 1; i < shares; ++i) if (seconds[i] < seconds[least]) least = i
      seconds[least] += $1
      if (least != now) { gsub(/[.]/, "[.]", $2); printf "%s^%s$", between, $2; between = "|" } }
    END { print "" }'
