#!/usr/bin/env python3
"""What the schema of a trace asks for, `paperproof judge` asks for, too: good traces hold, and one that breaks the schema in
one place is refused with status 2, in one line that says where. check_trace.py refuses a record without a key that it needs.

    trace_schema_test.py PAPERPROOF SCHEMA

The schema says what is tried: at each place of it a required key is taken out, a key is added, and a value becomes one that
its type, enum, const, limits or number of items forbid. The same is asked of the schema of scenes beside it, with `check`.
"""
import copy
import json
import sys
import tempfile
import unittest
from pathlib import Path

from judging import CHECKER, call, read, traces_of, write

SCENES = ("lift_up", "turning_arm", "thin_sensor", "characters_head_on", "land_on_circle", "article_bullet", "one_way_drop")
OF_ANOTHER_TYPE = {"object": 7, "array": 7, "string": 7, "boolean": 7, "number": "seven", "integer": 1.5}
# By what forbids it: values, of the schema's word and a good value.
FORBIDDEN = {"type": lambda of, _: OF_ANOTHER_TYPE[of], "enum": lambda *_: "no_such_word", "const": lambda *_: "no_such_word",
             "minimum": lambda least, _: least - 1, "maximum": lambda most, _: most + 1, "exclusiveMinimum": lambda above, _: above,
             "minItems": lambda least, value: value[:least - 1], "maxItems": lambda most, value: value[:1] * (most + 1)}
MADE_UP = {"respawn": True, "from": {"velocity": [0, 0]}}  # no scene of these puts anybody back


def without(at, key):
    return lambda value: parent(value, at).pop(key)


def with_value(at, new):
    def change(value):
        parent(value, at[:-1])[at[-1]] = new
    return change


def parent(value, at):
    for key in at:
        value = value[key]
    return value


class Places:
    """Walks a record beside its schema. `found` has for each place of the schema, and each thing that it asks for there, the
    first record that has it, with the change that breaks it."""

    def __init__(self, schema):
        self.defs, self.found = schema["$defs"], {}

    def walk(self, schema, value, where, at=(), line=None):
        if "$ref" in schema:
            where = schema["$ref"].rsplit("/", 1)[1]
            schema = self.defs[where]

        def tries(kind, change, *, key=""):
            self.found.setdefault((where, kind, key), (line, at + ((key,) if key else ()), change))

        for key in schema.get("required", []) + schema.get("else", {}).get("required", []):  # no step here is refused
            tries("required", without(at, key), key=key)
        if schema.get("additionalProperties") is False:
            tries("additionalProperties", with_value((*at, "no_such_key"), 7))
        for kind, breaks in FORBIDDEN.items():
            if at and isinstance(schema.get(kind), (str, int, float, list)) and schema[kind] != ["integer", "string"]:
                tries(kind, with_value(at, breaks(schema[kind], value)))
        known, others = schema.get("properties", {}), schema.get("additionalProperties")
        if isinstance(value, dict) and (known or others):
            for key, inner in value.items():
                self.walk(known.get(key, others), inner, f"{where}/{key if key in known else '*'}", (*at, key), line)
        if isinstance(value, list) and "items" in schema:
            for k, inner in enumerate(value):
                self.walk(schema["items"], inner, where + "/0", (*at, k), line)
        for choice in schema.get("oneOf", []):
            if choice.get("type") == ("object" if isinstance(value, dict) else "array"):
                self.walk(choice, value, f"{where}/{choice['type']}", at, line)
            elif "properties" in choice and choice["required"][0] in value:  # a closed alternative
                self.walk(choice, value, f"{where}/{choice['required'][0]}", at, line)


def required_in(schema):
    """How many keys are required, wherever it is."""
    if isinstance(schema, list):  # one of them without a type is an alternative
        return sum(required_in(inner) for inner in schema if isinstance(inner, dict) and "type" in inner)
    if not isinstance(schema, dict):
        return 0
    return len(schema.get("required", [])) + sum(required_in(inner) for key, inner in schema.items() if key != "if")


class SchemaOfTraces(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schema = json.loads(Path(SCHEMA).read_text(encoding="utf-8"))
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.traces = list(map(read, traces_of(COMMAND, cls.folder.name, *SCENES).values()))
        cls.traces[0][-1].update(MADE_UP)
        cls.traces[0][0]["plan"]["omitted"].append({"stage": "stairs", "reason": "none"})

    def judge(self, lines, judge=None):
        path = Path(self.folder.name) / "spoilt.jsonl"
        write(path, lines)
        return call(*(judge or (COMMAND, "judge")), path)

    def places(self):
        """What can be broken: how, which record stands there, where in it, and the trace up to it, broken."""
        places = Places(self.schema)
        for trace in self.traces:
            for k, record in enumerate(trace):
                places.walk(self.schema["$defs"]["step" if k else "header"], record, "step" if k else "header",
                            line=(trace, k))
        for (where, kind, key), ((trace, k), at, change) in places.found.items():
            spoilt = copy.deepcopy(trace[:k + 1])
            change(spoilt[k])
            yield (where, kind, key), k, at, spoilt if k else [*spoilt, trace[1]]

    def test_good_traces_are_read(self):
        for trace in self.traces:
            status, out, err = self.judge(trace)
            self.assertIn(status, (0, 1), out + err)

    def test_what_breaks_it_is_refused(self):
        tried = set()
        for place, k, at, lines in self.places():
            with self.subTest(place):
                status, out, err = self.judge(lines)
                self.assertEqual((status, len(err.splitlines())), (2, 1), out + err)
                self.assertIn(f"spoilt.jsonl:{k + 1}: ", err)
                if k and at != ("step",):
                    self.assertIn(f": step {lines[k]['step']}: ", err)
                if place[1:] == ("required", "paperproof_trace"):
                    self.assertIn('expected the header of a trace, with "paperproof_trace": 1', err)
                elif place[1] == "required":
                    self.assertIn(": /" + "/".join(map(str, at)) + ": expected this key", err)
                tried.add(place)
        required = {(where, key) for where, kind, key in tried if kind == "required"}
        self.assertEqual(len(required), sum(required_in(self.schema["$defs"][name]) for name in ("header", "step", "ride")))

    def test_a_refused_step_has_nothing_else(self):
        header, step = self.traces[0][:2]
        refused = {"step": 0, "input": {}, "refused": "no length", "dt": 0}
        self.assertEqual(self.judge([header, refused])[0], 0)
        for key in self.schema["$defs"]["step"]["else"]["required"]:
            status, _, err = self.judge([header, {**refused, key: step[key]}])
            self.assertEqual(status, 2)
            self.assertIn(f"spoilt.jsonl:2: step 0: /{key}: expected no such key", err)

    def test_the_checker_refuses_a_record_without_a_key(self):
        for place, _, at, lines in self.places():
            if place[1] == "required" and len(at) == 1 and place[0] in ("header", "step"):
                with self.subTest(place):
                    status, out, err = self.judge(lines, CHECKER)
                    self.assertEqual((status, len(err.splitlines())), (2, 1), out + err)
                    self.assertIn(place[2], err)


class SchemaOfScenes(unittest.TestCase):
    def test_what_breaks_it_is_refused_at_its_place(self):
        schema = json.loads(Path(SCHEMA).parents[1].joinpath("scenes/paperproof_scene.schema.json").read_text(encoding="utf-8"))
        scene = json.loads(Path(__file__).with_name("one_of_everything.json").read_text(encoding="utf-8"))
        places = Places(schema)
        places.walk(schema, scene, "scene")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "spoilt.json"
            for (where, kind, key), (_, at, change) in places.found.items():
                spoilt = copy.deepcopy(scene)
                change(spoilt)
                path.write_text(json.dumps(spoilt), encoding="utf-8")
                status, out, err = call(COMMAND, "check", path)
                with self.subTest((where, kind, key, at)):
                    self.assertEqual((status, len(err.splitlines())), (2, 1), out + err)
                    self.assertIn("spoilt.json: /" + "/".join(map(str, at[:-1])), err)
        self.assertEqual(len(places.found), 164, "so many things does the schema ask for in this scene")


if __name__ == "__main__":
    SCHEMA = sys.argv.pop(2)
    COMMAND = sys.argv.pop(1)
    unittest.main()
