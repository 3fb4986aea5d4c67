#!/usr/bin/env bash
# The committed pictures are the ones that the command writes today. Of the one with times, which differ from run to run,
# the curves are: who has one, over how many points, with which slope.
#   committed_picture.sh COMMAND FOLDER_OF_PICTURES FOLDER_TO_WORK_IN
set -euo pipefail
command=$1 committed=$2 written=$3
rm -rf "$written"

# picture NAME ARGUMENTS...: writes it anew.
picture() {
  local name=$1
  shift
  "$command" "$@" --quiet --svg "$written"
  python3 -c 'import sys, xml.dom.minidom as dom; dom.parse(sys.argv[1])' "$written/$name.svg"
  [ "$(stat -c %s "$written/$name.svg")" -le 40000 ] || { echo "$name.svg is larger than 40 KB" && exit 1; }
}
# same NAME ARGUMENTS...
same() {
  picture "$@"
  cmp "$committed/$1.svg" "$written/$1.svg" || differs "$@"
}
differs() {
  local name=$1
  shift
  echo "write it anew: paperproof $* --quiet --svg DIR, and take DIR/$name.svg"
  exit 1
}
curves_of() {
  python3 - "$1" <<'END'
import re, sys
text = open(sys.argv[1], encoding="utf-8").read()
print(re.findall("<title>.*?</title>", text), re.findall('text-anchor="start" class="t">(.*?)<', text))
print([(ink, points.count(",")) for points, ink in re.findall('<polyline points="(.*?)" class="curve (.*?)"', text)])
END
}
# curves NAME ARGUMENTS...
curves() {
  picture "$@"
  [ "$(curves_of "$committed/$1.svg")" = "$(curves_of "$written/$1.svg")" ] || differs "$@"
}

same article_bullet compare article_bullet --no-timing
# A minute of a core.
[ "${PAPERPROOF_LONG_TESTS-}" != 1 ] || same Where-do-bullets-pass study bullet --contender penetration_resolution,wind_back,box2d,octagon_sweep
same a-tip-between-two-points study corner --contender speculative_march,box2d,octagon_sweep
same sweep-of-drop sweep drop --vary gravity=10,100,1e3,1e4,1e5,1e6 --vary dt=1e-4,1e-3,0.01,0.1,1 --contender octagon_sweep,box2d
curves level work-precision level
