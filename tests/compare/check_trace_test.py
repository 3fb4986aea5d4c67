#!/usr/bin/env python3
"""Both judges, check_trace.py and `paperproof judge`, find nothing in good traces, and what is wrong in traces that are
spoilt in one thing each.

    check_trace_test.py PAPERPROOF

PAPERPROOF is the command that writes the good ones. tables/README.md says how the rows of spoilt.json are written. Its scenes: in
`yard` a character falls onto a floor, walks through a gate to a wall, comes back, jumps and rests, and a lift goes up far
away. In `see_saw` it falls onto a plank that turns slowly under it, walks down it and stays. In `turns` a lift takes up a
character, another one on its head, and a third that walks against it.
"""
import copy
import json
import math
import sys
import tempfile
import unittest
from pathlib import Path

from judging import CHECKER, call, read, traces_of, write

SPOILT = json.loads((Path(__file__).parent / "tables/spoilt.json").read_text(encoding="utf-8"))
SCHEMA = Path(__file__).parents[2] / "compare/records/paperproof_trace.schema.json"

# Steps that are spoilt: the first one, after the third, of which this is so. Each gets the step and the one before.
FIRST = {
    "falls": lambda step, _: not step["contacts"] and step["velocity"][1] < -1,
    "rests": lambda step, before: step["grounded"] and step["velocity"] == [0, 0] and step["path"] == before["path"],
    "walks": lambda step, _: step["grounded"] and step["velocity"][0] == 4 and len(step["contacts"]) == 1,
    "is at the wall": lambda step, _: any(c["collider"] == "wall" and c["fraction"] > 0.01 for c in step["contacts"]),
    "rises": lambda step, _: step["velocity"][1] > 2 and not step["contacts"],
    "rides": lambda step, before: step["grounded"] and before["grounded"] and "ride" in step and step["input"] == {"move": 0},
    "rides up": lambda step, _: "ride" in step and step["ride"]["velocity"][1] > 0 and step["contacts"],
    "rides up on a head": lambda step, _: "character" in step.get("ride", {}) and step["requested"][1] > 0,
    "stands on no head": lambda step, _: "character" not in step.get("ride", {}),
    "walks on the plank": lambda step, _: step["grounded"] and step["input"] == {"move": 1} and step["velocity"][0] > 3.9,
    # Of the plank: within what it falls in two steps.
    "is just above": lambda step, _: not step["contacts"] and step["path"][-1][1] < 0.625 + 0.25,
    "is at the gate": lambda step, _: "sensors" in step,
    "meets": lambda step, _: "met" in step,
    "drops": lambda step, _: "drop" in step,
    "is crushed": lambda step, _: "crush" in step,
    "touches": lambda step, _: step["contacts"],
    # In turns.
    "walks to another": lambda step, _: step["character"] == 2 and step["velocity"][0] == -4,
    "comes to another": lambda step, _: step["character"] == 2 and "met" in step and step["path"][0][0] - step["path"][-1][0] > 0.01,
    "goes up on a head": lambda step, _: step["character"] == 1 and step["velocity"][1] > 1}


def in_turns(step):
    """Who stands on a head goes before the head goes up, and who walks goes last. Whom no own motion meets is not told."""
    step["turn"] = {0: 1, 1: 0, 2: 2}[step["character"]]
    if step["character"] == 0:
        step.pop("met", None)


def following(steps, k):
    """The next step of the same character."""
    return next(step for step in steps[k + 1:] if step.get("character") == steps[k].get("character"))


def corners_from(steps, k, first):
    """Of a step from a corner on, and of all that follow."""
    return steps[k]["path"][first:] + [corner for later in steps[k + 1:] for corner in later["path"]]


# These spoil a step. Each gets all steps, the number of the step, and the numbers of the row.

def end_moved(steps, k, by_x, by_y):
    """The way of a step ends elsewhere, and the next begins there."""
    end = steps[k]["path"][-1]
    end[0] += by_x
    end[1] += by_y
    following(steps, k)["path"][0][:2] = end[:2]


def detour(steps, k, x, y):
    """Between the first two corners of a way."""
    steps[k]["path"].insert(1, [x, y, steps[k]["path"][1][2] / 2])


def all_moved(steps, k, by_x, by_y, first_corner=1):
    """With what it touches there."""
    for corner in corners_from(steps, k, first_corner):
        corner[0] += by_x
        corner[1] += by_y
    for contact in steps[k]["contacts"]:
        contact["separation"] += by_y


def met_by(steps, k, ago, character, normal, side):
    """That one of the records before has met another at the same time."""
    steps[k - ago]["met"] = [{"character": character, "normal": normal, "fraction": steps[k]["met"][0]["fraction"], "side": side}]


def met_behind(steps, k):
    met = steps[k]["met"][0]
    met.update(normal=[-x for x in met["normal"]], side={"left": "right", "right": "left"}[met["side"]])


def head_goes_first(steps, k):
    steps[k]["turn"], steps[k - 1]["turn"] = 1, 0


def left_by_its_carrier(steps, k):
    way = [a - b for a, b in zip(*(steps[k - 1]["path"][i][:2] for i in (-1, 0)))]
    steps[k]["requested"] = [a - b for a, b in zip(steps[k]["requested"], way)]


def one_ulp_on(steps, k):
    for corner in corners_from(steps, k, 1):
        corner[1] = math.nextafter(corner[1], 9) if hasattr(math, "nextafter") else corner[1] + 2.0 ** -52


def hanging(steps, k, count):
    at = steps[k]["path"][0][:2]
    for held in steps[k:k + count]:
        held.update(path=[at + [0], at + [1]], velocity=[0, 0], contacts=[], grounded=False)


def refused(steps, k, why):
    steps[k] = {"step": steps[k]["step"], "input": steps[k]["input"], "refused": why}


def without_contacts_of(steps, k, name):
    steps[k]["contacts"] = [contact for contact in steps[k]["contacts"] if contact["collider"] != name]


def turned(steps, k, angle):
    contact = steps[k]["contacts"][0]
    (x, y), cos, sin = contact["normal"], math.cos(angle), math.sin(angle)
    contact["normal"] = [x * cos - y * sin, x * sin + y * cos]


def touched_out_of_nothing(steps, k):
    steps[k]["contacts"].append({"collider": "wall", "point": [3, steps[k]["path"][-1][1]], "normal": [-1, 0], "fraction": 0.5,
                                 "separation": 5e-7, "side": "right"})


def script_left(steps, k, name, by):
    """By what moves, or by a vertex of what turns; the next step begins there."""
    for moved, instant in ((steps[k], -1), (steps[k + 1], 0)):
        way = moved["movers"][name]
        (way["vertices"][instant][1] if "vertices" in way else way[instant])[1] += by


def part_changed(tree, how, path, value=None):
    """`put`, `plus`, `times` or `remove`, at the end of a path of keys."""
    *way, key = [int(key) if key.lstrip("-").isdigit() else key for key in path.split("/")]
    for step in way:
        tree = tree[step]
    if how == "remove":
        del tree[key]
    else:
        tree[key] = value if how == "put" else tree[key] + value if how == "plus" else tree[key] * value


def spoil(row, header, steps):
    """As spoilt.json says it."""
    how, *values = row["do"]
    if "in" in row:
        part_changed({"header": header, "steps": steps}[row["in"]], how, *values)
        return
    is_so = FIRST[row["at"]]
    first = next(k for k, step in enumerate(steps) if k > 2 and is_so(step, steps[k - 1]))
    if how in ("put", "plus", "times", "remove"):
        part_changed(steps[first], how, *values)
    else:
        globals()[how](steps, first, *values)


class Checking(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        files = [Path(cls.folder.name) / (scene["name"] + ".json") for scene in SPOILT["scenes"]]
        for file, scene in zip(files, SPOILT["scenes"]):
            write(file, [scene])
        cls.good = traces_of(COMMAND, cls.folder.name, *files, *SPOILT["built_in"])
        header, *steps = read(cls.good["turns"])
        for step in steps:
            in_turns(step)
        write(cls.good["turns"], [header, *steps])

    def expect_found(self, path, clause):
        """By the command."""
        status, out, error = call(COMMAND, "judge", path)
        self.assertEqual(status, 1, out + error)
        self.assertIn(f"\n  {clause} on ", out)

    def spoilt(self, *rows):
        """The file of a trace that is changed as rows say."""
        header, *steps = read(self.good[rows[0]["scene"]])
        before = copy.deepcopy((header, steps))
        for row in rows:
            spoil(row, header, steps)
        self.assertNotEqual(before, (header, steps), "nothing was changed")
        if header == before[0] and len(steps) == len(before[1]):  # what comes long after the first change is checked elsewhere
            count = header.get("characters", 1)
            first = next(k for k, (new, old) in enumerate(zip(steps, before[1])) if new != old)
            del steps[(first // count + 16) * count:]
        path = Path(self.folder.name) / "spoilt.jsonl"
        write(path, [header, *steps])
        return path

    def test_good_traces_hold(self):
        for scene, path in self.good.items():
            with self.subTest(scene):
                status, said, _ = call(*CHECKER, path)
                self.assertEqual(status, 0, said)
                self.assertIn("contacts, 0 violations", said)
                self.assertEqual(call(COMMAND, "judge", path)[0], 0)
                self.assertIn(" 0 broken of 21 clauses asked", call(COMMAND, "judge", "--all", path)[1])

    def expect_refused(self, row, says, *judges):
        """In one line, of a trace that cannot be read."""
        path = self.spoilt(row)
        for judge in judges:
            with self.subTest((row["do"], judge)):
                status, said, error = call(*judge, path)
                self.assertEqual((status, len(error.splitlines())), (2, 1), said + error)
                self.assertIn(says, error)

    def test_a_record_without_a_key_is_refused(self):
        parts = json.loads(SCHEMA.read_text(encoding="utf-8"))["$defs"]
        for key in parts["header"]["required"]:
            self.expect_refused({"scene": "yard", "in": "header", "do": ["remove", key]}, key, CHECKER, (COMMAND, "judge"))
        for key in parts["step"]["required"] + parts["step"]["oneOf"][1]["required"]:
            self.expect_refused({"scene": "yard", "in": "steps", "do": ["remove", f"0/{key}"]}, key, CHECKER, (COMMAND, "judge"))

    def test_what_breaks_the_schema_is_refused_at_its_place(self):
        for row in SPOILT["against_the_schema"]:
            self.expect_refused(row, row["says"], (COMMAND, "judge"))

    def test_turns_are_of_all_characters_or_none_and_each_of_one(self):
        for do in (["remove", "4/turn"], ["put", "4/turn", 1], ["put", "5/turn", 3]):  # one without, one twice, one too many
            self.expect_refused({"scene": "turns", "in": "steps", "do": do}, "step 1: ", CHECKER, (COMMAND, "judge"))

    def test_what_is_spoilt_is_found_and_named(self):
        for row in SPOILT["spoilt"]:
            with self.subTest(row["what"]):
                path = self.spoilt(row)
                status, said, error = call(*CHECKER, path)
                self.assertEqual(status, 1, said + error)
                self.assertIn(f": {row['clause']}: ", said)
                self.expect_found(path, row["clause"])

    def test_a_velocity_that_the_law_of_response_does_not_make_is_found(self):
        # Slower than wanted, and at a wall that stops it: it bounces, or falls more slowly than a wall lets it fall.
        for k, spoilt in ((0, -1), (1, 0.5)):
            path = self.spoilt({"scene": "yard", "at": "is at the wall", "do": ["put", f"velocity/{k}", spoilt]})
            self.expect_found(path, "velocity")
            self.assertRegex(call(COMMAND, "judge", path)[1], r"\n  velocity on .*: ends with .* the law makes ")

    def test_what_one_of_them_cannot_judge_the_other_does(self):
        for row in SPOILT["for_the_command"]:
            with self.subTest(row["what"]):
                path = self.spoilt(row)
                self.assertRegex(call(*CHECKER, path)[1], rf"not judged: .*{row['clause']} in \d+ steps")
                self.expect_found(path, row["clause"])

    def test_only_what_is_guaranteed_is_asked_for_unless_told(self):
        asked = [clause for clause in read(self.good["yard"])[0]["guarantees"] if clause != "wanted"]
        path = self.spoilt({"scene": "yard", "in": "header", "do": ["put", "guarantees", asked]},
                           {"scene": "yard", "at": "walks", "do": ["put", "requested/0", 0.5]})
        for judge, options, status in ((CHECKER, "", 0), (CHECKER, "--all", 1), (CHECKER, "--all --but wanted,speed_lost", 0),
                                       (CHECKER, "--clauses overlap,passage", 0), (CHECKER, "--clauses wanted", 1),
                                       ((COMMAND, "judge"), "", 0), ((COMMAND, "judge"), "--all", 1)):
            self.assertEqual(call(*judge, *options.split(), path)[0], status, (judge, options))

    def test_it_says_what_it_judged_and_what_not(self):
        _, said, _ = call(*CHECKER, self.good["turning_arm"])
        self.assertRegex(said, r"90 steps, \d+ contacts, 0 violations of \d+ clauses\n.*not judged: contact_missed in \d+ steps")


if __name__ == "__main__":
    COMMAND = sys.argv.pop(1)
    unittest.main()
