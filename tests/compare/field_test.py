#!/usr/bin/env python3
"""`study field` with two peers of these tests, on every seventh case: what it says of them, and what they say of themselves.

usage: field_test.py PAPERPROOF SOURCE_DIR EMPTY_DIR"""
import base64
import gzip
import json
import pathlib
import re
import shutil
import subprocess
import sys

paperproof, source, place = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
shutil.rmtree(place, ignore_errors=True)
place.mkdir(parents=True)
ghost = f"python3 {source}/tests/compare/ghost.py"
done = subprocess.run([paperproof, "study", "field", "--peer", f"ghost={ghost}", "--peer", f"liar={ghost} lies", "--shard", "1/7",
                       "--rows", "r.jsonl", "--report", "p.html"], cwd=place, capture_output=True, text=True, check=True)
rows = [json.loads(line) for line in (place / "r.jsonl").read_text().splitlines()[1:]]
assert {row["contender"] for row in rows} == {"octagon_sweep", "box2d", "ghost", "liar"}
assert {row["verdict"] for row in rows if "badness" not in row} == {"not_applicable"}
rows = [row for row in rows if "badness" in row]
hanging_of = lambda row: row["hanging_steps"] - (0 if row["contender"] == "octagon_sweep" else row.get("hanging_by_law", 0))
for row in rows:
    unsafe, passes = row["badness"] >= 1, row["tunnels"] or row.get("one_way_violations")
    assert unsafe == bool(passes or row["max_penetration_m"] > row.get("skin_m", 0.02) or hanging_of(row)), row
    assert (row["badness"] >= 3) == bool(passes) == row["worst"].startswith("through"), row
    assert row["contender"] != "octagon_sweep" or (row["worst"], row["badness"]) == ("holds", 0), row
passages = sorted((row["first_tunnel"]["speed_m_s"], -row["badness"], row["worst"]) for row in rows if row["tunnels"])
assert len(passages) > 3 and [bad for _, bad, _ in passages] == sorted(bad for _, bad, _ in passages), "the slowest is the worst"
for speed, _, words in passages:
    assert abs(float(re.match(r"through at (\S+) m/s", words)[1]) - speed) <= 0.05 * speed, words

page = (place / "p.html").read_text()
element = lambda name: json.loads(re.search(rf'id="{name}"[^>]*>(.*?)</script>', page, re.S)[1])
study, = element("index")["studies"]
grid, replays = study["grids"][0], element("cells-0")
assert len(grid["ys"]) == 4 and len(grid["labels"]) == 4
by_place = {}
for row in rows:
    by_place.setdefault((row["contender"], row["swept"]["question"].removeprefix("field: ")), []).append(row)
for y, who in enumerate(grid["ys"]):
    for x, group in enumerate(grid["xs"]):
        some, (label, gravity) = by_place.get((who, group)), grid["labels"][y][x]
        if not some:
            assert label == "-"
            continue
        worst = max(some, key=lambda row: row["badness"])
        bad = sum(row["badness"] > 0 for row in some)
        assert label.startswith(worst["worst"]) and gravity == (2 if worst["badness"] >= 1 else bad > 0), label
        assert grid["cells"][y][x][:2] == [bad, len(some)]
        shown = gzip.decompress(base64.b64decode(replays[grid["cells"][y][x][4]]["replay"])).decode()
        ran = set(re.findall(r'"contender":"(\w+)"', shown))
        assert ran == {who, "octagon_sweep"}, (who, group, ran)
tables = {table["title"]: table for table in study["tables"]}
largest = tables["The largest of each metric"]
for line in (dict(zip(largest["heading"], each)) for each in largest["rows"]):
    most = max(hanging_of(row) for row in rows if row["contender"] == line["contender"])
    assert abs(float(line["hanging [steps]"]) - most) <= 0.05 * most, (line, most)
costs = tables["The cost of the guarantee"]
costs = {line[0]: dict(zip(costs["heading"], line)) for line in costs["rows"]}
assert int(costs["octagon_sweep"]["lines of code"]) > 1000
assert costs["ghost"]["ns, script"] == "700", "it walks over tiles in this shard"
checks = tables["What the engines' own queries say of it, at the recorded places"]
for who, word in (("ghost", "yes"), ("liar", "no")):
    own = [dict(zip(checks["heading"], line)) for line in checks["rows"] if line[0] == who]
    assert len(own) == 3 and {check["confirmed"] for check in own} == {word}, own
assert "through at" in done.stdout and "not stated" in done.stdout

# What a body without friction stays at its exact law stays at, too: key and gravity are in balance there.
balance = subprocess.run([paperproof, "compare", "ledge_corner", "--contender", "octagon_sweep", "--no-timing", "--json"],
                         capture_output=True, text=True, check=True)
ours, reference = json.loads(balance.stdout)["rows"]
assert reference["contender"] == "box2d" and reference["hanging_steps"] == reference["hanging_by_law"] == 90, reference
assert ours["hanging_steps"] == 0 and "hanging_by_law" not in ours, ours
