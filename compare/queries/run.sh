#!/usr/bin/env bash
# Asks every method of this folder the same questions, and prints one table.
#   compare/queries/run.sh [COUNT]     100,000 of them where no number is given: five minutes
# They come from all random runs, and from levels of SuperTux (Debian's supertux-data) where those are installed. Run
# compare/peers/run.sh before: it installs what is missing, the engines of npm too, and configures. Questions and answers
# stay in build/release/queries; wrong.txt has what a method misses beyond its tolerance.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/../.."
out=build/release/queries
mkdir -p "$out"
cmake --build build/release --target paperproof queries_sweep queries_box2d24 >"$out/build.log" || {
  tail -n 40 "$out/build.log" >&2
  exit 2
}

shopt -s nullglob # a level that is not there is none: each name is a pattern
levels=(/usr/share/games/supertux2/levels/world1/{welcome_antarctica,frosted_fields,icy_valley,night_chill,stone_cold}.st[l])
questions=$out/questions.jsonl
build/release/bin/paperproof export queries --count "${1:-100000}" "$questions" "${levels[@]}"

answers=()
answer() { # NAME COMMAND…
  answers+=("$out/$1.jsonl")
  "${@:2}" "$questions" >"$out/$1.jsonl"
}
answer sweep_double build/release/bin/queries_sweep double
answer sweep_float build/release/bin/queries_sweep float
answer box2d24_impact build/release/bin/queries_box2d24 impact
answer box2d24_cast build/release/bin/queries_box2d24 cast
for peer in box2d3 rapier; do
  if node "compare/queries/$peer.mjs" /dev/null &>/dev/null; then
    answer "$peer" node "compare/queries/$peer.mjs"
  else
    echo "left out: $peer.mjs; compare/peers/run.sh installs what it needs" >&2
  fi
done
python3 -B compare/queries/score.py "$questions" "${answers[@]}" 2>"$out/wrong.txt" || true
