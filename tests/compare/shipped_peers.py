#!/usr/bin/env python3
"""Every peer that ships runs two scenes with thin solids: a continuous one stops the article's bullet, another lets it
pass. Some peers of each engine run three more scenes; those without seams must hold there. Box2D 2.4 in WebAssembly goes
where the contender `box2d` goes. Skipped (77) where npm's packages are not installed; Godot and Chipmunk
are left out where Debian's are not.

usage: shipped_peers.py PAPERPROOF SOURCE_DIR EMPTY_DIR"""
import json
import pathlib
import shutil
import subprocess
import sys

paperproof, source, place = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
peers = source / "compare/peers"
if not shutil.which("node") or not (source / "build/peers/engine.mjs").exists():
    print("skipped: no node, or no packages in build/peers (compare/peers/run.sh installs them)")
    sys.exit(77)
shutil.rmtree(place, ignore_errors=True)
place.mkdir(parents=True)
stop_the_bullet = {"rapier": "rapier.mjs", "rapier_body": "rapier.mjs body", "rapier_ccd": "rapier.mjs body_ccd",
                   "box2d3": "box2d3.mjs", "box2d3_bullet": "box2d3.mjs bullet", "box2d3_mover": "box2d3.mjs mover",
                   "box2d24": "box2d24.mjs", "planck": "planck.mjs", "planck_bullet": "planck.mjs bullet"}
let_it_pass = {"rapier_no_ccd": "rapier.mjs body_no_ccd", "matter": "matter.mjs"}


def compare(scenes, commands, *options):
    """Rows by scene and contender."""
    args = [option for name, command in commands.items() for option in ("--peer", f"{name}={command}")]
    done = subprocess.run([paperproof, "compare", *scenes, "--json", "--no-timing", "--contender", "box2d", *args, *options],
                          capture_output=True, text=True, cwd=place, check=True)
    return {(row["scene"], row["contender"]): row for row in json.loads(done.stdout)["rows"]}


commands = {name: f"node {peers}/{rest}" for name, rest in {**stop_the_bullet, **let_it_pass}.items()}
if shutil.which("godot3-server"):
    commands |= {name: f"python3 {peers}/godot.py {rest}" for name, rest in (("godot", ""), ("godot_snap", "snap"))}
    stop_the_bullet |= dict.fromkeys(("godot", "godot_snap"))
if subprocess.run(["g++", "-std=c++20", peers / "chipmunk.cpp", "-lchipmunk", "-o", place / "chipmunk"]).returncode == 0:
    commands["chipmunk"] = str(place / "chipmunk")
    let_it_pass["chipmunk"] = ""
thin, feel = ["article_bullet", "paper_1e-3"], ["flush_tiles", "lift_sideways", "one_way_drop"]
without_seams = {"box2d3", "planck", "box2d24", "godot", "godot_snap"} & commands.keys()
rows = compare(thin, {**commands, "straight": f"python3 {peers}/straight.py"})
others = {"rapier", "rapier_body", "box2d3_mover", "matter", "chipmunk"} & commands.keys()
rows |= compare(feel, {name: commands[name] for name in without_seams | others}, "--steps", "150")
for (scene, contender), row in rows.items():
    assert row["verdict"] != "failed", row
    assert row["verdict"] != "not_applicable" or scene == "one_way_drop" and contender in ("matter", "chipmunk"), row
for name in [*let_it_pass, "straight"]:
    assert rows["article_bullet", name]["verdict"] == "tunnels", name
for name in stop_the_bullet:
    assert rows["article_bullet", name]["tunnels"] == 0 == rows["paper_1e-3", name]["tunnels"], name
for name in without_seams:  # and what stands is carried
    assert {rows[scene, name]["verdict"] for scene in feel} == {"holds"}, name
mover = {scene: rows[scene, "box2d3_mover"] for scene in (*thin, *feel)}
assert "answer_ok" not in mover["paper_1e-3"]  # it is a capsule, and said so: the exact way is that of its own shape
assert mover["paper_1e-3"]["error_law_max_m"] < 0.02 and mover["lift_sideways"]["rest_peak_to_peak_m"] < 1e-5
for scene in (*thin, *feel) if "chipmunk" in commands else []:
    assert not rows[scene, "chipmunk"].get("hanging_steps"), "what is wanted comes within its step"

same = ["thin_platform", "flush_tiles", "skier", "low_step", "wedge_60", "lift_up", "lift_sideways", "turning_arm",
        "land_on_circle", "playground"]
compare(same, {"box2d24": commands["box2d24"]}, "--steps", "500", "--trace", "t")
for scene in same:
    ways = [[json.loads(line)["path"][-1] for line in open(place / f"t.{scene}.{name}.float.jsonl") if "requested" in line]
            for name in ("box2d", "box2d24")]
    assert len(ways[0]) == len(ways[1]) == 500, scene
    assert max(abs(a - b) for p, q in zip(*ways) for a, b in zip(p, q)) <= 1e-4, scene
for file in peers.glob("*.mjs"):
    shutil.copy(file, place)
missing = compare(["paper_1e-3"], {"planck": f"node {place}/planck.mjs"})["paper_1e-3", "planck"]
assert missing["verdict"] == "not_applicable" and "run compare/peers/run.sh first" in missing["reason"], missing
