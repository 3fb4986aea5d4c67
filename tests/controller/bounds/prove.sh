#!/usr/bin/env bash
# Proves with Gappa that rounding stays below a bound, and that the model can fail: a smaller bound has no proof.
#   prove.sh MODEL.gappa ROOT
# Lines of the model link it to the project:
#   #in FILE: TEXT                  FILE below ROOT has TEXT: what is modelled, and each figure
#   #prove FIGURE FAR not SMALLER   coordinates are at most FAR; FIGURE is proved, SMALLER is not
# Gappa is silent where it proves all. (A warning may mean that it believed a step.) Where hypotheses contradict each
# other SMALLER is proved as well. It splits no cases but those that the model names: in vain that takes seconds.
# 77: skipped, as there is no Gappa.
set -euo pipefail
model=$1 root=$2
command -v gappa > /dev/null || { echo "gappa is not installed" && exit 77; }
fail() { echo "$model: $*"; exit 1; }
links=$(sed -n 's/^#in //p' "$model")
while IFS= read -r link; do
  grep --quiet --fixed-strings -e "${link#*: }" "$root/${link%%: *}" || fail "this is no more there: $link"
done <<< "$links"
prove() { sed "s/FIGURE/$1/g; s/FAR/$2/g" "$model" | gappa -Eno-auto-dichotomy 2>&1 || echo "exit status $?"; }
while read -r figure far _ smaller; do
  [[ $links == *"$figure"* && $links == *"$far"* ]] || fail "no link has $figure, or none has $far"
  said="$(prove "$figure" "$far")|$(prove "$smaller" "$far")"
  [[ $said == "|"*"not satisfied"*"exit status 1" ]] || fail "$figure should be proved, $smaller should not: $said"
  echo "up to $far: $figure is proved, $smaller is not; $(grep --only-matching "best: .*" <<< "$said")"
done <<< "$(sed -n 's/^#prove //p' "$model")"
