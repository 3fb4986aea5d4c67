#!/usr/bin/env bash
# Writes rows and traces of every kind with the command, and validates them against the schemas.
#   written_files_hold_to_their_schemas.sh COMMAND FOLDER_OF_SCHEMAS FOLDER_TO_WORK_IN
set -euo pipefail
command=$1 schemas=$2 here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
rm -rf "$3" && mkdir -p "$3" && cd "$3"
"$command" compare article_bullet lift_up sensor_gate one_way_drop characters_head_on turning_arm uneven_lift \
  closing_ceiling --no-timing --quiet --trace t --rows all.json
"$command" compare technique_gallery stack_10 --steps 60 --no-timing --quiet --rows gallery.json
"$command" compare article_bullet --quiet --rows timed.jsonl
"$command" compare flush_tiles --mode lockstep --no-timing --quiet --rows lockstep.jsonl
"$command" study disagreement flush_tiles jump_into_wall --quiet --rows disagreement.jsonl
"$command" sweep paper --vary speed=10,100 --knob unit=0.01 --quiet --rows sweep.jsonl
"$command" sweep paper --find-border speed --contender mask --quiet --rows border.jsonl
"$command" work-precision flight --contender mask,box2d --quiet --rows work.jsonl
# A study of minutes: it ends when nobody reads on after the first rows.
mkfifo endless.jsonl
head -n 3 endless.jsonl >stability.jsonl &
exec 3>endless.jsonl  # until it reads: a pipe without a reader is replaced by a file
"$command" stability --grid quick --contender octagon_sweep --quiet --rows endless.jsonl || [[ $? -eq 141 ]]
exec 3>&-
wait
rm endless.jsonl
grep -q '"drift_ok":' stability.jsonl
exec python3 -B "$here/check_schemas.py" "$schemas" ./*.json ./*.jsonl
