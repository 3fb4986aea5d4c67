#!/usr/bin/env python3
"""The table of controller/README.md, measured, and its picture.

    table.py BENCHMARKS [--processes N] [--svg FILE] [--json FILE]

BENCHMARKS is the program `paperproof_benchmarks`. Of N processes (3) the least of each figure is taken: whatever else
the machine does only adds. --json keeps the figures; given a file instead of the program, the table of that file is
printed and drawn."""
import argparse
import json
import math
import subprocess
import sys

# Words, measurement, what is measured where it is not a time in nanoseconds, unit.
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


STYLE = """text { font: 12px system-ui, "Segoe UI", Roboto, "Liberation Sans", sans-serif; fill: #1d2125; }
.title { font-size: 14px; font-weight: 600; } .quiet { fill: #5c646c; }
.grid { stroke: #d9dcdf; } .one { stroke: #1d2125; stroke-width: 2; } .bar { fill: #0b5cad; } .slower { fill: #b4540a; }
@media (prefers-color-scheme: dark) {
text { fill: #e3e6e8; } .quiet { fill: #a0a8b0; } .grid { stroke: #3a4046; } .one { stroke: #e3e6e8; } .bar { fill: #6cb2f2; } .slower { fill: #f0a35e; }
}"""


TICKS = (0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)


def picture(rows):
    """How many times Box2D's figure is the controller's, as bars along a logarithmic axis; to the left where Box2D's is
    the smaller one."""
    left, width, top, height = 280, 380, 62, 24
    ratios = [theirs / ours for _, ours, theirs, _ in rows]
    least = max([tick for tick in TICKS if tick <= min(ratios)], default=TICKS[0])
    most = min([tick for tick in TICKS if tick >= max(ratios)], default=TICKS[-1])
    bottom = top + height * len(rows)

    def x(ratio):
        return left + width * math.log(ratio / least) / math.log(most / least)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="860" height="{bottom + 34}" viewBox="0 0 860 {bottom + 34}" '
           'role="img">', "<title>paperproof and Box2D 2.4.1: time and memory</title>", f"<style>\n{STYLE}\n</style>",
           '<text class="title" x="16" y="24">How many times faster or smaller than Box2D 2.4.1</text>',
           '<text class="quiet" x="16" y="42">one process, the same level, 60 Hz; paperproof, Box2D beside each bar</text>']
    for ratio in [tick for tick in TICKS if least <= tick <= most]:
        out.append(f'<line class="{"one" if ratio == 1 else "grid"}" x1="{x(ratio):.1f}" y1="{top}" '
                   f'x2="{x(ratio):.1f}" y2="{bottom}"/>')
        out.append(f'<text class="quiet" x="{x(ratio):.1f}" y="{bottom + 18}" text-anchor="middle">{ratio}</text>')
    for i, ((words, ours, theirs, unit), ratio) in enumerate(zip(rows, ratios)):
        y = top + height * i
        begin, end = sorted((x(1), x(ratio)))
        out.append(f'<text x="{left - 10}" y="{y + 16}" text-anchor="end">{words}</text>')
        out.append(f'<rect class="{"bar" if ratio >= 1 else "slower"}" x="{begin:.1f}" y="{y + 5}" '
                   f'width="{max(1, end - begin):.1f}" height="{height - 10}"/>')
        out.append(f'<text class="quiet" x="{end + 6:.1f}" y="{y + 16}">{ratio:.1f} × '
                   f'({ours:,.0f} {unit}, {theirs:,.0f} {unit})</text>')
    return "\n".join([*out, "</svg>", ""])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("benchmarks")
    parser.add_argument("--processes", type=int, default=3)
    parser.add_argument("--svg")
    parser.add_argument("--json")
    options = parser.parse_args()
    if options.benchmarks.endswith(".json"):
        with open(options.benchmarks, encoding="utf-8") as file:
            figures = json.load(file)
    else:
        figures = measured(options.benchmarks, options.processes)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(figures, file, indent=1, sort_keys=True)
    rows = table(figures)
    print(markdown(rows))
    if options.svg:
        with open(options.svg, "w", encoding="utf-8") as file:
            file.write(picture(rows))


if __name__ == "__main__":
    main()
