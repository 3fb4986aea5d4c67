#!/usr/bin/env python3
"""Every built-in scene holds the guarantee, but for what tests/known_and_open.json names; and what that names is still so.
So do the scenes in tests/regression/.
The levels of SuperTux hold it, where they are installed: those that broke it once and every 32nd of the others, or all of
them with PAPERPROOF_LONG_TESTS=1.

    known_and_open_test.py PAPERPROOF KNOWN_AND_OPEN README
"""
import json
import os
import re
import sys
import tempfile
import unittest
from pathlib import Path

from judging import call, compare, read

LONG = "long_rest"  # a million steps: it is run by the main comparison
LEVELS = Path("/usr/share/games/supertux2/levels")
LEVELS_THAT_BROKE = ("world1/crystal_mine.stl", "world2/lost_village.stl", "bonus4/Spooky_Mansion.stl")
BROKE_ONCE = (("closing_lift", "--set", "clearance=2.02e-7", "--set", "closing=1"),
              ("closing_lift", "--set", "clearance=2.2e-7", "--set", "closing=1"))
NO_LEVEL = "expected a sector with solid tiles and a spawn point"  # what a cut-scene is


class KnownAndOpen(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.known = json.loads(Path(KNOWN).read_text(encoding="utf-8"))

    def broken(self, *arguments, answers=False):
        """The clauses that octagon_sweep in double breaks, by scene. The exit status says the same. ANSWERS: each scene has
        exact answers, and they are met."""
        with tempfile.TemporaryDirectory() as folder:
            rows = Path(folder) / "rows.jsonl"
            status, _, errors = compare(COMMAND, *arguments, "--rows", rows)
            self.assertTrue(rows.exists(), errors)
            found = read(rows)[1:]
        failed = [row for row in found if row["verdict"] == "failed"]
        self.assertTrue(all(row["reason"].endswith(NO_LEVEL) for row in failed), failed)
        ran = [row for row in found if row["scalar"] == "double" and row["verdict"] not in ("not_applicable", "failed")]
        self.assertTrue(ran)
        if answers:
            self.assertEqual([row["scene"] for row in ran if not row["answer_ok"]], [])
        broken = {row["scene"]: sorted(row["broken"]) for row in ran if "broken" in row}
        self.assertEqual(status, 1 if broken else 2 if failed else 0)
        return broken

    def test_what_is_named_is_still_broken(self):
        """Built-in scenes without options are asked for below."""
        for entry in self.known["commands"]:
            scene, *options = entry["compare"]
            if not options and not scene.endswith(".json"):
                continue
            with self.subTest(" ".join(entry["compare"])):
                path = Path(KNOWN).parent / scene if scene.endswith(".json") else scene
                self.assertEqual(self.broken(path, *options), {Path(scene).stem: sorted(entry["clauses"])})

    def test_the_scenes_beside_the_list_are_named_in_it(self):
        named = {entry["compare"][0] for entry in self.known["commands"] if entry["compare"][0].endswith(".json")}
        folder = Path(KNOWN).with_suffix("")
        self.assertEqual(named, {f"{folder.name}/{path.name}" for path in folder.glob("*.json")})

    def test_what_broke_once_holds(self):
        scenes = sorted(Path(KNOWN).parent.glob("regression/*.json"))
        self.assertTrue(scenes)
        for arguments in [*BROKE_ONCE, *((scene,) for scene in scenes)]:
            with self.subTest(arguments):
                self.assertEqual(self.broken(*arguments), {})

    @unittest.skipUnless(LEVELS.is_dir(), "supertux-data is not installed")
    def test_nothing_is_broken_in_levels_of_supertux(self):
        levels = sorted(LEVELS.rglob("*.stl"))
        if os.environ.get("PAPERPROOF_LONG_TESTS") != "1":
            levels = levels[::32]
        levels = sorted({*levels, *(LEVELS / level for level in LEVELS_THAT_BROKE)})
        self.assertGreater(len(levels), 8)
        self.assertEqual(self.broken(*levels, "--keep-going"), {})

    def test_nothing_else_is_broken(self):
        scenes = [line.split()[0] for line in call(COMMAND, "list", "scenes")[1].splitlines() if line.strip()]
        scenes.remove(LONG)
        named = {entry["compare"][0]: sorted(entry["clauses"]) for entry in self.known["commands"]
                 if entry["compare"][0] in scenes and len(entry["compare"]) == 1}
        self.assertEqual(self.broken(*scenes, answers=True), named)

    def test_the_readme_says_how_many(self):
        said = re.search(r"(\d+) commands?\s+and (\d+) kinds of random runs", Path(README).read_text(encoding="utf-8"))
        self.assertIsNotNone(said, "the README does not say how many are known and open")
        counts = [len(self.known[key]) for key in ("commands", "random")]
        self.assertEqual([int(number) for number in said.groups()], counts)


if __name__ == "__main__":
    README = sys.argv.pop(3)
    KNOWN = sys.argv.pop(2)
    COMMAND = sys.argv.pop(1)
    unittest.main()
