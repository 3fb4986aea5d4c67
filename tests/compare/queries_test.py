#!/usr/bin/env python3
"""Exported questions: their answers are those of plain fractions, CSV says the same, and the scorer sees what is wrong.

usage: queries_test.py COMMAND PROJECT FOLDER_TO_WORK_IN
"""
import csv
import json
import os
import subprocess
import sys

command, project, folder = os.path.abspath(sys.argv[1]), sys.argv[2], sys.argv[3]
os.makedirs(folder, exist_ok=True)
os.chdir(folder)
for name in ("q.jsonl", "q.csv"):
    subprocess.run([command, "export", "queries", "--count", "600", name], check=True)
with open("q.jsonl", encoding="utf-8") as file:
    queries = [json.loads(line) for line in file]
with open("q.csv", newline="", encoding="utf-8") as file:
    for query, row in zip(queries, csv.DictReader(file, strict=True), strict=True):
        for key, value in query.items():
            cell = row[key]
            assert (json.loads(cell) if isinstance(value, (list, bool, int)) else cell or None) == value, (key, cell)

met = [query for query in queries if query["contact"] and not query["degenerate"]]
free = [query for query in queries if not query["contact"] and not query["degenerate"]]
assert len(queries) == 600 and min(len(met), len(free)) > 150 and len(met) + len(free) < 600, (len(met), len(free))
assert {query["source"].split("/")[0] for query in queries} >= {"static", "play", "tight", "lines"}


def status(change=lambda answers: None):
    """Of the scorer, with some of the exact answers changed, and what it prints."""
    answers = [json.loads(line) for line in exact.splitlines()]
    change(answers)
    with open("a.jsonl", "w", encoding="utf-8") as out:
        out.writelines(json.dumps(answer) + "\n" for answer in answers)
    scored = subprocess.run([sys.executable, project + "/compare/queries/score.py", "q.jsonl", "a.jsonl"],
                            capture_output=True, text=True, check=False)
    return scored.returncode, scored.stdout.splitlines()[1].split()[3:9]


exact = subprocess.run([sys.executable, project + "/compare/queries/exact.py", "q.jsonl"], check=True,
                       capture_output=True, text=True).stdout
judged = str(len(met) + len(free))
assert status() == (0, [judged, "0", "0", "0", "0", "0"]), status()
some = max(met, key=lambda query: sum(map(abs, query["displacement"])))["id"]
for column, value in (("missed", None), ("late", 2), ("early", -2)):
    code, cells = status(lambda answers: answers[some].update(contact=value))
    assert cells[{"missed": 1, "late": 2, "early": 4}[column]] == "1" and code == (column != "early"), (column, cells)
code, cells = status(lambda answers: answers[free[0]["id"]].update(contact=0.5))
assert cells[3] == "1" and code == 0, cells
assert status(lambda answers: answers.pop(some))[0] == 1, "an answer that is not there"
