#!/usr/bin/env bash
# Opens the sample report in a headless Chromium and checks that every scene draws without an error.
# usage: report_in_browser.sh WRITE_SAMPLE_REPORT    (exit status 77: skipped, with the reason)
set -u
writer=$1

browser=""
for name in chromium chromium-browser google-chrome; do
  if command -v "$name" >/dev/null 2>&1; then browser=$name; break; fi
done
if [ -z "$browser" ]; then
  echo "skipped: no chromium is installed, so the page cannot be opened (Debian: apt install chromium)"
  exit 77
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$writer" "$folder/report.html" || exit 1

# Prints the document as it stands after its scripts have run. A browser that does not come up is asked once more: what
# the page does wrong shows in the document, not in the browser's exit status.
open_page() {
  local attempt
  for attempt in 1 2; do
    timeout 120 "$browser" --headless --no-sandbox --disable-gpu --no-first-run --disable-background-networking \
      --disable-component-update --disable-sync --disable-extensions --disable-dev-shm-usage \
      --user-data-dir="$folder/profile$attempt" --window-size=1280,900 --virtual-time-budget=3000 \
      --dump-dom "file://$folder/report.html$1" 2>"$folder/stderr" >"$folder/dom" && return
  done
  echo "the browser failed on $1:"
  tail -n 5 "$folder/stderr"
  exit 1
}

failures=0
fail() { echo "FAILED at $1: $2"; failures=$((failures + 1)); }

# check ADDRESS WHAT_WAS_DRAWN
check() {
  open_page "$1"
  head -c 2000 "$folder/dom" >"$folder/head"
  grep -q 'data-error=' "$folder/head" && fail "$1" "the page reports an error: $(grep -o 'data-error="[^"]*"' "$folder/head")"
  grep -qF "data-drawn=\"$2\"" "$folder/head" || fail "$1" "expected data-drawn=\"$2\", found: $(grep -o 'data-drawn="[^"]*"' "$folder/head")"
  case $1 in
    *check=1*)
      colours=$(sed -n 's/.*data-colours="\([0-9]*\)".*/\1/p' "$folder/head" | head -n 1)
      # Background, solids, outlines and at least one contender, each with its anti-aliased shades.
      [ "${colours:-0}" -ge 8 ] || fail "$1" "the canvas has ${colours:-no} colours: nothing was drawn" ;;
  esac
}

# wants TEXT: the text stands in the document that was opened last, outside of its data.
wants() {
  sed 's/<script[^>]*>.*<\/script>//' "$folder/dom" | grep -qF -- "$1" || fail "the last page" "it does not show: $1"
}

# Percent-encoded: the name of the scene whose texts try to break out of the page.
hostile="%3C%2Fscript%3E%3Cscript%3Ethrow%201%3C%2Fscript%3E%3C!--%20%26%20%22%20'%20%5D%5D%3E"

# sees Y HEIGHT: the view holds the height Y [m], and is no higher than HEIGHT [m].
sees() {
  sed -n 's/.*data-seen="\([^"]*\)".*/\1/p' "$folder/head" | head -n 1 |
    awk -v y="$1" -v most="$2" '{ ok = NF == 4 && $2 < y && y < $4 && $4 - $2 <= most } END { exit !ok }' ||
    fail "the last page" "expected a view of $1 and no higher than $2 m: $(grep -o 'data-seen="[^"]*"' "$folder/head")"
}

# click WORDS: from now on the page is one in which a button is clicked as soon as it is there.
click() {
  cat >>"$folder/report.html" <<END
<script>
[...document.querySelectorAll("button")].find((button) => button.textContent === "$1").click();
</script>
END
}

check "" "summary"
wants "penetration_resolution"
wants "Held in every scene it ran in: octagon_sweep"
check "#scene=bullet&step=2&view=fit&check=1" "scene 0 step 2 t 1"
wants "tunnel: through paper at 120 m/s"
check "#scene=bullet&step=2&t=0.25&view=follow&check=1" "scene 0 step 2 t 0.25"
check "#scene=walk&step=150&layout=side&check=1" "scene 1 step 150 t 1"
wants "bottom, tile_9"
wants "Not run: grid (A grid cannot hold a slope)."
check "#scene=$hostile&step=40&check=1" "scene 2 step 40 t 1"
wants "octagon_sweep is right"
wants "&lt;/script&gt;&lt;script&gt;throw 1&lt;/script&gt;"
check "#scene=lift&step=75&check=1" "scene 3 step 75 t 1"
wants "crushed by lift"
wants "octagon_sweep: first crush"
check "#scene=lift&step=25&t=0.25&check=1" "scene 3 step 25 t 0.25"
wants "sensor: enters zone at 0.25 of the step"
check "#scene=pair&step=20&check=1" "scene 4 step 20 t 1"
wants "octagon_sweep, character 1"
wants "bottom, character 0"
wants "octagon_sweep: first corner cut"
check "#scene=uneven&step=1&check=1" "scene 5 step 1 t 1"
wants "step 1 of 1, t = 1.000: 100.016 s"
wants "drops through ledge"
wants "octagon_sweep: first drop"
check "#scene=squares&step=7&view=fit&check=1" "scene 6 step 7 t 1"
wants "drawn at 0.8"
wants "in between two squares"
# After half a second of playing it is long through with the first step, and nowhere near the end of the second. How
# often a headless browser draws on its own after that is its affair: what is asked for is half a second and what follows.
open_page "#scene=uneven&step=0&t=0&play=0.5"
head -c 2000 "$folder/dom" | grep -Eq 'data-drawn="scene 5 step 1 t (0\.0|[0-9.]*e-)' ||
  fail "scene 5, played" "not in the second step: $(grep -o 'data-drawn="[^"]*"' "$folder/dom" | head -n 1)"
wants 'aria-label="Pause"'
check "#scene=999" "summary"
check "#scene=0" "summary"  # scenes have names

# Without a step a replay opens at the event that matters, here half-way through the paper: the bullet's way from y = 1 to
# -1 meets it from 0.635 to -0.625. It fills the view, with those beside it who stopped.
check "#scene=bullet&check=1" "scene 0 step 2 t 0.4975"
sees 0.005 2.5
wants "href=\"#scene=bullet\""
check "#scene=bullet&contender=penetration_resolution&check=1" "scene 0 step 2 t 0.4975"
sees 0.005 2.5
check "#scene=bullet&contender=octagon_sweep&check=1" "scene 0 step 2 t 0.1825"
sees 0.01 2.5
check "#scene=lift&check=1" "scene 3 step 75 t 1"
sees 1.5 3.5
check "#scene=squares&check=1" "scene 6 step 0 t 1"

# Jumps move the view, too: from all of the ways to what is touched first, by Box2D with its gap of 15 mm.
click "first contact"
check "#scene=bullet&step=9&view=fit&check=1" "scene 0 step 2 t 0.175"
sees 0.01 2.5


[ "$failures" -eq 0 ] && echo "every page was drawn"
exit "$((failures > 0))"
