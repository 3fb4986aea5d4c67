#!/usr/bin/env bash
# Four shards of a sweep by GNU parallel, merged, are the whole sweep.
#   shards_by_parallel.sh COMMAND FOLDER_TO_WORK_IN
set -euo pipefail
command=$1
command -v parallel >/dev/null || { echo "skipped: there is no GNU parallel here"; exit 77; }
rm -rf "$2" && mkdir -p "$2" && cd "$2"
sweep=(sweep paper --vary speed=1:1e4:log40 --vary phase=0:0.9:lin5 --contender mask,discrete,octagon_sweep --quiet)
"$command" "${sweep[@]}" --rows whole.jsonl
parallel --will-cite "$command" "${sweep[@]}" --shard {}/4 --jobs 1 --rows part{}.jsonl ::: 1 2 3 4
"$command" merge part*.jsonl --rows all.jsonl
cmp <(tail -n +2 whole.jsonl) <(tail -n +2 all.jsonl)
[[ $(wc -l <all.jsonl) == 601 ]]
