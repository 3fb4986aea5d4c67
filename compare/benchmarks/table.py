#!/usr/bin/env python3
"""The tables of controller/README.md and box2d_adapter/README.md, measured.

    table.py BENCHMARKS [--processes N] [--json FILE]

BENCHMARKS is the program `paperproof_benchmarks`. Of N processes (3) the least of each figure is taken: whatever else
the machine does only adds. --json keeps the figures, of which `plots.py` makes a picture; given a file instead of the
program, the tables of that file are printed."""
import argparse
import json
import math
import subprocess
from pathlib import Path

# Words, measurement, end of the figure's name (none: nanoseconds), unit.
ROWS = [
    ("one character, 100 pieces", "pieces/100", "", "ns"),
    ("one character, 10,000 pieces", "pieces/10000", "", "ns"),
    ("one character, 1,000,000 pieces", "pieces/1000000", "", "ns"),
    ("one character among 10,000 sensors", "sensors", "", "ns"),
    ("10,000 characters, each, own scratch", "characters/own_scratch", "", "ns"),
    ("10,000 characters, each, one scratch", "characters/shared_scratch", "", "ns"),
    ("1,000 characters, each alone", "those_that_meet/alone", "", "ns"),
    ("1,000 characters that meet, each", "those_that_meet/together", "", "ns"),
    ("one character on a plank that turns", "plank/on", "", "ns"),
    ("one character beside it", "plank/beside", "", "ns"),
    ("a start inside, 1,000,000 pieces", "start_inside/surface", "", "ns"),
    ("a start deep inside", "start_inside/deep", "", "ns"),
    ("at rest among 1,000,000 pieces", "edit/none", "", "ns"),
    ("the same, after an edit far away", "edit/far_away", "", "ns"),
    ("the same, after an edit near", "edit/near", "", "ns"),
    ("set-up of 1,000,000 pieces", "set_up", "_ms", "ms"),
    ("memory for each piece", "set_up", "_bytes", "B"),
]

# What a hero costs a game: words, measurement.
HERO_ROWS = [
    ("one box, stands", "hero/box/stands"),
    ("one box, walks", "hero/box/walks"),
    ("tiles, stands", "hero/tiles/stands"),
    ("tiles, walks", "hero/tiles/walks"),
]


def measured(program, processes):
    """Every figure by its name, the least of all processes."""
    least = {}
    for _ in range(processes):
        for key, value in json.loads(subprocess.check_output([program])).items():
            least[key] = min(value, least.get(key, math.inf))
    return least


def table(figures):
    """Words, figure of the controller, of Box2D, and unit, row by row."""
    return [(words, figures[f"{name} paperproof{what}"], figures[f"{name} box2d{what}"], unit)
            for words, name, what, unit in ROWS]


def markdown(rows):
    lines = ["| | paperproof | Box2D 2.4.1 | ratio |", "|---|---|---|---|"]
    for words, ours, theirs, unit in rows:
        lines.append(f"| {words} | {ours:,.0f} {unit} | {theirs:,.0f} {unit} | {theirs / ours:.1f} |")
    return "\n".join(lines)


def hero_markdown(figures):
    lines = ["| ground | `hero.step` | its body in `world.Step` | a body of Box2D alone there |", "|---|---|---|---|"]
    for words, name in HERO_ROWS:
        lines.append(f"| {words} | " + " | ".join(f"{figures[f'{name} {what}']:,.0f} ns" for what in
                                                  ("step", "its_body", "plain_body")) + " |")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("benchmarks")
    parser.add_argument("--processes", type=int, default=3)
    parser.add_argument("--json")
    options = parser.parse_args()
    if options.benchmarks.endswith(".json"):
        figures = json.loads(Path(options.benchmarks).read_text(encoding="utf-8"))
    else:
        figures = measured(options.benchmarks, options.processes)
    if options.json:
        Path(options.json).write_text(json.dumps(figures, indent=1, sort_keys=True), encoding="utf-8")
    print(markdown(table(figures)), hero_markdown(figures), sep="\n\n")


if __name__ == "__main__":
    main()
