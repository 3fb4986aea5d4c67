#!/usr/bin/env bash
# Runs the peers of this folder beside octagon_sweep and Box2D's twin: `paperproof study field`, one table of them all.
#   compare/peers/run.sh                     all peers, the study
#   compare/peers/run.sh SCENE… [OPTION…]    `paperproof compare` with all peers and what you name instead
#   compare/peers/run.sh holes               where each of them has a hole, as a table (holes.py)
# First it installs what is missing: the packages of package.json into build/peers, Node where there is none, libchipmunk and
# Godot's server; and it builds the command. Its maps are those of Debian's supertux-data, where that is installed. The rows are
# in build/release/peers/rows.jsonl, the page is report.html beside them.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=compare/packages.sh
source "$here/compare/packages.sh"
cd "$here"

out=build/release/peers
mkdir -p "$out"
log=$out/run.log
# One after the other: in a list before `||` a failure ends nothing. The first in a shell of its own, as it exits.
{
  (install_missing "${build_packages[@]}" "${peer_packages[@]}") &&
    install_peers &&
    cmake -S . --preset release "${whole_build[@]}" &&
    cmake --build build/release --target paperproof --parallel "$(build_jobs)" &&
    g++ -std=c++20 -O2 compare/peers/chipmunk.cpp -lchipmunk -o "$out/chipmunk"
} >"$log" 2>&1 || {
  tail -n 40 "$log" >&2
  exit 2
}

node="node compare/peers"
peers=(
  "rapier=$node/rapier.mjs"
  "rapier_snap=$node/rapier.mjs snap"
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
options=(--rows "$out/rows.jsonl" --report "$out/report.html")
for peer in "${peers[@]}"; do options+=(--peer "$peer"); done
paperproof=build/release/bin/paperproof
[[ ${1-} != holes ]] || exec python3 compare/peers/holes.py "$paperproof" "${peers[@]}"
if (($#)); then
  # Times are the peers' own; those of the others, by a clock of another kind, are not measured here.
  "$paperproof" compare "$@" --contender octagon_sweep --no-timing "${options[@]}"
else
  "$paperproof" study field "${options[@]}"
fi
