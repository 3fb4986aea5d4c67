#!/usr/bin/env python3
"""The rows of this folder, given to check_trace.py as well, which shares no code with the judge: both tell first, in the
same step, that something is entered, passed, or broken against a one-way normal.

    checker_test.py JUDGE_TESTS FOLDER

Compared is what comes before the first step of which the checker has other words: see `note_broken`.
"""
import json
import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

CHECKER = Path(__file__).parent.parent / "compare" / "check_trace.py"
CLAUSES = ("overlap", "passage", "one_way")


def first_broken(steps, before):
    """The first step that breaks any clause, and which."""
    found = [step for clause in CLAUSES for step in steps.get(clause, ()) if step < before]
    return found and (min(found), [clause for clause in CLAUSES if min(found) in steps.get(clause, ())])


class Checker(unittest.TestCase):
    def test_it_tells_what_the_judge_tells(self):
        shutil.rmtree(FOLDER, ignore_errors=True)
        FOLDER.mkdir(parents=True)
        subprocess.run((JUDGE_TESTS, "--gtest_brief=1"), env={**os.environ, "PAPERPROOF_JUDGE_TRACES": FOLDER}, check=True)
        traces = sorted(FOLDER.glob("*.jsonl"))
        checked = subprocess.run((sys.executable, "-B", CHECKER, "--clauses", ",".join(CLAUSES), *traces),
                                 capture_output=True, text=True, check=False)
        self.assertEqual(checked.stderr, "")
        told = {}
        for path, step, clause in re.findall(r"^(.*\.jsonl): step (\d+): (\w+): ", checked.stdout, re.MULTILINE):
            told.setdefault(path, {}).setdefault(clause, []).append(int(step))
        broken = 0
        for trace in traces:
            with self.subTest(trace.stem):
                judged = json.loads(trace.with_suffix(".json").read_text())
                before = min(judged.get("unlike", [sys.maxsize]))
                self.assertEqual(first_broken(told.get(str(trace), {}), before), first_broken(judged, before))
                broken += bool(first_broken(judged, before))
        self.assertGreater(broken, 40)
        self.assertGreater(len(traces), 500)


if __name__ == "__main__":
    JUDGE_TESTS, FOLDER = Path(sys.argv[1]), Path(sys.argv[2])
    unittest.main(argv=sys.argv[:1])
