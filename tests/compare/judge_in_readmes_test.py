#!/usr/bin/env python3
"""What the READMEs of compare/ say of the judge is so: the trace that can be typed, the clauses, the exemptions.

    judge_in_readmes_test.py PAPERPROOF COMPARE
"""
import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

from judging import CHECKER, call, compare, read


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
    COMMAND, COMPARE = sys.argv[1], Path(sys.argv[2])
    unittest.main(argv=sys.argv[:1])
