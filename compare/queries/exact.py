#!/usr/bin/env python3
"""Answers questions of first contact in plain rational arithmetic, corner by edge: slow, short, and no other code.

usage: exact.py QUERIES.jsonl > ANSWERS.jsonl

It finds when the shape first touches a solid. That is the answer of every question that is not degenerate.
"""
import json
import sys
import time
from fractions import Fraction


def vector(pair, number=Fraction):
    return number(pair[0]), number(pair[1])


def minus(a, b):
    return a[0] - b[0], a[1] - b[1]


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1]


def edges(points, closed):
    return list(zip(points, points[1:] + points[:1])) if closed else list(zip(points, points[1:]))


def times(corner, way, edge):
    """When a corner that goes along `way` is on an edge that stands."""
    a, b = edge
    along = minus(b, a)
    speed = cross(along, way)
    if speed == 0:
        return
    time_of = cross(along, minus(a, corner)) / speed
    at = minus((corner[0] + time_of * way[0], corner[1] + time_of * way[1]), a)
    if 0 <= time_of < 1 and 0 <= dot(at, along) <= dot(along, along):
        yield time_of


def first_contact(query, number=Fraction):
    """A fraction of the way, or None where it is free. Fractions are exact, floats are fast."""
    position, way = vector(query["position"], number), vector(query["displacement"], number)
    shape = [minus(vector(point, number), (-position[0], -position[1])) for point in query["points"]]
    back = (-way[0], -way[1])
    found = []
    for solid in query["solids"]:
        rings = [solid.get("polygon", solid.get("chain"))] + solid.get("holes", [])
        for ring in rings:
            points = [vector(point, number) for point in ring]
            for edge in edges(points, "polygon" in solid):
                found += [t for corner in shape for t in times(corner, way, edge)]
            found += [t for corner in points for edge in edges(shape, True) for t in times(corner, back, edge)]
    return min(found, default=None)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        for line in file:
            query = json.loads(line)
            begin = time.perf_counter_ns()
            contact = first_contact(query)
            ns = time.perf_counter_ns() - begin
            print(json.dumps({"id": query["id"], "contact": None if contact is None else float(contact), "ns": ns}))


if __name__ == "__main__":
    main()
