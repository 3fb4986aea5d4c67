#!/usr/bin/env bash
# Random runs of the guarantee, judged by the checker that shares no code with the project.
#   traces_hold.sh AGREEMENT_TESTS CHECK_TRACE STEPS [JOBS]
# The test launches characters, so that continuity is not asked for.
# STEPS of each family: among scenery that stands, with any up, among movers, and among what turns.
set -euo pipefail
tests=$1 checker=$2 steps=$3 jobs=${4:-1}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export PAPERPROOF_GUARANTEE_TRACES=$folder PAPERPROOF_GUARANTEE_STEPS=$steps PAPERPROOF_TURNING_STEPS=$steps
"$tests" --gtest_brief=1 --gtest_filter='*Guarantee.no_step*:*AnyUp.*:*AmongMovers.no_step_breaks*:*AmongTurning.*'
find "$folder" -name '*.jsonl' -print0 | sort -z |
  xargs -0 --max-args=100 --max-procs="$jobs" python3 "$checker" --but continuity > "$folder/found" || true
grep --invert-match ', 0 violations' "$folder/found" || true
awk -v files="$(find "$folder" -name '*.jsonl' | wc -l)" '
  / violations/ { runs++; steps += $2; contacts += $4; if ($6 != "0") broken++ }
  END {
    printf "%d runs, %d steps, %d contacts: %d runs break a promise\n", runs, steps, contacts, broken
    exit broken > 0 || runs != files || contacts < steps / 10
  }' "$folder/found"
