#!/usr/bin/env python3
"""Exported questions: their answers are those of plain fractions, CSV says the same, and the scorer sees what is wrong.

octagon_sweep misses none of them. Box2D misses none that begins clear of its tolerance, and Rapier, which has none, few. Peers
that are not installed are not asked.

usage: queries_test.py COMMAND PROJECT FOLDER_TO_WORK_IN
"""
import csv
import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path

from judging import call, read

command, project, folder = os.path.abspath(sys.argv[1]), sys.argv[2], sys.argv[3]
programs = os.path.dirname(command)
os.makedirs(folder, exist_ok=True)
os.chdir(folder)
for name in ("q.jsonl", "q.csv"):
    subprocess.run([command, "export", "queries", "--count", "600", name], check=True)
queries = read("q.jsonl")
with open("q.csv", newline="", encoding="utf-8") as file:
    for query, row in zip(queries, csv.DictReader(file, strict=True), strict=True):
        for key, value in query.items():
            cell = row[key]
            assert (json.loads(cell) if isinstance(value, (list, bool, int)) else cell or None) == value, (key, cell)

met = [query for query in queries if query["contact"] and not query["degenerate"]]
free = [query for query in queries if not query["contact"] and not query["degenerate"]]
assert len(queries) == 600 and len(met) > 300 and len(free) > 200 and 600 - len(met) - len(free) > 6, (len(met), len(free))
assert {query["source"].split("/")[0] for query in queries} >= {"static", "play", "tight", "lines"}
assert all(0 < math.hypot(*query["displacement"]) <= 1000 for query in queries)
assert len({str([query["position"], query["displacement"], query["solids"]]) for query in queries}) == 600, "asked twice"
subprocess.run([command, "export", "queries", "--count", "200", "more.jsonl", "flush_tiles"], check=True)
assert {query["source"].split()[0] for query in read("more.jsonl")} >= {"play/kerbs_at_60", "scene/flush_tiles"}
columns = ["answered", "missed", "missed_beyond", "begun_clear", "early", "early_beyond"]


def answers_of(*program):
    return subprocess.check_output([*program, "q.jsonl"], text=True)


def score(answers):
    """The scorer's status, and for each class of questions what it counts."""
    Path("a.jsonl").write_text(answers, encoding="utf-8")
    status, said, _ = call(sys.executable, project + "/compare/queries/score.py", "q.jsonl", "a.jsonl")
    rows = [line.split(" | ") for line in said.splitlines()[2:]]
    return status, {row[2]: dict(zip(columns, map(int, row[3:9]))) for row in rows}


def with_change(change, method=()):
    answers = [json.loads(line) for line in exact.splitlines()]
    change(answers)
    return score("".join(json.dumps(line) + "\n" for line in [dict(method), *answers]))


exact = answers_of(sys.executable, project + "/compare/queries/exact.py")
right = {"missed": 0, "missed_beyond": 0, "begun_clear": 0, "early": 0, "early_beyond": 0}
code, counted = score(exact)
assert code == 0 and counted["positive"] == {"answered": len(met), **right}, counted
assert counted["negative"] == {"answered": len(free), **right}, counted
farthest = max(met, key=lambda query: math.hypot(*query["displacement"]))
some, length = farthest["id"], math.hypot(*farthest["displacement"])
for column, value in (("missed", None), ("missed", 2), ("early", -2)):
    code, counted = with_change(lambda answers: answers[some].update(contact=value))
    assert counted["positive"][column] == 1 and code == (column == "missed"), (column, counted)
code, counted = with_change(lambda answers: answers[free[0]["id"]].update(contact=0.5))
assert counted["negative"]["early"] == 1 and code == 0, counted
assert with_change(lambda answers: answers.pop(some))[0] == 1, "an answer that is not there"
code, counted = score("")
assert code == 1 and not any(kind["answered"] for kind in counted.values()), "no answer at all"
for off, column in ((1e-3, "missed"), (-1e-3, "early")):
    for tolerance, beyond in ((2e-3, 0), (5e-4, 1)):
        counted = with_change(lambda answers: answers[some].update(contact=answers[some]["contact"] + off / length),
                              {"tolerance": tolerance})[1]["positive"]
        assert (counted[column], counted[column + "_beyond"]) == (1, beyond), (off, tolerance, counted)

for scalar in ("double", "float"):
    code, counted = score(answers_of(programs + "/queries_sweep", scalar))
    assert code == 0 and all(kind["missed_beyond"] == 0 for kind in counted.values()), (scalar, counted)
    assert scalar == "float" or all(kind["missed"] == kind["early_beyond"] == 0 for kind in counted.values()), counted
peers = {"b2TimeOfImpact": [programs + "/queries_box2d24", "impact"], "b2ShapeCast": [programs + "/queries_box2d24", "cast"]}
for name in ("box2d3", "rapier"):
    peers[name] = ["node", f"{project}/compare/queries/{name}.mjs"]
    if not shutil.which("node") or call(*peers[name], "/dev/null")[0]:
        print(name, "is not installed: not asked")
        del peers[name]
for name, program in peers.items():
    code, counted = score(answers_of(*program))
    assert sum(kind["answered"] for kind in counted.values()) == 600, (name, counted)
    assert counted["positive"]["begun_clear"] <= (3 if name == "rapier" else 0), (name, counted)
