#!/usr/bin/env bash
# Runs the peers of this folder beside octagon_sweep and Box2D's twin, over one scene for each thing that they differ in.
#   compare/peers/run.sh                     all peers, the scenes below
#   compare/peers/run.sh SCENE… [OPTION…]    `paperproof compare` with all peers and what you name instead
#   compare/peers/run.sh holes               where each of them has a hole, as a table (holes.py)
# First it installs what is missing: the packages of package.json into build/peers, Node where there is none, libchipmunk and
# Godot's server; and it builds the command. Three to four minutes. The rows are in build/release/peers/rows.jsonl, the page is
# report.html beside them.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=compare/packages.sh
source "$here/compare/packages.sh"
cd "$here"

scenes=(
  article_bullet        # the article's: who is continuous, and who is not
  paper_1e-3            # paper of a millimetre at 40 m/s
  zero_thickness_paper  # and of none
  flush_tiles           # who snags at seams
  skier_no_snap         # a valley of two slopes
  climb45_3m            # a slope of the limit, and the edge at its top
  low_step              # a step of 30 cm is a wall
  ledge_corner          # the corner of a ledge
  wedge_60              # two slopes at once
  lift_up               # who is carried, up and down again
  lift_sideways         # and to the side
  sweeping_paper        # paper that moves at 20 m/s
  rest                  # a drop, and rest
  oneway_hill           # a one-way hill: who is held by each of its segments
)
# And a course of slopes, kerbs, a needle and one-way ledges.
course=(playground --set steps=1000)

out=build/release/peers
mkdir -p "$out"
log=$out/run.log
{
  install_missing "${build_packages[@]}" "${peer_packages[@]}"
  install_peers
  cmake -S . --preset release "${whole_build[@]}"
  cmake --build build/release --target paperproof --parallel "$(build_jobs)"
  g++ -std=c++20 -O2 compare/peers/chipmunk.cpp -lchipmunk -o "$out/chipmunk"
} >"$log" 2>&1 || {
  tail -n 40 "$log" >&2
  exit 2
}

node="node compare/peers"
peers=(
  "rapier=$node/rapier.mjs"
  "rapier_no_ccd=$node/rapier.mjs body_no_ccd"
  "rapier_body=$node/rapier.mjs body"
  "rapier_ccd=$node/rapier.mjs body_ccd"
  "box2d3_mover=$node/box2d3.mjs mover"
  "box2d3_body=$node/box2d3.mjs"
  "box2d3_bullet=$node/box2d3.mjs bullet"
  "box2d24=$node/box2d24.mjs"
  "planck=$node/planck.mjs"
  "planck_bullet=$node/planck.mjs bullet"
  "matter=$node/matter.mjs"
  "chipmunk=$out/chipmunk"
  "godot=python3 compare/peers/godot.py"
  "godot_snap=python3 compare/peers/godot.py snap"
)
# Times are the peers' own; those of the others, by a clock of another kind, are not measured here.
options=(--contender octagon_sweep --no-timing)
for peer in "${peers[@]}"; do options+=(--peer "$peer"); done
[[ ${1-} != holes ]] || exec python3 compare/peers/holes.py build/release/bin/paperproof "${peers[@]}"
paperproof=build/release/bin/paperproof
if (($#)); then
  "$paperproof" compare "$@" "${options[@]}" --rows "$out/rows.jsonl" --report "$out/report.html"
  exit
fi
"$paperproof" compare "${scenes[@]}" "${options[@]}" --rows "$out/scenes.jsonl" --report "$out/scenes.html"
"$paperproof" compare "${course[@]}" "${options[@]}" --rows "$out/course.jsonl" --report "$out/course.html"
"$paperproof" merge "$out/scenes.jsonl" "$out/course.jsonl" --rows "$out/rows.jsonl"
"$paperproof" report "$out/report.html" "$out/scenes.html" "$out/course.html"
