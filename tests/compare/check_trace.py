#!/usr/bin/env python3
"""Checks a trace of paperproof without any of its code: Python's standard library, exact fractions, nothing else.

    check_trace.py FILE.jsonl...

For every step:
- the way that was travelled, corner by corner, enters no solid that the character was not already in, and the step does
  not end inside one; what the trace calls an overlap at the start of a step is one;
- a step begins where the last one ended, unless the trace says that the character was put elsewhere.
For octagon_sweep in double, which promises more, also:
- the gap at every contact is above 0 and at most 1e-6 m, between the contact's point, which lies on the collider, and
  the character at a corner of its way;
- the fraction of the first contact is the time of impact of the exact motion, to 1e-6 m along the normal.

Every number of a trace is a double, and every double is a fraction: the answers are exact but where a tolerance is named.
Exit status: 0 all holds, 1 something does not (one line each), 2 not a trace.
"""
import json
import sys
from fractions import Fraction
from functools import lru_cache

GAP = Fraction(1, 10**6)  # largest gap at a contact, and largest error of an impact along its normal [m]
ROUNDING = 1e-8  # of a reported separation or contact point [m]: positions of 1e6 m are known to 1e-10
NEAR_PASS = Fraction(4, 10**7)  # a way that passes a solid this closely may be called a contact [m]
ZERO = Fraction(0)


def exact(points):
    return [tuple(map(Fraction, point)) for point in points]


def add(a, b):
    return (a[0] + b[0], a[1] + b[1])


def turn(a, b, c):
    """Above zero where a, b, c turn left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def hull(points):
    """Corners of the convex hull, counter-clockwise (Andrew's monotone chain)."""
    points = sorted(set(points))

    def half(ordered):
        chain = []
        for point in ordered:
            while len(chain) > 1 and turn(chain[-2], chain[-1], point) <= 0:
                chain.pop()
            chain.append(point)
        return chain[:-1]

    return half(points) + half(reversed(points))


def enters(a, b, convex):
    """Whether the segment a b has a point strictly inside a counter-clockwise convex polygon."""
    first, last = ZERO, Fraction(1)
    for u, v in zip(convex, convex[1:] + convex[:1]):
        at_a, at_b = turn(u, v, a), turn(u, v, b)
        if at_a <= 0 and at_b <= 0:
            return False
        if at_a <= 0 or at_b <= 0:
            crossing = at_a / (at_a - at_b)
            if at_a < at_b:
                first = max(first, crossing)
            else:
                last = min(last, crossing)
    return first < last


def inside(point, rings):
    """Whether a point that is on no edge lies inside an odd number of rings."""
    odd = False
    for ring in rings:
        for a, b in zip(ring, ring[1:] + ring[:1]):
            if (a[1] > point[1]) != (b[1] > point[1]) and (turn(a, b, point) > 0) == (b[1] > a[1]):
                odd = not odd
    return odd


class Collider:
    def __init__(self, entry):
        self.id = entry["id"]
        self.one_way = tuple(map(Fraction, entry["one_way"])) if "one_way" in entry else None
        self.rings = [exact(ring) for ring in [entry["polygon"]] + entry.get("holes", [])] if "polygon" in entry else []
        line = exact(entry.get("chain", []))
        self.edges = list(zip(line, line[1:])) + [
            edge for ring in self.rings for edge in zip(ring, ring[1:] + ring[:1])]
        points = [tuple(map(float, point)) for edge in self.edges for point in edge]
        self.low = [min(p[k] for p in points) for k in (0, 1)]
        self.high = [max(p[k] for p in points) for k in (0, 1)]

    def blocking_edges(self, body, way):
        """Of a one-way chain, the segments that a body on this way may not pass."""
        for a, b in self.edges:
            n = (a[1] - b[1], b[0] - a[0])
            facing = n[0] * self.one_way[0] + n[1] * self.one_way[1]
            if facing < 0:
                n, a, b = (-n[0], -n[1]), b, a
            against = n[0] * way[0] + n[1] * way[1] < 0
            if facing != 0 and against and all(turn(a, b, corner) >= 0 for corner in body):
                yield a, b


class Checker:
    def __init__(self, header):
        self.body = exact(header["points"])
        self.low = [float(min(corner[k] for corner in self.body)) for k in (0, 1)]
        self.high = [float(max(corner[k] for corner in self.body)) for k in (0, 1)]
        self.colliders = {entry["id"]: Collider(entry) for entry in header["colliders"]}
        self.promises = header["contender"] == "octagon_sweep" and header["scalar"] == "double"
        self.placed_anew = header.get("mode") == "lockstep"
        self.meets = lru_cache(maxsize=4096)(self.meets)

    def meets(self, name, start, way, grown=Fraction(1)):
        """Whether the open body meets a collider anywhere on a straight way: all its places are one convex polygon."""
        collider = self.colliders[name]
        # Doubles will do to tell what is far away: the margin is more than their rounding.
        for k in (0, 1):
            at, to = float(start[k]), float(start[k] + way[k])
            low, high = min(at, to) + 1.01 * self.low[k], max(at, to) + 1.01 * self.high[k]
            margin = 1e-9 * (1 + abs(low) + abs(high))
            if low > collider.high[k] + margin or high < collider.low[k] - margin:
                return False
        body = [add(start, scaled(corner, grown)) for corner in self.body]
        swept = body + [add(corner, way) for corner in body]
        edges = collider.edges if collider.one_way is None else collider.blocking_edges(body, way)
        swept = hull(swept)
        if any(enters(a, b, swept) for a, b in edges):
            return True
        middle = (sum(p[0] for p in swept) / len(swept), sum(p[1] for p in swept) / len(swept))
        return inside(middle, collider.rings)

    def check_way(self, step, path):
        allowed = step["start_overlap"]
        for name in allowed:
            if not self.meets(name, path[0], (ZERO, ZERO)):
                yield f"does not overlap {name} at the start, as it says"
        for name, collider in self.colliders.items():
            if name in allowed:
                continue
            for start, end in zip(path, path[1:]):
                if self.meets(name, start, (end[0] - start[0], end[1] - start[1])):
                    yield f"passes or enters {name} on its way from {show(start)} to {show(end)}"
            if collider.one_way is None and self.meets(name, path[-1], (ZERO, ZERO)):
                yield f"ends inside {name}"

    def check_contact(self, contact, path):
        n = contact["normal"]
        name = contact["collider"]
        if abs(n[0] ** 2 + n[1] ** 2 - 1) > 1e-12:
            yield f"has a normal that is no unit vector at {name}"
        point = tuple(map(Fraction, contact["point"]))
        if min(distance(point, a, b) for a, b in self.colliders[name].edges) > ROUNDING:
            yield f"has a contact point {show(point)} that is not on {name}"
        n = tuple(map(Fraction, n))
        reach = min(dot(n, corner) for corner in self.body)
        gaps = [dot(n, corner) + reach - dot(n, point) for corner in path]
        gap = min(gaps, key=lambda g: abs(g - Fraction(contact["separation"])))
        if abs(gap - Fraction(contact["separation"])) > ROUNDING:
            yield f"is nowhere {contact['separation']} m from {name}"
        if not 0 < gap <= GAP:
            yield f"keeps a gap of {float(gap)} m at {name}"

    def check_impact(self, contact, start, requested):
        name, n, t = contact["collider"], contact["normal"], Fraction(contact["fraction"])
        along = abs(dot(tuple(map(Fraction, n)), requested))
        if along == 0:
            yield f"has a contact with {name} that it does not move towards"
            return
        slack = GAP / along
        before, after = max(ZERO, t - slack), t + slack
        if t > slack and self.meets(name, start, scaled(requested, before)):
            yield f"meets {name} earlier than at {float(t)} of the step"
        if not self.meets(name, start, scaled(requested, after)):
            # Not by then, unless it passes so closely that it may be called a contact.
            nearest = min(distance((ZERO, ZERO), a, b) for a, b in zip(self.body, self.body[1:] + self.body[:1]))
            if not self.meets(name, start, scaled(requested, after), 1 + NEAR_PASS / Fraction(nearest)):
                yield f"does not meet {name} by {float(t)} of the step"

    def check(self, steps):
        """Yields (step, what is wrong)."""
        last = None
        for step in steps:
            if step["movers"]:
                raise ValueError("moving scenery is not known here")
            path = exact(corner[:2] for corner in step["path"])
            fractions = [corner[2] for corner in step["path"]]
            if fractions[0] != 0 or fractions[-1] != 1 or fractions != sorted(fractions):
                yield step, "has a way that does not go from fraction 0 to 1"
            if last not in (None, path[0]) and not step.get("respawn") and not self.placed_anew:
                yield step, f"begins at {show(path[0])}, not where the last one ended"
            last = path[-1]
            found = list(self.check_way(step, path))
            if self.promises:
                for contact in step["contacts"]:
                    found += self.check_contact(contact, path)
                if step["contacts"] and not step["start_overlap"]:
                    found += self.check_impact(step["contacts"][0], path[0], tuple(map(Fraction, step["requested"])))
            for words in found:
                yield step, words


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1]


def scaled(v, by):
    return (v[0] * by, v[1] * by)


def distance(point, a, b):
    """From a point to a segment, rounded once at the end."""
    way = (b[0] - a[0], b[1] - a[1])
    off = (point[0] - a[0], point[1] - a[1])
    share = min(max(dot(off, way) / dot(way, way), ZERO), Fraction(1))
    rest = (off[0] - share * way[0], off[1] - share * way[1])
    return float(dot(rest, rest)) ** 0.5


def show(point):
    return f"({float(point[0])}, {float(point[1])})"


def check_file(path):
    violations = steps = contacts = 0
    with open(path, encoding="utf-8") as file:
        header = json.loads(file.readline())
        if header.get("paperproof_trace") != 1:
            raise ValueError("not a trace of version 1")

        def counted():
            nonlocal steps, contacts
            for line in file:
                step = json.loads(line)
                steps += 1
                contacts += len(step["contacts"])
                yield step

        for step, words in Checker(header).check(counted()):
            print(f"{path}: step {step['step']} {words}")
            violations += 1
    print(f"{path}: {steps} steps, {contacts} contacts, {violations} violations")
    return violations


def main(paths):
    if not paths:
        print(__doc__)
        return 2
    try:
        return 1 if sum([check_file(path) for path in paths]) else 0
    except (OSError, ValueError, KeyError) as error:
        print(f"{paths}: {error!r}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
