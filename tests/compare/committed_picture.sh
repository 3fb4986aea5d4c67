#!/usr/bin/env bash
# The picture on the README's first screen is the one that the command writes today.
#   committed_picture.sh COMMAND FOLDER_OF_PICTURES FOLDER_TO_WORK_IN
set -euo pipefail
rm -rf "$3"
"$1" compare article_bullet --no-timing --quiet --svg "$3"
cmp "$2/article_bullet.svg" "$3/article_bullet.svg" || {
  echo "write it anew: paperproof compare article_bullet --no-timing --quiet --svg compare/report/pictures"
  exit 1
}
python3 -c 'import sys, xml.dom.minidom as dom; dom.parse(sys.argv[1])' "$3/article_bullet.svg"
