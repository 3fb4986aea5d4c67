#!/usr/bin/env python3
"""Both judges, check_trace.py and `paperproof judge`, find nothing in good traces, and what is wrong in traces that are
spoilt in one thing each.

    check_trace_test.py PAPERPROOF

PAPERPROOF is the command that writes the good ones. Every row of SPOILT is a scene, what is changed, and the clause that
must be named, with exit status 1.
"""
import copy
import json
import math
import sys
import tempfile
import unittest
from pathlib import Path

from judging import CHECKER, call, read, traces_of, write

SCHEMA = Path(__file__).parents[2] / "compare/records/paperproof_trace.schema.json"

# A character falls onto a floor, walks through a gate to a wall, comes back, jumps and rests; a lift goes up far away.
YARD = {
    "paperproof_scene": 1, "name": "yard", "pixels_per_metre": 32, "gravity": [0, -32], "dt": 1 / 64, "steps": 200,
    "character": {"position": [0, 1.625], "velocity": [0, 0], "walk_speed": 4, "acceleration": 64, "jump_speed": 8},
    "scenery": [{"id": "floor", "polygon": [[-10, -1], [10, -1], [10, 0], [-10, 0]]},
                {"id": "wall", "polygon": [[3, 0], [4, 0], [4, 3], [3, 3]]},
                {"id": "gate", "chain": [[1.5, 0], [1.5, 3]], "sensor": True}],
    "movers": [{"id": "lift", "polygon": [[-8, 0], [-6, 0], [-6, 0.25], [-8, 0.25]],
                "path": [{"t": 0, "at": [0, 0]}, {"t": 3, "at": [0, 3]}]}],
    "input": [{"step": 0, "move": 0}, {"step": 40, "move": 1}, {"step": 120, "move": -1}, {"step": 150, "move": 0},
              {"step": 180, "jump": True}, {"step": 182, "jump": False}]}
# A character falls onto a plank that turns slowly under it, walks down it and stays.
SEE_SAW = {
    "paperproof_scene": 1, "name": "see_saw", "pixels_per_metre": 32, "gravity": [0, -32], "dt": 1 / 64, "steps": 90,
    "character": {"position": [0, 1.625], "velocity": [0, 0], "walk_speed": 4, "acceleration": 64},
    "scenery": [{"id": "far", "polygon": [[-9, -9], [9, -9], [9, -8], [-9, -8]]}],
    "movers": [{"id": "plank", "polygon": [[-4, -0.5], [4, -0.5], [4, 0], [-4, 0]], "path": [{"t": 0, "at": [0, 0]}],
                "angle": [{"t": 0, "at": -0.02}, {"t": 2, "at": 0.02}, {"t": 4, "at": -0.02}], "loop": "loop"}],
    "input": [{"step": 0, "move": 0}, {"step": 30, "move": 1}, {"step": 50, "move": 0}]}
# A lift takes up a character, another one on its head, and a third that walks against it.
TURNS = {
    "paperproof_scene": 1, "name": "turns", "pixels_per_metre": 32, "gravity": [0, -32], "dt": 1 / 64, "steps": 40,
    "character": {"position": [0, 0.6250005], "velocity": [0, 0], "walk_speed": 4, "acceleration": 64},
    "characters": [{"position": [0, 1.875002], "velocity": [0, 0], "input": [{"step": 0, "move": 0}]},
                   {"position": [2, 0.6250005], "velocity": [0, 0], "input": [{"step": 0, "move": -1}]}],
    "scenery": [{"id": "far", "polygon": [[-9, -9], [9, -9], [9, -8], [-9, -8]]}],
    "movers": [{"id": "lift", "polygon": [[-3, -1], [3, -1], [3, 0], [-3, 0]],
                "path": [{"t": 0, "at": [0, 0]}, {"t": 0.25, "at": [0, 0]}, {"t": 0.75, "at": [0, 1]}]}],
    "input": [{"step": 0, "move": 0}]}
BUILT_IN = ("closing_ceiling", "one_way_drop", "turning_arm", "land_on_circle", "two_on_a_lift", "characters_head_on",
            "start_overlapping_deep")
STUCK = {
    "paperproof_scene": 1, "name": "stuck", "pixels_per_metre": 32, "gravity": [0, -32], "dt": 1 / 64, "steps": 4,
    "character": {"position": [0, 0], "velocity": [0, 0], "start_overlap": "resolve"},
    "scenery": [{"id": name, "polygon": [[x, y], [x + w, y], [x + w, y + h], [x, y + h]]} for name, x, y, w, h in (
        ("block", -2, -2, 4, 4), ("left", -9, -9, 7, 18), ("right", 2, -9, 7, 18), ("over", -2, 2, 4, 7), ("under", -2, -9, 4, 7))]}


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


def at(what, change):
    """Changes the first step that is so: gets the step, all steps and its number."""
    def spoil(header, steps):
        k = next(k for k, step in enumerate(steps) if k > 2 and FIRST[what](step, steps[k - 1]))
        change(steps[k], steps, k)
    return spoil


def put(*path, to):
    """Sets what is at the end of a path of keys; `to` is a value, or a function of the old one."""
    def change(step, *_):
        for key in path[:-1]:
            step = step[key]
        step[path[-1]] = to(step[path[-1]]) if callable(to) else to
    return change


def following(steps, k):
    """The next step of the same character."""
    return next(step for step in steps[k + 1:] if step.get("character") == steps[k].get("character"))


def end_moved(by_x, by_y):
    """The way of a step ends elsewhere, and the next begins there."""
    def change(step, steps, k):
        end = step["path"][-1]
        end[0] += by_x
        end[1] += by_y
        following(steps, k)["path"][0][:2] = end[:2]
    return change


def detour(x, y):
    """Between the first two corners of a way."""
    def change(step, *_):
        step["path"].insert(1, [x, y, step["path"][1][2] / 2])
    return change


def all_moved(by_x, by_y, first_corner=1):
    """Of a step from a corner on, and of all that follow, with what they touch there."""
    def change(step, steps, k):
        corners = step["path"][first_corner:] + [corner for later in steps[k + 1:] for corner in later["path"]]
        for corner in corners:
            corner[0] += by_x
            corner[1] += by_y
        for contact in step["contacts"]:
            contact["separation"] += by_y
    return change


def met_by(ago, character, normal, side):
    """That one of the records before has met another at the same time."""
    def change(step, steps, k):
        steps[k - ago]["met"] = [{"character": character, "normal": normal, "fraction": step["met"][0]["fraction"], "side": side}]
    return change


def head_goes_first(step, steps, k):
    step["turn"], steps[k - 1]["turn"] = 1, 0


def one_ulp_on(step, steps, k):
    for corner in step["path"][1:] + [corner for later in steps[k + 1:] for corner in later["path"]]:
        corner[1] = math.nextafter(corner[1], 9) if hasattr(math, "nextafter") else corner[1] + 2.0 ** -52


def hanging(count):
    def change(step, steps, k):
        for held in steps[k:k + count]:
            held["path"] = [step["path"][0][:2] + [0], step["path"][0][:2] + [1]]
            held.update(velocity=[0, 0], contacts=[], grounded=False)
    return change


def without_contacts_of(name):
    return put("contacts", to=lambda contacts: [contact for contact in contacts if contact["collider"] != name])


def turned(angle):
    return put("contacts", 0, "normal", to=lambda n: [n[0] * math.cos(angle) - n[1] * math.sin(angle),
                                                      n[0] * math.sin(angle) + n[1] * math.cos(angle)])


def touched_out_of_nothing(step, *_):
    y = step["path"][-1][1]
    step["contacts"].append({"collider": "wall", "point": [3, y], "normal": [-1, 0], "fraction": 0.5,
                             "separation": 5e-7, "side": "right"})


def script_left(name, by):
    """By what moves, or by a vertex of what turns; the next step begins there."""
    def change(step, steps, k):
        for moved, instant in ((step, -1), (steps[k + 1], 0)):
            way = moved["movers"][name]
            (way["vertices"][instant][1] if "vertices" in way else way[instant])[1] += by
    return change


SPOILT = [
    # What is spoilt, in which scene, how, the clause.
    ("a position in the floor", "yard", at("rests", end_moved(0, -0.01)), "overlap"),
    ("a leg through the wall", "yard", at("walks", detour(5, 1)), "passage"),
    ("a gap of 2e-6 m", "yard", at("rests", all_moved(0, 1.5e-6, 0)), "gap"),
    ("a fraction that is off by 1e-3", "yard", at("is at the wall", put("contacts", -1, "fraction", to=lambda t: t - 1e-3)),
     "time_of_impact"),
    ("a contact that is removed", "yard", at("rests", without_contacts_of("floor")), "contact_missed"),
    ("the wall is not named", "yard", at("is at the wall", without_contacts_of("wall")), "contact_missed"),
    ("a contact that is invented", "yard", at("walks", touched_out_of_nothing), "contact_invented"),
    ("a contact with what is no collider", "yard", at("rests", put("contacts", 0, "collider", to="gate")), "contact_invented"),
    ("a normal that is turned", "yard", at("rests", turned(0.1)), "normal"),
    ("a normal on the other side", "yard", at("rests", turned(math.pi)), "normal"),
    ("a normal that is none", "yard", at("rests", put("contacts", 0, "normal", to=[0, 1.1])), "normal"),
    ("an event of a sensor that is removed", "yard", at("is at the gate", lambda step, *_: step.pop("sensors")), "sensor"),
    ("an event that is another", "yard", at("is at the gate", put("sensors", 0, "change", to="exit")), "sensor"),
    ("an event at another time", "yard", at("is at the gate", put("sensors", 0, "fraction", to=lambda t: t - 1e-3)), "sensor"),
    ("a drift of one ulp at rest", "yard", at("rests", one_ulp_on), "rest"),
    ("a step that is refused for nothing", "yard", at("falls", lambda step, steps, k: steps.__setitem__(
        k, {"step": step["step"], "input": step["input"], "refused": "the input is not finite"})), "refusal"),
    ("hanging for 10 steps", "yard", at("falls", hanging(10)), "hanging"),
    ("horizontal speed that is lost", "yard", at("walks", put("velocity", 0, to=2)), "speed_lost"),
    ("horizontal way that is lost", "yard", at("walks", all_moved(-0.01, 0)), "speed_lost"),
    ("a fall that is lost", "yard", at("falls", put("velocity", 1, to=0)), "speed_lost"),
    ("a rise that is lost", "yard", at("rises", put("velocity", 1, to=0)), "speed_lost"),
    ("speed out of nothing", "yard", at("walks", put("velocity", 0, to=9)), "velocity"),
    ("a fall that is faster", "yard", at("falls", put("velocity", 1, to=lambda v: 2 * v)), "velocity"),
    ("not grounded on flat ground", "yard", at("rests", put("grounded", to=False)), "ground_missed"),
    ("grounded in the air", "yard", at("falls", put("grounded", to=True)), "ground_invented"),
    ("a motion that was not asked for", "yard", at("walks", put("requested", 0, to=lambda x: x / 2)), "wanted"),
    ("steering that was not", "yard", at("walks", put("steered", to=0.01)), "wanted"),
    ("an input that is another", "yard", at("walks", put("input", to={"move": -1})), "wanted"),
    ("a jump that was not pressed", "yard", at("rises", put("requested", 1, to=lambda y: y + 0.1)), "wanted"),
    ("a teleport between steps", "yard", at("falls", put("path", 0, 0, to=0.5)), "continuity"),
    ("another start", "yard", lambda header, _: header["starts"][0].update(position=[0, 2]), "continuity"),
    ("a run that is cut off", "yard", lambda _, steps: steps.pop(), "continuity"),
    ("a run that goes on", "yard", lambda header, _: header.update(steps=header["steps"] - 1), "continuity"),
    ("a respawn that is claimed", "yard", at("falls", put("respawn", to=True)), "continuity"),
    ("fractions that go back", "yard", at("is at the wall", put("path", -1, 2, to=0.5)), "continuity"),
    ("a lift that jumps", "yard", at("rests", put("movers", "lift", 0, 1, to=9)), "continuity"),
    ("a lift that leaves its script by 1 mm", "yard", at("rests", script_left("lift", 1e-3)), "mover_way"),
    ("a crush by what is far away", "yard", at("rests", put("crush", to=["lift"])), "crush"),
    ("a crush by what stands", "yard", at("rests", put("crush", to=["floor"])), "crush"),
    ("a crush before the ceiling is there", "closing_ceiling", at("rests", put("crush", to=["ceiling"])), "crush"),
    ("a crush that is not said", "closing_ceiling", at("is crushed", lambda step, *_: step.pop("crush")), "overlap"),
    ("stuck in nothing", "yard", at("rests", put("stuck", to=True)), "start_inside"),
    ("inside of what it is not", "yard", at("rests", put("start_overlap", to=["floor"])), "start_inside"),
    ("stuck beside a way out", "stuck", lambda header, _: header["colliders"].pop(), "start_inside"),
    ("a one-way ledge that is passed unasked", "one_way_drop", at("drops", lambda step, *_: step.pop("drop")), "one_way"),
    ("a drop through what is not there", "one_way_drop", at("rests", put("drop", to=["ledge"])), "one_way"),
    ("an arm that leaves its script by 1 mm", "turning_arm", at("touches", script_left("arm", 1e-3)), "mover_way"),
    ("an arm in which it ends", "turning_arm", at("touches", end_moved(0, -0.1)), "overlap"),
    ("a way through the arm", "turning_arm", at("touches", detour(0.6, -2)), "passage"),
    ("a position in a circle", "land_on_circle", at("touches", end_moved(0, -0.01)), "overlap"),
    ("a normal of a circle that is turned", "land_on_circle", at("touches", turned(0.1)), "normal"),
    ("one that walks into the other", "characters_head_on", at("meets", end_moved(0.3, 0)), "overlap"),
    ("one that passes the other", "characters_head_on", at("meets", detour(99, 0.7)), "passage"),
    ("one that met what is behind it", "characters_head_on", at("meets", put("met", 0, to=lambda met: {
        **met, "normal": [-x for x in met["normal"]], "side": {"left": "right", "right": "left"}[met["side"]]})), "contact_invented"),
    ("one that met earlier", "characters_head_on", at("meets", put("met", 0, "fraction", to=lambda t: t / 2)), "time_of_impact"),
    ("a way through one that stands", "turns", at("comes to another", detour(-2, 1.2)), "passage"),
    ("an end in one that went before", "turns", at("comes to another", end_moved(-0.1, 0)), "overlap"),
    ("a head that goes up before who stands on it", "turns", at("goes up on a head", head_goes_first), "passage"),
    ("a meeting that was none", "turns", at("walks to another", put("met", to=[
        {"character": 0, "normal": [1, 0], "fraction": 0.5, "side": "left"}])), "contact_invented"),
    ("a meeting with who came later", "turns", at("comes to another", met_by(2, 2, [-1, 0], "right")), "contact_invented"),
    ("a meeting that was later", "turns", at("comes to another", put("met", 0, "fraction", to=lambda t: t / 2)), "time_of_impact"),
    ("hanging for 10 steps above what turns", "see_saw", at("is just above", hanging(10)), "hanging"),
    ("grounded in the air above what turns", "see_saw", at("is just above", put("grounded", to=True)), "ground_invented"),
    ("not grounded on what turns", "see_saw", at("rides", put("grounded", to=False)), "ground_missed"),
    ("walking on what turns and not grounded", "see_saw", at("walks on the plank", put("grounded", to=False)), "ground_missed"),
    ("a normal of what turns that is turned", "see_saw", at("walks on the plank", turned(0.1)), "normal"),
    ("a rider that is not carried", "two_on_a_lift", at("rides up",
        put("requested", 1, to=lambda y: y - 0.02)), "wanted"),
    ("a rider that its carrier does not carry", "turns", at("rides up on a head", lambda step, steps, k: step.update(
        requested=[a - b + c for a, b, c in zip(step["requested"], steps[k - 1]["path"][-1], steps[k - 1]["path"][0])])), "wanted"),
    ("a rider that is slower than its way", "turns", at("rides up on a head",
        put("velocity", 0, to=lambda v: v + 0.5)), "velocity"),
    ("a rider that goes on faster than its carrier", "turns", at("rides up on a head",
        put("ride", "velocity", 1, to=lambda v: v + 0.5)), "velocity"),
    ("a ride on a head that is not there", "turns", at("stands on no head", lambda step, *_: step.update(
        ride={"character": 1 if step["character"] != 1 else 2, "velocity": [0, 0]})), "ground_invented"),
]


# The same; check_trace.py says that it does not judge it.
SPOILT_FOR_THE_COMMAND = [
    ("a fall that is lost above what turns", "see_saw", at("is just above", put("velocity", 1, to=0)), "speed_lost"),
    ("a way that is lost above what turns", "see_saw", at("is just above", end_moved(0, 0.01)), "speed_lost"),
    ("horizontal speed that is lost on what turns", "see_saw", at("walks on the plank", put("velocity", 0, to=2)), "speed_lost"),
]


class Checking(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        scenes = (YARD, STUCK, SEE_SAW, TURNS)
        files = [Path(cls.folder.name) / (scene["name"] + ".json") for scene in scenes]
        for file, scene in zip(files, scenes):
            write(file, [scene])
        cls.good = traces_of(COMMAND, cls.folder.name, *files, *BUILT_IN)
        header, *steps = read(cls.good["turns"])
        for step in steps:
            in_turns(step)
        write(cls.good["turns"], [header, *steps])

    def expect_found(self, path, clause):
        """By the command."""
        status, out, error = call(COMMAND, "judge", path)
        self.assertEqual(status, 1, out + error)
        self.assertIn(f"\n  {clause} on ", out)

    def spoilt(self, scene, spoil):
        """The file of a trace that is changed by `spoil`."""
        header, *steps = read(self.good[scene])
        before = copy.deepcopy((header, steps))
        spoil(header, steps)
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

    def refused(self, judge, lines):
        """What one line says of a trace that cannot be read."""
        path = Path(self.folder.name) / "spoilt.jsonl"
        write(path, lines)
        status, out, error = call(*judge, path)
        self.assertEqual((status, len(error.splitlines())), (2, 1), out + error)
        return error

    def test_a_record_without_a_key_is_refused(self):
        header, step = read(self.good["yard"])[:2]
        parts = json.loads(SCHEMA.read_text(encoding="utf-8"))["$defs"]
        for key in parts["header"]["required"]:
            without = {name: value for name, value in header.items() if name != key}
            for judge in (CHECKER, (COMMAND, "judge")):
                self.assertIn(key, self.refused(judge, [without, step]))
        for key in parts["step"]["required"] + parts["step"]["oneOf"][1]["required"]:
            without = {name: value for name, value in step.items() if name != key}
            for judge in (CHECKER, (COMMAND, "judge")):
                self.assertIn(key, self.refused(judge, [header, without]))

    def test_what_breaks_the_schema_is_refused_at_its_place(self):
        header, step = read(self.good["turning_arm"])[:2]
        way = step["movers"]["arm"]
        for change, says in (({"no_such_key": 1}, "/no_such_key: unknown key"), ({"velocity": [0]}, "/velocity: expected 2 entries"),
                             ({"step": -1}, "/step: expected 0 to"), ({"contacts": [{}]}, "/contacts/0/collider: expected this key"),
                             ({"movers": {}}, '/movers: expected the motion of "arm"'), ({"movers": {"arm": {}}}, "/movers/arm: expected exactly"),
                             ({"movers": {"arm": {**way, "k": [0.5, 1]}}}, "/movers/arm/k: expected fractions"),
                             ({"path": [[0, 0, 2]]}, "/path/0/2: expected a number from 0 to 1"), ({"up": [1, 1]}, "/up: expected a vector"),
                             ({"start_overlap": ["none"]}, "/start_overlap/0: expected the id"), ({"refused": "no"}, "expected exactly one")):
            with self.subTest(says):
                self.assertIn(says, self.refused((COMMAND, "judge"), [header, {**step, **change}]))
        refused = {"step": 0, "input": {}, "refused": "no length", "dt": 0}
        self.assertIn("/velocity: unknown key", self.refused((COMMAND, "judge"), [header, {**refused, "velocity": [0, 0]}]))

    def test_turns_are_of_all_characters_or_none_and_each_of_one(self):
        for what, spoil in (("one without", lambda _, steps: steps[4].pop("turn")), ("one twice", lambda _, steps: steps[4].update(turn=1)),
                            ("one too many", lambda _, steps: steps[5].update(turn=3))):
            with self.subTest(what):
                path = self.spoilt("turns", spoil)
                for judge in (CHECKER, (COMMAND, "judge")):
                    status, said, error = call(*judge, path)
                    self.assertEqual((status, len(error.splitlines())), (2, 1), said + error)
                    self.assertIn("step 1: ", error)

    def test_what_is_spoilt_is_found_and_named(self):
        for what, scene, spoil, clause in SPOILT:
            with self.subTest(what):
                path = self.spoilt(scene, spoil)
                status, said, error = call(*CHECKER, path)
                self.assertEqual(status, 1, said + error)
                self.assertIn(f": {clause}: ", said)
                self.expect_found(path, clause)

    def test_a_velocity_that_the_law_of_response_does_not_make_is_found(self):
        # Slower than wanted, and at a wall that stops it: it bounces, or falls more slowly than a wall lets it fall.
        for k, spoilt in ((0, -1), (1, 0.5)):
            path = self.spoilt("yard", at("is at the wall", put("velocity", k, to=spoilt)))
            self.expect_found(path, "velocity")
            self.assertRegex(call(COMMAND, "judge", path)[1], r"\n  velocity on .*: ends with .* the law makes ")

    def test_what_one_of_them_cannot_judge_the_other_does(self):
        for what, scene, spoil, clause in SPOILT_FOR_THE_COMMAND:
            with self.subTest(what):
                path = self.spoilt(scene, spoil)
                self.assertRegex(call(*CHECKER, path)[1], rf"not judged: .*{clause} in \d+ steps")
                self.expect_found(path, clause)

    def test_only_what_is_guaranteed_is_asked_for_unless_told(self):
        def spoil(header, steps):
            header["guarantees"].remove("wanted")
            at("walks", put("requested", 0, to=0.5))(header, steps)

        path = self.spoilt("yard", spoil)
        for judge, options, status in ((CHECKER, "", 0), (CHECKER, "--all", 1), (CHECKER, "--all --but wanted,speed_lost", 0),
                                       (CHECKER, "--clauses overlap,passage", 0), (CHECKER, "--clauses wanted", 1),
                                       ((COMMAND, "judge"), "", 0), ((COMMAND, "judge"), "--all", 1)):
            self.assertEqual(call(*judge, *options.split(), path)[0], status, (judge, options))

    def test_it_says_what_it_judged_and_what_not(self):
        _, said, _ = call(*CHECKER, self.good["turning_arm"])
        self.assertRegex(said, r"90 steps, \d+ contacts, 0 violations\n.*not judged: contact_missed in \d+ steps")


if __name__ == "__main__":
    COMMAND = sys.argv.pop(1)
    unittest.main()
