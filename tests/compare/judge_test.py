#!/usr/bin/env python3
"""Tests of `paperproof judge`: traces that lie, traces of runs, and the trace in the README of compare/.

    judge_test.py PAPERPROOF
"""
import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

from judging import CHECKER, call, compare, read

COMPARE = Path(__file__).parents[2] / "compare"
LIES = Path(__file__).parent / "lies"
# What stands, goes, turns beside its origin, turns at it, lets through from one side, is a crowd, and breaks a clause.
SCENES = ("slope_joints", "jump_into_corner", "lift_up", "closing_ceiling", "rotating_paper", "turning_arm",
          "one_way_lift_drop", "thin_sensor", "falling_crate", "pressed_in_a_row", "start_overlapping_deep", "uneven_lift")


class Lies(unittest.TestCase):
    """Traces that lie, each in one point: the clause is named, or the trace refused with status 2. A few are honest and were
    accused once: they hold. lies/*.json say of each what must be named. One whose name begins with scene_ is judged with the
    scene of its header."""

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


class ReadBack(unittest.TestCase):
    """A trace says all that a run was judged by: read back, it is judged as the run was."""

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


def section(readme, title):
    text = (COMPARE / readme).read_text(encoding="utf-8")
    return re.search(rf"^## {title}\n(.*?)(?=^## |\Z)", text, re.DOTALL | re.MULTILINE)[1]


def rows(text):
    """The cells of each line of a table, but its head."""
    lines = [line for line in text.splitlines() if line.startswith("|")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def code(cell):
    return cell.strip("`")


class TypedTrace(unittest.TestCase):
    """The one that the README of compare/ shows."""

    def setUp(self):
        text = section("README.md", "A trace of your own controller")
        self.trace = re.search(r"^```jsonl\n(.*?)^```$", text, re.DOTALL | re.MULTILINE)[1]
        self.changes = [[code(cell) for cell in row] for row in rows(text)]

    def judged(self, trace, *options):
        """Exit status, and the clauses that are broken, by the command and by the checker."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "box.jsonl"
            path.write_text(trace, encoding="utf-8")
            command, checker = (call(*judge, *options, path) for judge in ((COMMAND, "judge"), CHECKER))
        named = re.findall(r"^  (\w+) on \d+ step", command[1], re.MULTILINE)
        found = re.findall(r"box.jsonl: step \d+: (\w+): ", checker[1])
        return (command[0], set(named)), (checker[0], set(found))

    def test_holds_every_clause(self):
        self.assertEqual(self.judged(self.trace, "--all"), ((0, set()), (0, set())))

    def test_breaks_the_clause_that_is_named_where_a_word_is_changed(self):
        self.assertGreaterEqual(len(self.changes), 7)
        for word, other, clause in self.changes:
            with self.subTest(f"{word} -> {other}"):
                self.assertIn(word, self.trace)
                for status, broken in self.judged(self.trace.replace(word, other), "--all"):
                    self.assertEqual(status, 1)
                    self.assertIn(clause, broken)

    def test_without_all_only_what_is_guaranteed_counts(self):
        promised = json.loads(self.trace.splitlines()[0])["guarantees"]
        for word, other, clause in self.changes:
            for status, _ in self.judged(self.trace.replace(word, other)):
                self.assertEqual(status, 1 if clause in promised else 0, f"{word} -> {other}")


class Arcs(unittest.TestCase):
    """How far vertices of what turns leave their arcs, as the oracle's README says."""

    def test_of_scenes_are_left_as_far_as_it_says(self):
        text = section("oracle/README.md", "What turns")
        said = {scene: metres for metres, scene in re.findall(r"([\d.]+) m in\s+`(\w+)`", text)}
        self.assertGreaterEqual(len(said), 2)
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "rows.jsonl"
            compare(COMMAND, *said, "--rows", out, "--trace", Path(folder) / "t")
            found = read(out)[1:]
            self.assertEqual({row["scene"]: f"{row['arc_error_max_m']:.2g}" for row in found}, said)
            for row in found:
                trace = Path(folder) / f"t.{row['scene']}.octagon_sweep.double.jsonl"
                self.assertIn(f"leaves its arc by at most {row['arc_error_max_m']:.3g} m", call(COMMAND, "judge", trace)[1])


class Tables(unittest.TestCase):
    """Those in the oracle's README."""

    def test_of_clauses_names_each_in_order(self):
        schema = json.loads((COMPARE / "records/paperproof_trace.schema.json").read_text(encoding="utf-8"))
        self.assertEqual([code(row[0]) for row in rows(section("oracle/README.md", "The clauses"))],
                         schema["$defs"]["clause"]["enum"])

    def test_of_exemptions_is_the_one_that_the_command_prints(self):
        _, out, _ = call(COMMAND, "compare", "article_bullet", "--contender", "octagon_sweep", "--no-reference",
                         "--no-timing", "--explain")
        printed = re.findall(r"^- (\w+): (.*)\. octagon_sweep in double (.*), Box2D (.*), who searches by units (.*), "
                             r"others (.*)$", out, re.MULTILINE)
        self.assertTrue(printed)
        written = rows(section("oracle/README.md", "Exemptions"))
        self.assertEqual([(code(row[0]), *row[1:6]) for row in written], printed)
        for row in written:
            self.assertTrue(row[6], f"why {row[0]}?")


if __name__ == "__main__":
    COMMAND = sys.argv.pop(1)
    unittest.main()
