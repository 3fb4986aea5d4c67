#!/usr/bin/env python3
"""The table in controller/README.md is that of its figures, and the committed pictures are what the command writes today: the same
bytes where this machine's matplotlib drew them, else the same words. Of the one with times the words and the curves are.

usage: committed_pictures.py COMMAND REPOSITORY FOLDER_TO_WORK_IN    (exit status 77: skipped, with the reason)
"""
import importlib.util
import os
import re
import shlex
import subprocess
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

STRIP, TIMED = "article_bullet", "level"
OF_ROWS = {
    "a-tip-between-two-points": "study corner --contender speculative_march,box2d,octagon_sweep",
    "Where-does-drop-hold": "sweep drop --vary gravity=10,100,1e3,1e4,1e5,1e6 --vary dt=1e-4,1e-3,0.01,0.1,1 "
                            "--contender octagon_sweep,box2d"}
LONG = {  # ten seconds of a core, and a minute
    TIMED: "work-precision level",
    "Where-do-bullets-pass": "study bullet --contender penetration_resolution,wind_back,box2d,octagon_sweep"}
SVG = "{http://www.w3.org/2000/svg}"


def facts(path):
    """What is said in words, and over how many points each curve goes."""
    root = xml.parse(path).getroot()
    words = ["".join(text.itertext()).strip() for text in root.iter(f"{SVG}text")]
    points = {group.get("id"): len(list(group.iter(f"{SVG}use"))) for group in root.iter(f"{SVG}g")
              if group.get("id", "").startswith("curve-")}
    return [one for one in words if re.search("[a-z]{2}", one)], points


def same(name, committed, written):
    if committed.read_bytes() == written.read_bytes():
        return True
    drawn_by = {re.search(r"Matplotlib v[\d.]*", path.read_text(encoding="utf-8"))[0] for path in (committed, written)}
    return (name == TIMED or len(drawn_by) == 2) and facts(committed) == facts(written)


def main(command, repository, folder):
    committed, folder, benchmarks = Path(repository, "compare/report/pictures"), Path(folder), Path(repository, "compare/benchmarks")
    folder.mkdir(parents=True, exist_ok=True)
    tables = subprocess.check_output([benchmarks / "table.py", benchmarks / "table.json"], text=True).strip().split("\n\n")
    for table, readme in zip(tables, ("controller/README.md", "box2d_adapter/README.md"), strict=True):
        if table not in Path(repository, readme).read_text(encoding="utf-8"):
            sys.exit(f"{readme} has not this table:\n{table}")
    subprocess.run([command, "compare", STRIP, "--no-timing", "--quiet", "--strip", folder / f"{STRIP}.svg"], check=True)
    xml.parse(folder / f"{STRIP}.svg")
    if (committed / f"{STRIP}.svg").read_bytes() != (folder / f"{STRIP}.svg").read_bytes():
        sys.exit(f"write it anew: paperproof compare {STRIP} --no-timing --strip compare/report/pictures/{STRIP}.svg")
    if not importlib.util.find_spec("matplotlib"):
        print("skipped: there is no matplotlib here, which draws the other pictures")
        sys.exit(77)
    pictures = {**OF_ROWS, **(LONG if os.environ.get("PAPERPROOF_LONG_TESTS") == "1" else {})}
    sources = {"table": benchmarks / "table.json", "field": Path(repository, "compare/peers/field.json")}
    for name, arguments in pictures.items():
        sources[name] = folder / f"{name}.jsonl"
        subprocess.run([command, *shlex.split(arguments), "--quiet", "--rows", sources[name]], check=True)
    subprocess.run([sys.executable, Path(repository, "compare/plots.py"), *sources.values(), "--out", folder], check=True,
                   stdout=subprocess.DEVNULL)
    others = [name for name in sources if not same(name, committed / f"{name}.svg", folder / f"{name}.svg")]
    for name in others:
        rows = f"paperproof {pictures[name]} --rows ROWS.jsonl; " if name in pictures else ""
        print(f"write it anew: {rows}compare/plots.py {'ROWS.jsonl' if rows else sources[name]} --out DIR; "
              f"take DIR/{name}.svg")
    sys.exit(bool(others))


if __name__ == "__main__":
    main(*sys.argv[1:])
