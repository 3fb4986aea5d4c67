#!/usr/bin/env bash
# Installs what is missing, builds the command and runs the main comparison: the article's techniques side by side with
# Box2D, with a study of bullets and paper and one of error against run time.
#   compare/run.sh                     the main comparison and the two studies
#   compare/run.sh SCENE… [OPTION…]    `paperproof compare` with what you name instead, and no study
# It prints first what becomes of the article's bullet, by technique, and what a step costs; then one table over all scenes.
# --all-tables prints the table of every scene, and the report holds them anyway.
# Both write report.html and rows.json into the project's folder, unless --report or --rows name another place. The rows
# of the studies are in build/release/study.
# What the command prints goes to stdout, everything else to stderr: of setting up and building a line each, the rest into
# build/release/compare_build.log, which is shown where it fails. The exit status is the command's; 2 also means that
# it could not be built.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=compare/packages.sh
source "$here/compare/packages.sh"

# One scene for each thing the comparison shows; `paperproof list scenes` has all of them.
main_comparison=(
  article_bullet        # the article's own: passed without in-between positions, first contact at t = 0.6 with them
  thin_platform         # paper is passed one unit at a time, too, where it is thinner than the unit
  zero_thickness_paper  # and paper of no thickness at all
  spike_between_feet    # eight points miss what stands between them
  sloped_paper_walk     # and are passed sideways by a thin ramp
  flush_tiles           # Box2D's pieces snag where nothing is in the way
  skier                 # the ground is followed downwards
  grazing_wall          # the time of impact of a grazing motion
  wedge_60              # rest between two slopes
  concave_corner        # two contacts at speed
  jump_into_overhang    # the article's rules for jumping
  long_rest             # a million steps at rest: the position's bits do not change
)

mkdir -p "$here/build/release"
log=$here/build/release/compare_build.log
: >"$log"

# Runs a command with its output in the log. Where it fails the end of that says why.
logged() {
  "$@" >>"$log" 2>&1 && return
  echo "failed: $*" >&2
  tail -n 40 "$log" >&2
  echo "the whole log: $log" >&2
  return 1
}

build() {
  local command=(cmake --build "$here/build/release" --target paperproof --parallel "$(build_jobs)")
  # On a terminal ninja shows in one line how far it is.
  if [[ -t 2 ]]; then "${command[@]}" >&2; else logged "${command[@]}"; fi
}

# In a shell of its own, as it exits where nothing can be installed; what it says of that goes to stderr.
(install_missing "${build_packages[@]}" > >(tee -a "$log" | grep --line-buffered '^installing' >&2)) || {
  tail -n 40 "$log" >&2
  exit 2
}
logged cmake -S "$here" --preset release "${whole_build[@]}" || exit 2
if [[ ! -x $here/build/release/bin/paperproof ]]; then echo "building; it takes a few minutes the first time" >&2; fi
build || exit 2

arguments=("$@")
with_studies=
if ((${#arguments[@]} == 0)); then
  arguments=("${main_comparison[@]}")
  with_studies=yes
fi
outputs=()
for output in report.html rows.json; do
  option=--${output%.*}
  if [[ " ${arguments[*]} " != *" $option"[=\ ]* ]]; then
    arguments+=("$option" "$here/$output")
    outputs+=("$here/$output")
  fi
done

started=$here/build/release/compare_started
touch "$started"
status=0
paperproof=$here/build/release/bin/paperproof
"$paperproof" compare "${arguments[@]}" || status=$?

# A study that fails leaves the page of the comparison as it is.
add_studies() {
  local folder=$here/build/release/study
  mkdir -p "$folder"
  "$paperproof" work-precision --rows "$folder/work_precision.jsonl" >"$folder/work_precision.txt" &&
    "$paperproof" study bullet --rows "$folder/bullet.jsonl" --report "$folder/bullet.html" >"$folder/bullet.txt" &&
    "$paperproof" report "$folder/report.html" "$here/report.html" "$folder/work_precision.jsonl" "$folder/bullet.html" &&
    mv "$folder/report.html" "$here/report.html"
}
if [[ $with_studies && $status -le 1 ]]; then add_studies || status=$?; fi
for output in "${outputs[@]}"; do
  if [[ $output -nt $started ]]; then echo "written: $output" >&2; fi
done
exit "$status"
