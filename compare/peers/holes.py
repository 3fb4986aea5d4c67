#!/usr/bin/env python3
"""Where each peer has a hole, found by sweeps that are told nothing: a table in Markdown for README.md.
`compare/peers/run.sh holes` calls it with all peers.

usage: holes.py PAPERPROOF NAME=COMMAND..."""
import json
import pathlib
import subprocess
import sys
import tempfile

paperproof, peers = sys.argv[1], sys.argv[2:]
WIDTH, HEIGHT, DT = 0.625, 1.25, 1 / 60  # of the character [m], and of a step [s]
THICKNESS = 0.01  # of the paper [m]


def rows_of(*command):
    with tempfile.TemporaryDirectory() as folder:
        rows = pathlib.Path(folder) / "rows.jsonl"
        subprocess.run([paperproof, *command, "--no-timing", "--quiet", "--rows", rows], check=True)
        return [json.loads(line) for line in open(rows, encoding="utf-8")][1:]


def lowest_through(peer, scene, axis):
    """The lowest speed at which it passes, with the highest tried one below that: in strides, and then finer ones."""
    low, values = 0, range(15, 121, 15)
    for _ in range(2):
        rows = rows_of("sweep", scene, "--set", f"thickness={THICKNESS}", "--vary", f"{axis}={','.join(map(str, values))}",
                       "--vary", "phase=0,0.3,0.6", "--contender", peer.split("=")[0], "--peer", peer)
        through = [row["parameters"][f"{axis}_m_s"] for row in rows if row.get("tunnels")]
        if not through:
            return "never"
        first = min(through)
        low = max([value for value in values if value < first], default=low)
        values = [round(low + (first - low) * i / 8, 3) for i in range(1, 9)]
    return f"{low:.3g} to {first:.3g}"


GRAVITY = "gravity=20"  # at 30 m/s² a body without friction is in balance at the edges
scenes, edges = ["start_overlapping_deep", "flush_tiles"], ["ledge_corner", "gap_fallen"]
rows = {(row["scene"], row["contender"]): row for some in (scenes, [*edges, "--set", GRAVITY])
        for row in rows_of("compare", *some, "--contender", "octagon_sweep", *(f"--peer={peer}" for peer in peers))}
for size, who in ((HEIGHT, "of who falls"), (WIDTH, "of whom it comes to")):
    print(f"A paper of {THICKNESS} m is past the middle {who} within one step from {(size + THICKNESS) / 2 / DT:.1f} m/s on, "
          f"and out of reach at both its ends from {(size + THICKNESS) / DT:.1f} m/s on.")
print("\n| peer | falls through paper from [m/s] | lets paper pass that comes from [m/s] | begins 0.4 m inside, steps inside | lost"
      " at seams | hangs at edges, steps |\n|---|---|---|---|---|---|")
for peer in peers:
    name = peer.split("=")[0]
    start, tiles, *at_edges = (rows[scene, name] for scene in scenes + edges)
    cells = [lowest_through(peer, "paper", "speed"), lowest_through(peer, "moving_paper", "closing"),
             "passes" if start.get("tunnels") else f"{start.get('steps_ending_inside', 0)}",
             f"{100 * tiles.get('wanted_motion_lost', 0):.2g} %",
             f"{sum(edge.get('hanging_steps', 0) - edge.get('hanging_by_law', 0) for edge in at_edges)}"]
    print(f"| `{name}` | " + " | ".join(cells) + " |", flush=True)
