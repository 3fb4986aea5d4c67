#!/usr/bin/env bash
# The table in controller/README.md is that of the committed figures.
#   committed_table.sh REPOSITORY FOLDER_TO_WORK_IN
set -euo pipefail
repository=$1 written=$2
mkdir -p "$written"
"$repository/compare/benchmarks/table.py" "$repository/compare/benchmarks/table.json" > "$written/table.md"
while read -r line; do
  grep -qxF -- "$line" "$repository/controller/README.md" || { echo "controller/README.md has no line: $line" && exit 1; }
done < "$written/table.md"
