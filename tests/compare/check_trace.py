#!/usr/bin/env python3
"""Checks a trace of paperproof without any of its code: Python's standard library, exact fractions, nothing else.

    check_trace.py FILE.jsonl...

For every step:
- the way that was travelled, corner by corner, enters no solid that the character was not already in, and the step does
  not end inside one; what the trace calls an overlap at the start of a step is one. What moves is looked at from where it
  is: its offset goes evenly from one end to the other while the fraction of the step goes from 0 to 1. Only a mover that
  the step names in `crush` may come into the character, and one-way chains are passed against their normal only where
  the step names them in `drop`;
- a step begins where the last one ended, unless the trace says that the character was put elsewhere; so does every mover,
  and every mover stands in every step;
- of several characters each has a record in every step, in order; no two come to overlap at any moment of their ways
  that did not when the step began (where the ways are samples: on the straight way from their start to their end).
For octagon_sweep in double, which promises more, also:
- the gap at every contact is above 0 and at most 1e-6 m, between the contact's point, which lies on the collider, and
  the character at a corner of its way;
- the fraction of the first contact is the time of impact of the exact motion, to 1e-6 m along the normal;
- the sensors' events are those of the way, in order, with fractions that are right to 1e-6 m along it;
- two characters that met say so both, with opposite normals and the same fraction, and come to within 1e-6 m along them;
  where both had met nothing before, the fraction is the time of impact of their requested motions, as above.

What turns (its ends have an angle as well) is not looked at: its places are no fractions.

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
NEAR_DROP = Fraction(2, 10**6)  # and one that passes a one-way chain this closely may be said to drop through it [m]
GRAZING = 1e-3  # an approach of less than this part of the relative motion grazes, and says little of when
ZERO = Fraction(0)


def exact(points):
    return [tuple(map(Fraction, point)) for point in points]


def add(a, b):
    return (a[0] + b[0], a[1] + b[1])


def less(a, b):
    return (a[0] - b[0], a[1] - b[1])


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
        self.sensor = entry.get("sensor", False)
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


class Motion:
    """Of the movers during one step, by the ids of their colliders."""

    def __init__(self, step):
        self.ends = {name: exact(ends) for name, ends in step["movers"].items()}

    def turns(self, name):
        return name in self.ends and len(self.ends[name][0]) == 3

    def change(self, name):
        ends = self.ends.get(name)
        return less(ends[1], ends[0]) if ends else (ZERO, ZERO)

    def offset(self, name, fraction):
        return add(self.ends[name][0], scaled(self.change(name), fraction)) if name in self.ends else (ZERO, ZERO)

    def seen(self, name, corner):
        """A corner of a way as the collider sees it, which then stands still."""
        return less(corner[:2], self.offset(name, corner[2]))


def crossings(start, way, body, edges):
    """Where on a straight way a corner of the body meets an edge, or an end of an edge one of the body."""
    pairs = [(add(start, corner), a, b, way) for corner in body for a, b in edges]
    sides = [(add(start, a), add(start, b)) for a, b in zip(body, body[1:] + body[:1])]
    pairs += [(end, a, b, scaled(way, -1)) for edge in edges for end in edge for a, b in sides]
    for point, a, b, moved in pairs:
        along = less(b, a)
        speed = moved[1] * along[0] - moved[0] * along[1]
        if speed != 0:
            yield -turn(a, b, point) / speed


def parts(one, other):
    """What two do at the same time, as (from, to) of each: ways of (x, y, fraction) from 0 to 1. Jumps, which take no
    time, come one after the other, those of the one first."""
    def at(way, t):
        """All corners of that moment, or the place between two."""
        corners = [corner[:2] for corner in way if corner[2] == t]
        if corners:
            return corners
        before = max(i for i, corner in enumerate(way) if corner[2] < t)
        a, b = way[before], way[before + 1]
        share = (t - a[2]) / (b[2] - a[2])
        return [add(a[:2], scaled(less(b, a), share))]

    times = sorted({corner[2] for corner in one + other})
    for t, following in zip(times, times[1:] + [None]):
        mine, theirs = at(one, t), at(other, t)
        for a, b in zip(mine, mine[1:]):
            yield (a, b), (theirs[0], theirs[0])
        for a, b in zip(theirs, theirs[1:]):
            yield (mine[-1], mine[-1]), (a, b)
        if following is not None:
            yield (mine[-1], at(one, following)[0]), (theirs[-1], at(other, following)[0])


def first_event(step):
    """The fraction of the earliest contact of a step with anything."""
    return min((event["fraction"] for event in step["contacts"] + step.get("met", [])), default=None)


class Company:
    """Several characters of one shape: they overlap where the difference of their places is inside `reach`."""

    def __init__(self, body):
        self.body = body
        self.reach = hull([less(a, b) for a in body for b in body])
        self.size = [float(max(corner[k] for corner in self.reach)) for k in (0, 1)]

    def meet(self, mine, theirs):
        """On two straight ways at the same time."""
        start, end = less(mine[0], theirs[0]), less(mine[1], theirs[1])
        for k in (0, 1):  # doubles tell what is far away
            a, b = float(start[k]), float(end[k])
            if min(a, b) > 1.01 * self.size[k] or max(a, b) < -1.01 * self.size[k]:
                return False
        return enters(start, end, self.reach)

    def width(self, n):
        return max(dot(n, corner) for corner in self.reach)

    def check(self, one, other, promises):
        """Two records of one step."""
        i, j = one["character"], other["character"]
        mine, theirs = exact(one["path"]), exact(other["path"])
        overlapped = self.meet((mine[0], mine[0]), (theirs[0], theirs[0]))
        for a, b in ((one, j), (other, i)):
            said = b in a.get("start_overlap_characters", [])
            if said != overlapped:
                yield f"and character {j}: {a['character']} says {said} of an overlap at the start that is {overlapped}"
        if not overlapped:
            if one.get("path_exact") is False:
                mine, theirs = [mine[0], mine[-1]], [theirs[0], theirs[-1]]
            if any(self.meet(*part) for part in parts(mine, theirs)):
                yield f"and character {j} come to overlap or pass through each other"
        if promises:
            yield from self.check_met(one, other)

    def check_met(self, one, other):
        j = other["character"]
        of_one = [met for met in one.get("met", []) if met["character"] == j]
        of_other = [met for met in other.get("met", []) if met["character"] == one["character"]]
        if [([-x for x in met["normal"]], met["fraction"]) for met in of_one] != [
                (met["normal"], met["fraction"]) for met in of_other]:
            yield f"and character {j} do not say the same of how they met"
            return
        for met in of_one:
            n = tuple(map(Fraction, met["normal"]))
            if abs(met["normal"][0] ** 2 + met["normal"][1] ** 2 - 1) > 1e-12:
                yield f"has a normal that is no unit vector at character {j}"
            moments = [(m[k], t[k]) for m, t in parts(exact(one["path"]), exact(other["path"])) for k in (0, 1)]
            gaps = [dot(n, less(m, t)) - self.width(n) for m, t in moments]
            if not any(0 < gap <= GAP for gap in gaps):
                yield f"and character {j} have met, and at no corner are within 1e-6 m: {[float(gap) for gap in gaps]}"
            if met["fraction"] == first_event(one) == first_event(other):
                yield from self.check_impact(one, other, met)

    def check_impact(self, one, other, met):
        n, t = tuple(map(Fraction, met["normal"])), Fraction(met["fraction"])
        mine, theirs = (tuple(map(Fraction, step["path"][0][:2])) for step in (one, other))
        wanted, by = (tuple(map(Fraction, step["requested"])) for step in (one, other))
        along = -dot(n, less(wanted, by))
        if along <= GRAZING * size(less(wanted, by)):
            return  # what holds one of them, a micrometre away, turns it into the other
        slack = GAP / along

        def meet_until(time, wider=ZERO):
            reach = less(scaled(n, -wider), (ZERO, ZERO))
            return self.meet((mine, add(add(mine, scaled(wanted, time)), reach)),
                             (theirs, add(theirs, scaled(by, time))))

        if t > slack and meet_until(t - slack):
            yield f"meets character {met['character']} earlier than at {float(t)} of the step"
        if not meet_until(t + slack, NEAR_PASS):
            yield f"does not meet character {met['character']} by {float(t)} of the step"


class Checker:
    def __init__(self, header):
        self.characters = header.get("characters", 1)
        self.body = hull(exact(header["points"]))
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
        edges = collider.edges
        if collider.one_way is not None:
            edges = collider.blocking_edges([add(start, corner) for corner in self.body], way)
        swept = hull(swept)
        if any(enters(a, b, swept) for a, b in edges):
            return True
        middle = (sum(p[0] for p in swept) / len(swept), sum(p[1] for p in swept) / len(swept))
        return inside(middle, collider.rings)

    def check_way(self, step, path, motion):
        allowed = step["start_overlap"]
        for name in allowed:
            if not motion.turns(name) and not self.meets(name, motion.seen(name, path[0]), (ZERO, ZERO)):
                yield f"does not overlap {name} at the start, as it says"
        for name in step.get("crush", []):
            if name not in motion.ends:
                yield f"is crushed by {name}, which does not move"
        for name, collider in self.colliders.items():
            crushes = name in step.get("crush", []) and name in motion.ends
            if name in allowed or crushes or collider.sensor or motion.turns(name):
                continue
            corners = [motion.seen(name, corner) for corner in path]
            if name in step.get("drop", []):
                yield from self.check_drop(name, corners)
                continue
            for i, (start, end) in enumerate(zip(corners, corners[1:])):
                if self.meets(name, start, less(end, start)):
                    yield f"passes or enters {name} on its way from {show(path[i])} to {show(path[i + 1])}"
            if collider.one_way is None and self.meets(name, corners[-1], (ZERO, ZERO)):
                yield f"ends inside {name}"

    def check_drop(self, name, corners):
        if self.colliders[name].one_way is None:
            yield f"drops through {name}, which is no one-way chain"
            return
        grown = self.grown_by(NEAR_DROP)
        if not any(self.meets(name, start, less(end, start), grown) for start, end in zip(corners, corners[1:])):
            yield f"does not drop through {name}, as it says"

    def grown_by(self, metres):
        """The factor by which every side of the body goes outwards by at least so much."""
        nearest = min(distance((ZERO, ZERO), a, b) for a, b in zip(self.body, self.body[1:] + self.body[:1]))
        return 1 + metres / Fraction(nearest)

    def sensor_events(self, name, corners):
        """(change, leg, fraction of the leg) of everything that happens to a sensor, which stands still."""
        states = []  # in turn at an instant and between two, with the leg and its fraction
        for leg, (start, end) in enumerate(zip(corners, corners[1:])):
            way = less(end, start)
            near = self.meets(name, start, way)
            found = crossings(start, way, self.body, self.colliders[name].edges) if near else []
            times = [ZERO] + sorted({t for t in found if 0 < t < 1}) + [Fraction(1)]
            for first, last in zip(times, times[1:]):
                for t in (first, (first + last) / 2):
                    at = add(start, scaled(way, t))
                    states.append((near and self.meets(name, at, (ZERO, ZERO)), leg, first if t == first else last))
        states.append((self.meets(name, corners[-1], (ZERO, ZERO)), len(corners) - 2, Fraction(1)))
        for i, (before, now) in enumerate(zip(states, states[1:])):
            if before[0] != now[0]:
                instant = before if i % 2 == 0 else now
                yield "enter" if now[0] else "exit", instant[1], instant[2]

    def check_sensors(self, step, path, motion):
        for name, collider in self.colliders.items():
            if not collider.sensor:
                continue
            corners = [motion.seen(name, corner) for corner in path]
            expected = []
            for change, leg, share in self.sensor_events(name, corners):
                expected.append((change, path[leg][2] + share * (path[leg + 1][2] - path[leg][2])))
            found = [(e["change"], Fraction(e["fraction"])) for e in step.get("sensors", []) if e["id"] == name]
            if [change for change, _ in found] != [change for change, _ in expected]:
                words = [f"{change} at {float(t)}" for change, t in expected] or ["nothing"]
                yield f"does not report {', '.join(words)} at the sensor {name}"
                continue
            length = sum(size(less(end, start)) for start, end in zip(corners, corners[1:]))
            for (change, reported), (_, right) in zip(found, expected):
                if not abs(reported - right) * Fraction(length) <= GAP:
                    yield f"has the {change} of {name} at {float(reported)}, not at {float(right)}"

    def check_movers(self, step, motion, last):
        if last is None:
            return
        if motion.ends.keys() != last.ends.keys():
            yield "has not the same movers as the step before"
        for name in motion.ends.keys() & last.ends.keys():
            if motion.ends[name][0] != last.ends[name][1]:
                yield f"has {name} begin at {show(motion.ends[name][0])}, not where it was"

    def check_contact(self, contact, path, motion):
        n = contact["normal"]
        name = contact["collider"]
        if abs(n[0] ** 2 + n[1] ** 2 - 1) > 1e-12:
            yield f"has a normal that is no unit vector at {name}"
        point = tuple(map(Fraction, contact["point"]))
        # The place that is touched is one of the moment when the character stopped before it: at a corner of its way.
        seen = [less(point, motion.offset(name, corner[2])) for corner in path]
        off, point = min((min(distance(at, a, b) for a, b in self.colliders[name].edges), at) for at in seen)
        if not off <= ROUNDING:
            yield f"has a contact point {show(point)} that is not on {name}"
        n = tuple(map(Fraction, n))
        reach = min(dot(n, corner) for corner in self.body)
        gaps = [dot(n, motion.seen(name, corner)) + reach - dot(n, point) for corner in path]
        gap = min(gaps, key=lambda g: abs(g - Fraction(contact["separation"])))
        if abs(gap - Fraction(contact["separation"])) > ROUNDING:
            yield f"is nowhere {contact['separation']} m from {name}"
        if not 0 < gap <= GAP:
            yield f"keeps a gap of {float(gap)} m at {name}"

    def check_impact(self, contact, start, requested, motion):
        name, n, t = contact["collider"], contact["normal"], Fraction(contact["fraction"])
        start = motion.seen(name, start)
        requested = less(requested, motion.change(name))
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
            if not self.meets(name, start, scaled(requested, after), self.grown_by(NEAR_PASS)):
                yield f"does not meet {name} by {float(t)} of the step"

    def check(self, records):
        """Yields (step, what is wrong)."""
        last, last_motion, together = {}, {}, []
        company = Company(self.body)
        for number, step in enumerate(records):
            who = step.get("character", 0)
            told = f"character {who} " if self.characters > 1 else ""
            if who != number % self.characters:
                yield step, f"has a record of character {who} where that of {number % self.characters} belongs"
            for words in self.check_alone(step, last.get(who), last_motion.get(who)):
                yield step, told + words
            last[who], last_motion[who] = exact(step["path"])[-1][:2], Motion(step)
            together = [other for other in together if other["step"] == step["step"]]
            for other in together:
                for words in company.check(other, step, self.promises):
                    yield step, f"character {other['character']} {words}"
            together.append(step)

    def check_alone(self, step, last, last_motion):
        motion = Motion(step)
        path = exact(step["path"])
        fractions = [corner[2] for corner in step["path"]]
        if fractions[0] != 0 or fractions[-1] != 1 or fractions != sorted(fractions):
            yield "has a way that does not go from fraction 0 to 1"
        if last not in (None, path[0][:2]) and not step.get("respawn") and not self.placed_anew:
            yield f"begins at {show(path[0])}, not where the last one ended"
        yield from self.check_movers(step, motion, last_motion)
        yield from self.check_way(step, path, motion)
        if not self.promises:
            return
        for contact in step["contacts"]:
            yield from self.check_contact(contact, path, motion)
        # Who met another before may have been turned aside.
        first = step["contacts"] and step["contacts"][0]["fraction"] == first_event(step)
        if first and not step["start_overlap"] and not step.get("crush"):
            requested = tuple(map(Fraction, step["requested"]))
            yield from self.check_impact(step["contacts"][0], path[0], requested, motion)
        yield from self.check_sensors(step, path, motion)


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
    return size(rest)


def size(v):
    """The length of a vector, rounded once."""
    return float(dot(v, v)) ** 0.5


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
