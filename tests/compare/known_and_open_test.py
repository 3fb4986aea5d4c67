#!/usr/bin/env python3
"""Every built-in scene holds the guarantee, but for what tests/known_and_open.json names; and what that names is still so.

    known_and_open_test.py PAPERPROOF KNOWN_AND_OPEN README
"""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

LONG = "long_rest"  # a million steps: it is run by the main comparison


class KnownAndOpen(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.known = json.loads(Path(KNOWN).read_text(encoding="utf-8"))

    def broken(self, *arguments):
        """The clauses that octagon_sweep in double breaks, by scene; and the exit status."""
        with tempfile.TemporaryDirectory() as folder:
            rows = Path(folder) / "rows.jsonl"
            done = subprocess.run([COMMAND, "compare", *arguments, "--contender", "octagon_sweep", "--no-reference",
                                   "--no-timing", "--quiet", "--rows", rows], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, text=True, check=False)
            self.assertIn(done.returncode, (0, 1), done.stderr)
            found = [json.loads(line) for line in rows.read_text(encoding="utf-8").splitlines()[1:]]
        ran = [row for row in found if row["scalar"] == "double" and row["verdict"] != "not_applicable"]
        self.assertTrue(ran)
        broken = {row["scene"]: sorted(row["broken"]) for row in ran if "broken" in row}
        self.assertEqual(done.returncode, 1 if broken else 0)
        return broken

    def test_what_is_named_is_still_broken(self):
        for entry in self.known["commands"]:
            with self.subTest(" ".join(entry["compare"])):
                self.assertEqual(self.broken(*entry["compare"]), {entry["compare"][0]: sorted(entry["clauses"])})

    def test_nothing_else_is_broken(self):
        listed = subprocess.run([COMMAND, "list", "scenes"], capture_output=True, text=True, check=True).stdout
        scenes = [line.split()[0] for line in listed.splitlines() if line.strip()]
        scenes.remove(LONG)
        named = {entry["compare"][0]: sorted(entry["clauses"]) for entry in self.known["commands"] if len(entry["compare"]) == 1}
        self.assertEqual(self.broken(*scenes), named)

    def test_the_readme_says_how_many(self):
        said = re.search(r"(\d+) commands and (\d+) kinds of random runs", Path(README).read_text(encoding="utf-8"))
        self.assertIsNotNone(said, "the README does not say how many are known and open")
        self.assertEqual((int(said[1]), int(said[2])), (len(self.known["commands"]), len(self.known["random"])))


if __name__ == "__main__":
    README = sys.argv.pop(3)
    KNOWN = sys.argv.pop(2)
    COMMAND = sys.argv.pop(1)
    unittest.main()
