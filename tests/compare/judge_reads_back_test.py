#!/usr/bin/env python3
"""A trace says all that a run was judged by: read back, it is judged as the run was.

    judge_reads_back_test.py PAPERPROOF
"""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

# What stands, goes, turns beside its origin, turns at it, lets through from one side, is a crowd, and breaks a clause.
SCENES = ("slope_joints", "jump_into_corner", "lift_up", "closing_ceiling", "rotating_paper", "turning_arm",
          "one_way_lift_drop", "thin_sensor", "falling_crate", "pressed_in_a_row", "start_overlapping_deep", "uneven_lift")


class ReadBack(unittest.TestCase):
    def test_is_judged_as_the_run_was(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            subprocess.run([COMMAND, "compare", *SCENES, "--no-timing", "--quiet", "--steps", "150", "--rows",
                            folder / "rows.jsonl", "--trace", folder / "t"], stdout=subprocess.DEVNULL, check=True)
            rows = [json.loads(line) for line in (folder / "rows.jsonl").read_text(encoding="utf-8").splitlines()[1:]]
            clauses, scenes = set(), set()
            for row in rows:
                trace = folder / f"t.{row['scene']}.{row['contender']}.{row['scalar']}.jsonl"
                if not trace.exists():
                    self.assertEqual(row["verdict"], "not_applicable")
                    continue
                with self.subTest(trace.name):
                    judged = subprocess.run([COMMAND, "judge", trace], stdout=subprocess.PIPE, text=True, check=False)
                    broken = re.findall(r"^  (\w+)(?: \(not guaranteed\))? on (\d+) step", judged.stdout, re.MULTILINE)
                    excused = re.findall(r"^  exempted: (\w+) on (\d+) step", judged.stdout, re.MULTILINE)
                    self.assertEqual({clause: int(steps) for clause, steps in broken}, row.get("broken", {}))
                    self.assertEqual({which: int(steps) for which, steps in excused}, row.get("exempted", {}))
                    self.assertEqual(judged.returncode, 1 if row["verdict"] == "violates" else 0)
                    clauses.update(row.get("broken", {}))
                    scenes.add(row["scene"])
            self.assertEqual(scenes, set(SCENES))
            self.assertGreaterEqual(len(clauses), 10, f"only {sorted(clauses)} are broken by any contender")


if __name__ == "__main__":
    COMMAND = sys.argv[1]
    unittest.main(argv=sys.argv[:1])
