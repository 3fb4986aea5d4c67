#!/usr/bin/env bash
# Installs what is missing, builds the command and runs the main comparison: the article's techniques side by side with
# Box2D.
#   compare/run.sh                     the main comparison
#   compare/run.sh SCENE… [OPTION…]    `paperproof compare` with what you name instead
# Both write report.html and rows.json into the project's folder, unless --report or --rows name another place.
# What the command prints goes to stdout, everything else to stderr. The exit status is the command's; 2 also means that
# it could not be built.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=cmake/packages.sh
source "$here/cmake/packages.sh"

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

build_command() {
  install_missing "${build_packages[@]}" &&
    cmake -S "$here" --preset release "${whole_build[@]}" &&
    cmake --build "$here/build/release" --target paperproof --parallel "$(build_jobs)"
}
build_command >&2 || exit 2

arguments=("$@")
((${#arguments[@]})) || arguments=("${main_comparison[@]}")
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
"$here/build/release/bin/paperproof" compare "${arguments[@]}" || status=$?
for output in "${outputs[@]}"; do
  if [[ $output -nt $started ]]; then echo "written: $output" >&2; fi
done
exit "$status"
