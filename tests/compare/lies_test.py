#!/usr/bin/env python3
"""Traces that lie, each in one point: `paperproof judge` names the clause, or refuses the trace with status 2. A few are
honest and were accused once: they hold.

    lies_test.py PAPERPROOF

lies/*.json say of each what must be named. One whose name begins with scene_ is judged with the scene of its header.
"""
import json
import subprocess
import sys
import unittest
from pathlib import Path

LIES = Path(__file__).parent / "lies"


class Lies(unittest.TestCase):
    def test_each_is_found(self):
        expected = {name: clause for table in LIES.glob("*.json") for name, clause in json.loads(table.read_text()).items()}
        self.assertEqual(sorted(expected), sorted(file.stem for file in LIES.glob("*.jsonl")))
        for name, clause in sorted(expected.items()):
            with self.subTest(name):
                file = LIES / f"{name}.jsonl"
                arguments = [COMMAND, "judge", file]
                if name.startswith("scene_"):
                    with file.open(encoding="utf-8") as lines:
                        arguments += ["--scene", json.loads(next(lines))["scene"]]
                done = subprocess.run(arguments, capture_output=True, text=True, check=False)
                said = done.stdout + done.stderr
                self.assertEqual(done.returncode, {"status 2": 2, "holds": 0}.get(clause, 1), said)
                if done.returncode == 1:
                    self.assertIn(f"\n  {clause} on ", said)
                elif done.returncode == 2:
                    self.assertEqual(len(said.splitlines()), 1, said)


if __name__ == "__main__":
    COMMAND = sys.argv.pop(1)
    unittest.main()
