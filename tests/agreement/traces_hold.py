#!/usr/bin/env python3
"""Random runs of the guarantee, judged by the checker that shares no code with the project.

    traces_hold.py PAPERPROOF CHECK_TRACE KNOWN_AND_OPEN STEPS

STEPS of each family: among scenery that stands, with any up, among movers, and a third of them among what turns. Of a clause
no more steps may be broken than KNOWN_AND_OPEN says of such runs, and by chance. Characters are launched, so that continuity
is not asked for.
"""
import collections
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

KINDS = ("movers_any_up", "movers", "any_up", "turning", "static")  # "movers" begins "movers_any_up"
LEAST_CONTACTS = 0.1  # of a step: fewer would judge little


def kind_of(name):
    """As KNOWN_AND_OPEN names runs."""
    return next(kind for kind in KINDS if name.startswith(f"run.{kind}_"))


def most_broken(known, kind, clause, steps):
    """By the share of all families together: the checker judges few steps of each."""
    for entry in known["random"]:
        if (entry["runs"], entry["clause"]) == (kind, clause):
            expected = entry["steps_in_a_million"] * steps / 1e6
            return int(3 + expected + 4 * expected ** 0.5)
    return 0


def main(command, checker, known_file, steps):
    known = json.loads(Path(known_file).read_text(encoding="utf-8"))
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([command, "campaign", *KINDS, "--steps", steps, "--trace", f"{folder}/run"],
                       check=False, stdout=subprocess.DEVNULL)  # so few steps need not cover much
        files = sorted(map(str, Path(folder).glob("*.jsonl")))
        done = subprocess.run([sys.executable, "-B", checker, "--but", "continuity", *files],
                              capture_output=True, text=True, check=False)
    print(done.stderr, end="")
    steps, contacts, broken, judged = collections.Counter(), 0, collections.defaultdict(set), 0
    for line in done.stdout.splitlines():
        name = Path(line.split(".jsonl: ")[0]).name
        if found := re.search(r"\.jsonl: step (\d+): (\w+): ", line):
            broken[kind_of(name), found[2]].add((name, found[1]))
            print(line)
        elif found := re.search(r"\.jsonl: (\d+) steps, (\d+) contacts, ", line):
            steps[kind_of(name)] += int(found[1])
            contacts += int(found[2])
            judged += 1
    failed = done.returncode not in (0, 1) or judged < len(files) or set(steps) != set(KINDS)
    failed = failed or contacts < LEAST_CONTACTS * sum(steps.values())
    for (kind, clause), where in sorted(broken.items()):
        most = most_broken(known, kind, clause, steps[kind])
        print(f"{kind}: {clause} is broken in {len(where)} steps, at most {most} are known and open")
        failed = failed or len(where) > most
    print(f"{len(files)} runs, {dict(steps)} steps, {contacts} contacts")
    return 1 if failed or not files else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
