#!/usr/bin/env python3
"""Traces that lie, each in one point: `paperproof judge` names the clause, or refuses the trace with status 2. A few are
honest and were accused once: they hold.

    lies_test.py PAPERPROOF

lies/*.json say of each what must be named. One whose name begins with scene_ is judged with the scene of its header.
"""
import json
import sys
import unittest
from pathlib import Path

from judging import call, read

LIES = Path(__file__).parent / "lies"


class Lies(unittest.TestCase):
    def test_each_is_found(self):
        expected = {name: clause for table in LIES.glob("*.json") for name, clause in json.loads(table.read_text()).items()}
        self.assertEqual(sorted(expected), sorted(file.stem for file in LIES.glob("*.jsonl")))
        for name, clause in sorted(expected.items()):
            with self.subTest(name):
                file = LIES / f"{name}.jsonl"
                scene = ("--scene", read(file)[0]["scene"]) if name.startswith("scene_") else ()
                status, out, errors = call(COMMAND, "judge", file, *scene)
                self.assertEqual(status, {"status 2": 2, "holds": 0}.get(clause, 1), out + errors)
                if status == 1:
                    self.assertIn(f"\n  {clause} on ", out)
                elif status == 2:
                    self.assertEqual(len((out + errors).splitlines()), 1, out + errors)


if __name__ == "__main__":
    COMMAND = sys.argv.pop(1)
    unittest.main()
