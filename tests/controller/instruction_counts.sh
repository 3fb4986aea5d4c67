#!/usr/bin/env bash
# What a step and a set-up take, in instructions: unlike times these are the same on every run, so that no change makes
# the controller slower without being seen. Valgrind counts a run and a longer one; the difference has no start-up.
#   instruction_counts.sh PROGRAM EXPECTED
# EXPECTED has lines of a name and a count. More or less than that by over a tenth fails: what became faster is written
# down, so that it is not lost again. 77: skipped, as there is no valgrind.
set -euo pipefail
program=$1 expected=$2
command -v valgrind > /dev/null || { echo "valgrind is not installed" && exit 77; }

# instructions WHAT NUMBER
instructions() {
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$program" "$@" 2>&1 |
    sed -n 's/.*Collected : \([0-9]*\).*/\1/p'
}
status=0
while read -r what count; do
  few=$(instructions "$what" 2000)
  more=$(instructions "$what" 12000)
  now=$(((more - few) / 10000))
  echo "$what: $now instructions, expected $count"
  if ((now * 10 > count * 11 || now * 10 < count * 9)); then
    echo "that is off by more than a tenth: mend it, or write $now into $expected and say why"
    status=1
  fi
done < "$expected"
exit $status
