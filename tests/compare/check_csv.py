#!/usr/bin/env python3
"""Rows as CSV are what the same rows are as JSON, read with nothing but Python's own csv.

usage: check_csv.py COMMAND FOLDER_TO_WORK_IN
"""
import csv
import json
import math
import os
import re
import subprocess
import sys

UNITS = ("_m", "_s", "_ns", "_deg", "_m_s", "_m_s2", "_bytes", "_kg", "_hz")


def flat(value, prefix=""):
    """The cells of a row by column, as the documentation of the format says."""
    cells = {}
    for key, inner in value.items():
        if isinstance(inner, dict):
            cells.update(flat(inner, prefix + key + "."))
        elif isinstance(inner, list):
            cells[prefix + key] = "; ".join(map(str, inner))
        else:
            cells[prefix + key] = inner
    return cells


def lines_of(path):
    """The lines of a CSV without the comments at its top, and what these say."""
    with open(path, newline="", encoding="utf-8") as file:
        lines = file.readlines()
    comments = [line for line in lines if line.startswith("#")]
    assert lines[:len(comments)] == comments, "a comment stands below the rows"
    return lines[len(comments):], dict(line[2:].rstrip("\r\n").split(": ", 1) for line in comments)


def same(text, value):
    if isinstance(value, bool):
        return text == ("true" if value else "false")
    if isinstance(value, (int, float)):
        return float(text) == value  # to the last bit
    return text == value


def check(command, arguments):
    for name in ("rows.csv", "rows.json"):
        subprocess.run([command, *arguments, "--quiet", "--rows", name], check=True)
    lines, environment = lines_of("rows.csv")
    rows = list(csv.DictReader(lines, strict=True))
    with open("rows.json", encoding="utf-8") as file:
        written = json.load(file)
    assert environment == written["environment"], environment
    # A reader that knows comments cuts a line at a # outside of quotes.
    for line in lines:
        assert "#" not in re.sub('"[^"]*"', "", line), f"cut short by a reader of comments: {line}"
    expected = [flat(row) for row in written["rows"]]
    for wanted in expected:
        if "knob" in wanted:
            wanted["contender"] += f"[{wanted['knob']}]"
    assert len(rows) == len(expected) > 0, (len(rows), len(expected))
    columns = list(rows[0])
    assert len(set(columns)) == len(columns), "a column stands there twice"
    numbers = 0
    for row, wanted in zip(rows, expected):
        assert None not in row and None not in row.values(), f"not as many cells as columns: {row}"
        for column in columns:
            if column in wanted:
                assert same(row[column], wanted[column]), (column, row[column], wanted[column])
                numbers += isinstance(wanted[column], (int, float))
            else:
                assert row[column] == "", f"{column} does not apply and has {row[column]!r}"
        assert set(wanted) <= set(columns), set(wanted) - set(columns)
    return columns, numbers, rows


def main():
    command, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
    os.makedirs(folder, exist_ok=True)
    os.chdir(folder)
    _, numbers, _ = check(command, ["compare", "article_bullet", "wedge_60", "--no-timing"])
    assert numbers > 500, f"only {numbers} numbers were compared"
    columns, *_ = check(command, ["sweep", "paper", "--vary", "speed=10,100", "--vary", "angle=45,90",
                                 "--contender", "mask,octagon_sweep"])
    parameters = [column for column in columns if column.startswith("parameters.")]
    assert {"parameters.speed_m_s", "parameters.thickness_m", "parameters.angle_deg"} <= set(parameters), parameters
    without = {column for column in parameters if not column.endswith(UNITS)}
    assert without == {"parameters.phase", "parameters.jump_rules"}, f"numbers without a unit: {without}"
    *_, rows = check(command, ["sweep", "paper", "--vary", "continuous=on,off", "--contender", "box2d"])
    assert [row["contender"] for row in rows] == [f"box2d[continuous={x}]" for x in ("on", "off")], rows


if __name__ == "__main__":
    main()
