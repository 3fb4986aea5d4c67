#!/usr/bin/env python3
"""Checks a trace of paperproof without any of its code: Python's standard library, exact fractions, nothing else.

    check_trace.py FILE.jsonl...

For every step:
- the way that was travelled, corner by corner, enters no solid that the character was not already in, and the step does
  not end inside one; what the trace calls an overlap at the start of a step is one. What moves is looked at from where it
  is: its offset goes evenly from one end to the other while the fraction of the step goes from 0 to 1. Only a mover that
  the step names in `crush` may come into the character, and one-way chains are passed by a leg that begins above them
  (see trace_one_way.py) only where the step names them in `drop`;
- a step begins where the last one ended, unless the trace says that the character was put elsewhere; so does every mover,
  and every mover stands in every step;
- of several characters each has a record in every step, in order; no two come to overlap at any moment of their ways
  that did not when the step began (where the ways are samples: on the straight way from their start to their end).
For octagon_sweep in double, which promises more, also:
- every contact is as it says at one corner of the way that is no later than its fraction: there its point lies on the
  collider and on the character, to 1e-6 m, and the gap between the two along its normal is its separation, above 0 and
  at most 1e-6 m; it may be 0 where the scene put the character so, and neither of the two has moved since;
- the fraction of the first contact is the time of impact of the exact motion, to 1e-6 m along the normal; not that of a
  contact at the end of a leg that follows the ground down, which takes no time, nor, among movers, of what is touched
  where the step begins, nor where a mover pushes the character out of the requested way from there on;
- the sensors' events are those of the way, in order, with fractions that are right to 1e-6 m along it;
- no step hangs: what is wanted, less what the step's steering added, may lead down beside all that is within 1e-6 m of a
  corner of the way, and the step falls less than half of that (trace_hanging.py; not looked at beside what turns, nor in a
  step that begins inside a solid);
- two characters that met say so both, with opposite normals and the same fraction, and come to within 1e-6 m along them;
  where both had met nothing before, the fraction is the time of impact of their requested motions, as above.

What turns has its vertices at instants of the step, and each goes straight from one to the next (trace_turning.py).
Overlaps with it and ways through it are told exactly, but for a touch that takes more halvings of the time than to 1e-9
of a way: those are counted. The time of impact of its contacts is not looked at, nor its sensors and one-way chains.

Where a character that goes by whole squares is drawn in between two of them (`remainder`) is not looked at: nothing
collides there.

Every number of a trace is a double, and every double is a fraction: the answers are exact but where a tolerance is named.
Exit status: 0 all holds, 1 something does not (one line each), 2 not a trace.
"""
import itertools
import json
import sys
from fractions import Fraction
from functools import lru_cache

from trace_company import Company, first_event, goes_as_requested, meets_at_once, places_at
from trace_geometry import (
    GAP, NEAR_DROP, NEAR_PASS, ROUNDING, SAME, ZERO, add, circle_crossings, crossings, distance, dot, enters, exact, hull,
    inside, is_near, less, scaled, size, way_from_segment)
from trace_hanging import hangs
from trace_one_way import lines_of, surfaces_of
from trace_turning import Way, comes_to_overlap, overlaps


def edges_of(rings, lines):
    return [edge for line in lines for edge in zip(line, line[1:])] + [
        edge for ring in rings for edge in zip(ring, ring[1:] + ring[:1])]


class Collider:
    def __init__(self, entry):
        self.id = entry["id"]
        self.sensor = entry.get("sensor", False)
        self.one_way = tuple(map(Fraction, entry["one_way"])) if "one_way" in entry else None
        self.rings = [exact(ring) for ring in [entry["polygon"]] + entry.get("holes", [])] if "polygon" in entry else []
        self.lines = [exact(entry["chain"])] if "chain" in entry else []
        self.sizes = [len(ring) for ring in self.rings + self.lines]
        *centre, self.radius = exact([entry["circle"]])[0] if "circle" in entry else (0,)
        self.centre = tuple(centre)
        self.vertex_count = sum(self.sizes) or 1
        if self.rings and self.one_way is not None:  # it has no inside
            self.lines, self.rings = lines_of(self.rings[0], self.one_way), []
        self.edges = [(self.centre, self.centre)] if self.radius else edges_of(self.rings, self.lines)
        points = [tuple(map(float, point)) for edge in self.edges for point in edge]
        self.low = [min(p[k] for p in points) - float(self.radius) for k in (0, 1)]
        self.high = [max(p[k] for p in points) + float(self.radius) for k in (0, 1)]
        self.segments = []  # of a one-way chain, with their surfaces

    def rings_of(self, vertices):
        """Of a polygon that turns."""
        if not self.rings:
            return []
        ends = list(itertools.accumulate(self.sizes))
        return [vertices[end - size:end] for end, size in zip(ends, self.sizes)]

    def edges_of(self, vertices):
        """Of what turns, with its vertices in the order of their definition. A circle has one edge, which is its centre."""
        if self.radius:
            return [(vertices[0], vertices[0])]
        return edges_of(self.rings_of(vertices), [] if self.rings else [vertices])

    def distance(self, point, edges):
        """Of a point from its boundary, which has these edges at that moment."""
        if self.radius:
            return abs(size(less(point, edges[0][0])) - float(self.radius))
        return min(distance(point, a, b) for a, b in edges)

    def blocking_edges(self, body):
        """Of a one-way chain, the segments that a body may not pass on its way from here."""
        above = {}
        for a, b, surface in self.segments:
            if surface not in above:
                above[surface] = surface.is_below(body)
            if above[surface]:
                yield a, b


class Motion:
    """Of the movers during one step, by the ids of their colliders."""

    def __init__(self, step, colliders):
        movers = step["movers"].items()
        self.ends = {name: exact(ends) for name, ends in movers if not isinstance(ends, dict)}
        self.ways = {name: Way(ends, colliders[name]) for name, ends in movers if isinstance(ends, dict)}

    def turns(self, name):
        return name in self.ways

    def moves(self, name):
        return name in self.ends or name in self.ways

    def first_and_last(self):
        """Of everything that moves, where it is when the step begins and when it ends."""
        ends = {name: (way.vertices[0], way.vertices[-1]) for name, way in self.ways.items()}
        return {**self.ends, **ends}

    def change(self, name):
        ends = self.ends.get(name)
        return less(ends[1], ends[0]) if ends else (ZERO, ZERO)

    def offset(self, name, fraction):
        return add(self.ends[name][0], scaled(self.change(name), fraction)) if name in self.ends else (ZERO, ZERO)

    def edges(self, name, collider, fraction):
        """Of a collider at a moment."""
        if name in self.ways:
            return self.ways[name].edges(fraction)
        offset = self.offset(name, fraction)
        return [(add(a, offset), add(b, offset)) for a, b in collider.edges]

    def seen(self, name, corner):
        """A corner of a way as the collider sees it, which then stands still."""
        return less(corner[:2], self.offset(name, corner[2]))


class Checker:
    def __init__(self, header):
        self.characters = header.get("characters", 1)
        self.body = hull(exact(header["points"]))
        self.low = [float(min(corner[k] for corner in self.body)) for k in (0, 1)]
        self.high = [float(max(corner[k] for corner in self.body)) for k in (0, 1)]
        self.colliders = {entry["id"]: Collider(entry) for entry in header["colliders"]}
        self.max_climb = header.get("max_climb_degrees")
        self.promises = header["contender"] == "octagon_sweep" and header["scalar"] == "double"
        self.put = {}  # by character: its first place, or the one that it was put to since, and the movers' motion then
        self.too_close = 0  # ways past what turns of which nothing can be said
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
            edges = collider.blocking_edges([add(start, corner) for corner in self.body])
        swept = hull(swept)
        if collider.radius:
            return is_near(collider.centre, swept, collider.radius)
        if any(enters(a, b, swept) for a, b in edges):
            return True
        middle = (sum(p[0] for p in swept) / len(swept), sum(p[1] for p in swept) / len(swept))
        return inside(middle, collider.rings)

    def check_way(self, step, path, motion):
        allowed = step["start_overlap"]
        for name in allowed:
            if not self.may_overlap_at_start(name, path, motion):
                yield f"does not overlap {name} at the start, as it says"
        for name in step.get("crush", []):
            if not motion.moves(name):
                yield f"is crushed by {name}, which does not move"
        for name, collider in self.colliders.items():
            crushes = name in step.get("crush", []) and motion.moves(name)
            if name in allowed or crushes or collider.sensor:
                continue
            if motion.turns(name):
                yield from self.check_way_past_turning(name, path, motion)
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

    def may_overlap_at_start(self, name, path, motion):
        if motion.turns(name):
            return overlaps(motion.ways[name], motion.ways[name].seen(path[0]), self.body)
        return self.meets(name, motion.seen(name, path[0]), (ZERO, ZERO))

    def check_way_past_turning(self, name, path, motion):
        collider, way = self.colliders[name], motion.ways[name]
        if collider.one_way is not None:
            return
        for start, end in zip(path, path[1:]):
            found = not self.is_far(way, start, end) and comes_to_overlap(way, self.body, start, end)
            if found:
                yield f"passes or enters {name} on its way from {show(start)} to {show(end)}"
            elif found is None:
                self.too_close += 1
        if overlaps(way, way.seen(path[-1]), self.body):
            yield f"ends inside {name}"

    def is_far(self, way, start, end):
        """Whether all places of the body are beside all those of the vertices: doubles will do."""
        points = [tuple(map(float, vertex)) for vertices in way.vertices for vertex in vertices]
        for k in (0, 1):
            low = min(float(start[k]), float(end[k])) + 1.01 * self.low[k]
            high = max(float(start[k]), float(end[k])) + 1.01 * self.high[k]
            margin = 1e-9 * (1 + abs(low) + abs(high))
            margin += float(way.collider.radius)
            if low > max(p[k] for p in points) + margin or high < min(p[k] for p in points) - margin:
                return True
        return False

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
            sensor = self.colliders[name]
            found = []
            if near and sensor.radius:
                found = circle_crossings(start, way, self.body, sensor.centre, sensor.radius)
            elif near:
                found = crossings(start, way, self.body, sensor.edges)
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
            if not collider.sensor or motion.turns(name):
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
        now, before = motion.first_and_last(), last.first_and_last()
        if now.keys() != before.keys() or motion.ways.keys() != last.ways.keys():
            yield "has not the same movers as the step before"
        for name in now.keys() & before.keys():
            if now[name][0] != before[name][1]:
                yield f"has {name} begin elsewhere, not where it was"

    def check_contact(self, contact, path, motion, put):
        name, n = contact["collider"], tuple(map(Fraction, contact["normal"]))
        if abs(dot(n, n) - 1) > 1e-12:
            yield f"has a normal that is no unit vector at {name}"
        # Where a touch takes long to come the way may have other corners before the fraction.
        corners = [corner for corner in path if corner[2] <= Fraction(contact["fraction"]) + SAME]
        if not corners:
            yield f"has a contact with {name} at {contact['fraction']}, before the step"
            return
        yield from min((list(self.faults(contact, corner, motion, put)) for corner in reversed(corners)), key=len)

    def faults(self, contact, corner, motion, put):
        """Of a contact, if this is the corner where the character stopped before it."""
        name, n = contact["collider"], tuple(map(Fraction, contact["normal"]))
        place, point = corner[:2], tuple(map(Fraction, contact["point"]))
        edges = motion.edges(name, self.colliders[name], corner[2])
        # Along a side that nearly faces the character the middle of both its ends is a little off.
        if not self.colliders[name].distance(point, edges) <= 10 * ROUNDING * max(1, float(self.colliders[name].radius)):
            yield f"has a contact point {show(point)} that is not on {name}"
        body = [add(place, corner) for corner in self.body]
        if not min(distance(point, a, b) for a, b in zip(body, body[1:] + body[:1])) <= GAP + Fraction(ROUNDING):
            yield f"has a contact point {show(point)} with {name} that is not on the character"
        gap = dot(n, less(place, point)) + min(dot(n, corner) for corner in self.body)
        if not abs(gap - Fraction(contact["separation"])) <= ROUNDING:
            yield f"is nowhere {contact['separation']} m from {name}"
        first_place, first_motion = put
        first_edges = first_motion.edges(name, self.colliders[name], first_place[2])
        moved = less(place, first_place[:2])
        is_as_put = gap == 0 and edges == [(add(a, moved), add(b, moved)) for a, b in first_edges]
        if not (0 < gap <= GAP or is_as_put):
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

    def is_in_the_way(self, step, fraction):
        """Whether the requested motion leads until then to within 1e-6 m of a collider, which may turn it before that, and
        be no contact yet."""
        motion, (start, *_) = Motion(step, self.colliders), exact(step["path"])
        requested = tuple(map(Fraction, step["requested"]))

        def is_near(name):
            way = scaled(less(requested, motion.change(name)), Fraction(fraction))
            return motion.turns(name) or self.meets(name, motion.seen(name, start), way, self.grown_by(GAP))

        return any(is_near(name) for name, collider in self.colliders.items() if not collider.sensor)

    def edges_near(self, step, motion, others):
        """For `hangs`: edges whose box comes near the body at a corner, with how far they move in the step."""
        reach = 4 * float(GAP)

        def is_near(a, b, place):
            return all(float(min(a[k], b[k])) <= float(place[k]) + self.high[k] + reach and
                       float(max(a[k], b[k])) >= float(place[k]) + self.low[k] - reach for k in (0, 1))

        def blocks(collider, edge, places):
            """A one-way chain blocks from the corner, or from where the leg began that ended there."""
            if collider.one_way is None:
                return True
            bodies = [[add(place, corner) for corner in self.body] for place in places]
            return any(set(edge) == set(held) for body in bodies for held in collider.blocking_edges(body))

        def edges(corner, before):
            for name, collider in self.colliders.items():
                if collider.sensor or name in step.get("drop", []):
                    continue
                place, offset = motion.seen(name, corner), motion.offset(name, corner[2])
                moved = tuple(map(float, motion.change(name)))
                if collider.radius:
                    if self.meets(name, place, (ZERO, ZERO), self.grown_by(4 * GAP)):
                        yield tuple(add(end, offset) for end in self.tangent(collider, place)), moved
                    continue
                for edge in collider.edges:
                    if is_near(*edge, place) and blocks(collider, edge, (place, motion.seen(name, before))):
                        yield tuple(add(end, offset) for end in edge), moved
            for other in others:
                way = exact(other["path"])
                body = [add(places_at(way, corner[2])[-1], point) for point in self.body]
                moved = tuple(map(float, less(way[-1][:2], way[0][:2])))
                yield from ((edge, moved) for edge in zip(body, body[1:] + body[:1]) if is_near(*edge, corner))

        return edges

    def tangent(self, collider, place):
        """An edge that stands for a circle beside a body: so long that the body does not see where it ends."""
        body = [add(place, corner) for corner in self.body]
        ways = (way_from_segment(collider.centre, a, b) for a, b in zip(body, body[1:] + body[:1]))
        nearest = min(ways, key=lambda way: dot(way, way))
        out = scaled(nearest, -1 / Fraction(size(nearest)))
        top, along = add(collider.centre, scaled(out, collider.radius)), (-out[1], out[0])
        reach = 8 * Fraction(max(self.high[k] - self.low[k] for k in (0, 1)))
        return add(top, scaled(along, -reach)), add(top, scaled(along, reach))

    def check_progress(self, step, others):
        """Of octagon_sweep, which promises to fall where it can."""
        motion, path = Motion(step, self.colliders), exact(step["path"])
        told = "steered" in step and self.max_climb is not None and not step.get("crush")
        if not self.promises or not told or motion.ways or step["start_overlap"]:
            return
        if hangs(step, path, self.body, self.edges_near(step, motion, others), self.max_climb):
            yield "hangs: it could have fallen"

    def find_surfaces(self, movers):
        """Of the one-way chains. What moves alike in the first step is taken for one mover: a trace does not name them."""
        chains = [(name, repr(movers[name]) if name in movers else None, line, collider.one_way)
                  for name, collider in self.colliders.items() if collider.one_way is not None
                  for line in collider.lines]
        for name, segments in surfaces_of(chains).items():
            self.colliders[name].segments = segments

    def check(self, records):
        """Yields (step, what is wrong)."""
        last, last_motion, together = {}, {}, []
        records = iter(records)
        first = next(records, None)
        if first is not None:
            self.find_surfaces(first["movers"])
            records = itertools.chain([first], records)
        company = Company(self.body)
        for number, step in enumerate(records):
            who = step.get("character", 0)
            told = f"character {who} " if self.characters > 1 else ""
            if who != number % self.characters:
                yield step, f"has a record of character {who} where that of {number % self.characters} belongs"
            if who not in last or step.get("respawn"):
                self.put[who] = exact(step["path"])[0], Motion(step, self.colliders)
            for words in self.check_alone(step, last.get(who), last_motion.get(who), self.put[who]):
                yield step, told + words
            last[who], last_motion[who] = exact(step["path"])[-1][:2], Motion(step, self.colliders)
            together = [other for other in together if other["step"] == step["step"]]
            for other in together:
                for words in company.check(other, step, self.promises, self.is_in_the_way):
                    yield step, f"character {other['character']} {words}"
            together.append(step)
            if len(together) == self.characters:
                for one in together:
                    told = f"character {one.get('character', 0)} " if self.characters > 1 else ""
                    others = [other for other in together if other is not one]
                    for words in self.check_progress(one, others):
                        yield one, told + words

    def check_alone(self, step, last, last_motion, put):
        motion = Motion(step, self.colliders)
        path = exact(step["path"])
        fractions = [corner[2] for corner in step["path"]]
        if fractions[0] != 0 or fractions[-1] != 1 or fractions != sorted(fractions):
            yield "has a way that does not go from fraction 0 to 1"
        if last not in (None, path[0][:2]) and not step.get("respawn"):
            yield f"begins at {show(path[0])}, not where the last one ended"
        wrong = [words for way in motion.ways.values() for words in way.faults()]
        yield from wrong
        if wrong:
            return
        yield from self.check_movers(step, motion, last_motion)
        yield from self.check_way(step, path, motion)
        if not self.promises:
            return
        for contact in step["contacts"]:
            yield from self.check_contact(contact, path, motion, put)
        contacts = [contact for contact in step["contacts"] if not motion.turns(contact["collider"])]
        # Who met another before, or what turns, may have been turned aside; who is stuck does not go as requested.
        first = contacts and contacts[0]["fraction"] == first_event(step) and not meets_at_once(contacts[0], step)
        in_parts = any(len(way.instants) > 2 for way in motion.ways.values())  # so goes the character near what turns
        # A last leg without time follows the ground down: its contact is none of the requested motion.
        follows = path[-1][2] == path[-2][2] == 1 and first and contacts[0]["fraction"] == 1
        at = first and step.get("movers") and Fraction(contacts[0]["fraction"])
        # A mover that leaves it no room pushes it out of the way that was requested, from the start of the step.
        gives_way = at and at >= path[1][2] and not goes_as_requested(step, path[1][2])
        touched = at == 0 and step.get("movers")  # `check_contact` has seen that it is touched at the start
        as_wanted = not (in_parts or follows or gives_way or touched or step["start_overlap"] or step.get("crush") or step.get("stuck"))
        if first and as_wanted:
            requested = tuple(map(Fraction, step["requested"]))
            yield from self.check_impact(contacts[0], path[0], requested, motion)
        yield from self.check_sensors(step, path, motion)


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

        checker = Checker(header)
        for step, words in checker.check(counted()):
            print(f"{path}: step {step['step']} {words}")
            violations += 1
    close = f", too close to tell on {checker.too_close} ways past what turns" if checker.too_close else ""
    print(f"{path}: {steps} steps, {contacts} contacts, {violations} violations{close}")
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
