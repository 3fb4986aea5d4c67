#!/usr/bin/env python3
"""Validates what the command writes against the schemas that ship with it.

    check_schemas.py FOLDER_OF_SCHEMAS FILE...

A file of rows is told from a trace by its first line. Exit status: 0, 1 with the first fault of each file, 77 where
python3-jsonschema is missing.
"""
import json
import sys
from pathlib import Path

try:
    from jsonschema import Draft202012Validator
except ImportError:
    print("skipped: there is no python3-jsonschema here")
    sys.exit(77)


def validator(schema, part):
    return Draft202012Validator({"$ref": f"#/$defs/{part}", "$defs": schema["$defs"]} if part else schema)


def faults(path, rows, trace):
    text = Path(path).read_text(encoding="utf-8")
    if path.endswith(".json"):
        objects = [(1, json.loads(text), validator(rows, None))]
    else:
        lines = [json.loads(line) for line in text.splitlines()]
        is_trace = "paperproof_trace" in lines[0]
        first = validator(trace, "header") if is_trace else validator(rows, None)
        others = validator(trace, "step") if is_trace else validator(rows, "row")
        objects = [(k + 1, each, first if k == 0 else others) for k, each in enumerate(lines)]
    for line, each, check in objects:
        for fault in check.iter_errors(each):
            yield f"{path}:{line}: {'/'.join(map(str, fault.absolute_path))}: {fault.message[:200]}"


def main():
    rows, trace = (json.loads(Path(sys.argv[1], f"paperproof_{kind}.schema.json").read_text(encoding="utf-8"))
                   for kind in ("rows", "trace"))
    for schema in rows, trace:
        Draft202012Validator.check_schema(schema)
    bad = 0
    for path in sys.argv[2:]:
        for words in list(faults(path, rows, trace))[:1]:
            print(words)
            bad += 1
    print(f"{len(sys.argv) - 2} files, {bad} at fault")
    sys.exit(1 if bad else 0)


main()
