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

# Words, benchmark of the controller, its counter; benchmark of Box2D, its counter; unit, digits behind the point.
ROWS = [
    *[(f"one character, {n} pieces", f"pieces/{p}", "paperproof", f"pieces/{p}", "box2d", "ns", 0)
      for n, p in (("100", 100), ("10,000", 10_000), ("1,000,000", 1_000_000))],
    ("one character among 10,000 sensors", "sensors/10000", "paperproof", "sensors/10000", "box2d", "ns", 0),
    *[(f"10,000 characters, each, {words}", f"characters/{how}", "paperproof", f"characters/{how}", "box2d", "ns", 0)
      for words, how in (("own scratch", "own_scratch"), ("one scratch", "shared_scratch"))],
    ("one character on a plank that turns", "plank/on", "paperproof", "plank/on", "box2d", "ns", 0),
    ("one character beside it", "plank/beside", "paperproof", "plank/beside", "box2d", "ns", 0),
    ("a start inside, 1,000,000 pieces", "start_inside/surface", "paperproof", "start_inside/surface", "box2d", "ns", 0),
    ("a start deep inside", "start_inside/deep", "paperproof", "start_inside/deep", "box2d", "ns", 0),
    ("set-up of 1,000,000 pieces", "setup/octagon_sweep/1000000", "all_ms", "setup/box2d/1000000", "all_ms", "ms", 0),
    ("memory for each piece", "setup/octagon_sweep/1000000", "all_bytes", "setup/box2d/1000000", "all_bytes", "B", 0),
]


def measured(program, processes):
    """Every counter by name of benchmark and counter, the least of all processes."""
    least = {}
    for _ in range(processes):
        output = subprocess.run([program, "--benchmark_filter=table/.*(pieces|sensors|characters|plank|start|1000000)",
                                 "--benchmark_format=json"], check=True, stdout=subprocess.PIPE).stdout
        for run in json.loads(output)["benchmarks"]:
            name = run["name"].removeprefix("table/").split("/iterations:")[0]
            if "error_message" in run:
                sys.exit(f"{name}: {run['error_message']}")
            for counter, value in run.items():
                if isinstance(value, float):
                    key = f"{name} {counter}"
                    least[key] = min(value, least.get(key, math.inf))
    return least


def table(figures):
    """A row of words, controller, Box2D, unit for each row that was measured."""
    return [(words, figures[f"{ours} {our_counter}"], figures[f"{theirs} {their_counter}"], unit, digits)
            for words, ours, our_counter, theirs, their_counter, unit, digits in ROWS]


def markdown(rows):
    lines = ["| | paperproof | Box2D 2.4.1 | ratio |", "|---|---|---|---|"]
    for words, ours, theirs, unit, digits in rows:
        lines.append(f"| {words} | {ours:,.{digits}f} {unit} | {theirs:,.{digits}f} {unit} | {theirs / ours:.1f} |")
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
    ratios = [theirs / ours for _, ours, theirs, _, _ in rows]
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
    for i, ((words, ours, theirs, unit, digits), ratio) in enumerate(zip(rows, ratios)):
        y = top + height * i
        begin, end = sorted((x(1), x(ratio)))
        out.append(f'<text x="{left - 10}" y="{y + 16}" text-anchor="end">{words}</text>')
        out.append(f'<rect class="{"bar" if ratio >= 1 else "slower"}" x="{begin:.1f}" y="{y + 5}" '
                   f'width="{max(1, end - begin):.1f}" height="{height - 10}"/>')
        out.append(f'<text class="quiet" x="{end + 6:.1f}" y="{y + 16}">{ratio:.1f} × '
                   f'({ours:,.{digits}f} {unit}, {theirs:,.{digits}f} {unit})</text>')
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
