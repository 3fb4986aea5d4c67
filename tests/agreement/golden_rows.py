#!/usr/bin/env python3
"""The rows of nearly all built-in scenes (see LONG) by every contender are those that were committed, in everything but times.

    golden_rows.py PAPERPROOF GOLDEN           asks for it
    golden_rows.py PAPERPROOF GOLDEN --write   writes what they are now

GOLDEN has a line for each scene: hashes of its rows, by contender. Where they differ, `paperproof compare SCENE --steps 60
--no-timing --rows` of this commit and of the one before, and `paperproof diff`, say in which figure."""
import hashlib
import json
import subprocess
import sys
import tempfile
from pathlib import Path

STEPS = 60
LONG = {"crush70", "scaled_1e3", "technique_gallery"}  # seconds each: other tests run them


def rows_of(command):
    """The environment, and the rows as JSON."""
    listed = subprocess.run([command, "list", "scenes"], capture_output=True, text=True, check=True).stdout
    scenes = [line.split()[0] for line in listed.splitlines() if line.strip()]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "rows.jsonl"
        subprocess.run([command, "compare", *(scene for scene in scenes if scene not in LONG), "--steps", str(STEPS),
                        "--no-timing", "--quiet", "--rows", path], stdout=subprocess.DEVNULL, check=False)
        first, *rows = map(json.loads, path.read_text(encoding="utf-8").splitlines())
    return first["environment"], rows


def hashes_of(rows):
    """By scene: by contender and number type."""
    hashes = {}
    for row in rows:
        row.pop("commit", None)
        who = f"{row['contender']}.{row['scalar']}" if "scalar" in row else row["contender"]
        text = json.dumps(row, sort_keys=True).encode()
        hashes.setdefault(row["scene"], {})[who] = hashlib.sha256(text).hexdigest()[:10]
    return hashes


def main(command, golden, write=None):
    environment, rows = rows_of(command)
    box2d = environment["box2d"] + ", " + environment["box2d_build"]
    hashes = hashes_of(rows)
    if write:
        lines = [f"Box2D {box2d}"] + [" ".join([scene, *(f"{who}={value}" for who, value in all_of.items())])
                                      for scene, all_of in hashes.items()]
        Path(golden).write_text("\n".join(lines) + "\n", encoding="utf-8")
        return 0
    first, *lines = Path(golden).read_text(encoding="utf-8").splitlines()
    known = {scene: dict(part.split("=") for part in parts) for scene, *parts in map(str.split, lines)}
    same_box2d = first == f"Box2D {box2d}"
    wrong = [f"{scene} by {who}" for scene in sorted(known.keys() | hashes.keys())
             for who in sorted(known.get(scene, {}).keys() | hashes.get(scene, {}).keys())
             if known.get(scene, {}).get(who) != hashes.get(scene, {}).get(who)
             and (same_box2d or not who.startswith("box2d"))]
    if not same_box2d:
        print(f"the rows of Box2D are not compared: they were written with {first}, and this is {box2d}")
    print(f"{len(rows)} rows of {len(hashes)} scenes, {len(wrong)} others than committed", *wrong[:20], sep="\n  ")
    return 1 if wrong or len(rows) < 2000 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:4]))
