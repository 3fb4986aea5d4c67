#!/usr/bin/env python3
"""Scores answers to questions of first contact. It needs Python alone.

usage: score.py QUERIES.jsonl ANSWERS.jsonl...

An answer is a line {"id": 0, "contact": 0.53, "ns": 120}: the fraction of the way, null where the way is free; ns may be
left out. A first line may say of the method {"method": "GJK", "tolerance": 0.005, "float": true, "clock": "native"}. What
is wrong by no more than the tolerance [m] is counted apart: a stop where something is so near, and a way on which a shape
that is smaller by so much all around meets nothing. For numbers of 32 bits there is their rounding on top. The status is 1
where a contact was missed or comes late beyond that, or where an answer is not there.
"""
import json
import sys
from fractions import Fraction
from math import hypot, inf
from statistics import median

from exact import edges, first_contact

ALLOWED = 1e-6  # an answer may be so far off, along the way [m]
ROUNDINGS = 8 * 2.0**-24  # of the largest coordinate, seen from where the way begins


def lines_of(query):
    """Outlines and chains, and whether each is closed. A point is a complex number here, seen from where the way begins."""
    for solid in query["solids"]:
        for line in [solid.get("polygon", solid.get("chain"))] + solid.get("holes", []):
            yield [complex(*point) - complex(*query["position"]) for point in line], "polygon" in solid


def to_edge(point, a, b):
    share = ((point - a) * (b - a).conjugate()).real / (abs(b - a) ** 2 or 1)
    return abs(point - a - min(1, max(0, share)) * (b - a))


def distance(query, time):
    """From the shape, after so much of its way, to the nearest solid [m]."""
    shape = [complex(*point) + time * complex(*query["displacement"]) for point in query["points"]]
    return min(to_edge(point, *edge) for line, closed in lines_of(query)
               for points, others in ((shape, edges(line, closed)), (line, edges(shape, True)))
               for point in points for edge in others)


def smaller(pairs, by):
    """A convex shape whose edges all go inwards by so much."""
    points = [complex(*pair) for pair in pairs]
    inwards = [1j * (b - a) / abs(b - a) for a, b in edges(points, True)]
    moved = [point + by * (a + b) / (1 + (a * b.conjugate()).real)
             for point, a, b in zip(points, inwards[-1:] + inwards, inwards)]
    return [(point.real, point.imag) for point in moved]


def judge(query, said, method):
    """How far an answer is off, above zero where it is late [m], and how wrong: 0 not, 1 within the tolerance, 2 beyond it,
    3 beyond it although the way begins clear of it."""
    off = 0 if said == query["exact"] else (said - query["exact"]) * hypot(*query["displacement"])
    if abs(off) <= ALLOWED:
        return off, 0
    tolerance = method["tolerance"]
    if method["float"]:
        points = [complex(*query["displacement"])] + [point for line, _ in lines_of(query) for point in line]
        tolerance += ROUNDINGS * max(map(abs, points))
    if abs(off) <= tolerance or (off < 0 and distance(query, said) <= tolerance):
        return off, 1
    if off > 0 and tolerance:
        small = first_contact({**query, "points": smaller(query["points"], tolerance)}, float)
        if small is None or small >= said:
            return off, 1
    return off, 3 if distance(query, 0) > tolerance else 2


def row_of(kind, judged, times, method):
    late = [wrong for off, wrong in judged if off > 0]
    early = [wrong for off, wrong in judged if off < 0]
    errors = [abs(off) for off, _ in judged if off < inf] if kind == "positive" else []
    ns = f"{median(times):.0f}" if times else ""
    return [method["method"], f"{method['tolerance']:.3g}", kind, len(judged),
            sum(wrong > 0 for wrong in late), sum(wrong > 1 for wrong in late), late.count(3),
            sum(wrong > 0 for wrong in early), sum(wrong > 1 for wrong in early),
            *([f"{median(errors):.2g}", f"{max(errors):.2g}"] if errors else ["", ""]),
            *((ns, "") if method["clock"] == "native" else ("", ns))]


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        queries = [json.loads(line) for line in file]
    for query in queries:
        query["exact"] = float(Fraction(query["contact"])) if query["contact"] else inf
    rows = [["method", "tolerance, m", "questions", "answered", "missed or late", "beyond tolerance", "begun clear",
             "invented or early", "beyond tolerance", "median error, m", "worst error, m", "ns, native", "ns, WebAssembly"],
            ["---"] * 3 + ["--:"] * 10]
    status = 0
    for path in sys.argv[2:]:
        with open(path, encoding="utf-8") as file:
            said = [json.loads(line) for line in file]
        stated = said[0] if said and "id" not in said[0] else {}
        method = {"method": path, "tolerance": 0, "float": False, "clock": "native", **stated}
        answers = {answer["id"]: answer for answer in said if "id" in answer}
        for kind in ("positive", "negative", "degenerate"):
            asked = [query for query in queries
                     if kind == ("degenerate" if query["degenerate"] else "positive" if query["contact"] else "negative")]
            judged, times = [], []
            for query in asked:
                if answer := answers.get(query["id"]):
                    contact = answer["contact"]
                    judged.append(judge(query, inf if contact is None else contact, method))
                    times += [answer["ns"]] if "ns" in answer else []
                    if judged[-1][0] > 0 and judged[-1][1] > 1 and kind == "positive":
                        print(method["method"], answer, query["exact"], query["source"], file=sys.stderr)
            rows.append(row_of(kind, judged, times, method))
            status |= len(judged) < len(asked) or (kind == "positive" and rows[-1][5] > 0)
    for row in rows:
        print("| " + " | ".join(map(str, row)) + " |")
    return status


if __name__ == "__main__":
    sys.exit(main())
