#!/usr/bin/env python3
"""A trace says all that a run was judged by: read back, it is judged as the run was.

    judge_reads_back_test.py PAPERPROOF
"""
import re
import sys
import tempfile
import unittest
from pathlib import Path

from judging import call, read

# What stands, goes, turns beside its origin, turns at it, lets through from one side, is a crowd, and breaks a clause.
SCENES = ("slope_joints", "jump_into_corner", "lift_up", "closing_ceiling", "rotating_paper", "turning_arm",
          "one_way_lift_drop", "thin_sensor", "falling_crate", "pressed_in_a_row", "start_overlapping_deep", "uneven_lift")


class ReadBack(unittest.TestCase):
    def test_is_judged_as_the_run_was(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            status, _, errors = call(COMMAND, "compare", *SCENES, "--no-timing", "--quiet", "--steps", "150", "--rows",
                                     folder / "rows.jsonl", "--trace", folder / "t")
            self.assertEqual(status, 0, errors)
            clauses, scenes = set(), set()
            for row in read(folder / "rows.jsonl")[1:]:
                trace = folder / f"t.{row['scene']}.{row['contender']}.{row['scalar']}.jsonl"
                if not trace.exists():
                    self.assertEqual(row["verdict"], "not_applicable")
                    continue
                with self.subTest(trace.name):
                    status, said, _ = call(COMMAND, "judge", trace)
                    broken = re.findall(r"^  (\w+)(?: \(not guaranteed\))? on (\d+) step", said, re.MULTILINE)
                    excused = re.findall(r"^  exempted: (\w+) on (\d+) step", said, re.MULTILINE)
                    self.assertEqual({clause: int(steps) for clause, steps in broken}, row.get("broken", {}))
                    self.assertEqual({which: int(steps) for which, steps in excused}, row.get("exempted", {}))
                    self.assertEqual(status, 1 if row["verdict"] == "violates" else 0)
                    clauses.update(row.get("broken", {}))
                    scenes.add(row["scene"])
            self.assertEqual(scenes, set(SCENES))
            self.assertGreaterEqual(len(clauses), 10, f"only {sorted(clauses)} are broken by any contender")


if __name__ == "__main__":
    COMMAND = sys.argv[1]
    unittest.main(argv=sys.argv[:1])
