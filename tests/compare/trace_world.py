"""The scenery of a trace for check_trace.py, and exact questions about it: what a body meets on its way."""
import itertools
from functools import lru_cache

from trace_geometry import (
    ZERO, Fraction, add, distance, dot, enters, exact, hull, inside, is_near, less, middle_of, scaled, shifted, sides, size,
    vector, way_from_segment)
from trace_one_way import lines_of, surfaces_of
from trace_turning import Way, comes_to_overlap, overlaps

STAYS = (ZERO, ZERO)
AT_ONCE = Fraction(1, 10**5)  # a turn at once takes less than this part of the time of what follows


def edges_of(rings, lines):
    return [edge for line in lines for edge in zip(line, line[1:])] + [edge for ring in rings for edge in sides(ring)]


def box_around(points, radius):
    """Its lower and its upper corner, in doubles."""
    points = [tuple(map(float, point)) for point in points]
    return ([pick(p[k] for p in points) + sign * float(radius) for k in (0, 1)] for pick, sign in ((min, -1), (max, 1)))


def wider(body, by):
    """A convex body with every side moved outwards by at least so many metres, and at most 1.5 times that."""
    corners = [(Fraction(x) * by, Fraction(y) * by) for x in (-1, 1) for y in (-1, 1)]
    return tuple(hull([add(point, corner) for point in body for corner in corners]))


class Collider:
    def __init__(self, entry):
        self.id = entry["id"]
        self.sensor = entry.get("sensor", False)
        self.one_way = vector(entry["one_way"]) if "one_way" in entry else None
        self.surface_speed = entry.get("surface_speed", 0)
        self.rings = [exact(ring) for ring in [entry["polygon"]] + entry.get("holes", [])] if "polygon" in entry else []
        self.lines = [exact(entry["chain"])] if "chain" in entry else []
        self.sizes = [len(ring) for ring in self.rings + self.lines]
        *centre, self.radius = vector(entry.get("circle", (0,)))
        self.centre = tuple(centre)
        self.points = [point for ring in self.rings + self.lines for point in ring] or [self.centre]
        self.vertex_count = len(self.points)
        if self.rings and self.one_way is not None:  # it has no inside
            self.lines, self.rings = lines_of(self.rings[0], self.one_way), []
        self.edges = [(self.centre, self.centre)] if self.radius else edges_of(self.rings, self.lines)
        self.low, self.high = box_around((end for edge in self.edges for end in edge), self.radius)
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
        above = {surface: surface.is_below(body) for surface in {surface for _, _, surface in self.segments}}
        return [(a, b) for a, b, surface in self.segments if above[surface]]


class Motion:
    """Of the movers during one step, by the ids of their colliders."""

    def __init__(self, step, colliders):
        movers = step["movers"].items()
        self.ends = {name: exact(ends) for name, ends in movers if not isinstance(ends, dict)}
        self.ways = {name: Way(ends, colliders[name]) for name, ends in movers if isinstance(ends, dict)}

    def turns(self, name):
        return name in self.ways

    def goes(self, name):
        """Whether it does not stay where it is."""
        if name in self.ways:
            vertices = self.ways[name].vertices
            return any(then != vertices[0] for then in vertices)
        return self.change(name) != STAYS

    def first_and_last(self):
        """Of everything that moves, where it is when the step begins and when it ends."""
        return {**self.ends, **{name: (way.vertices[0], way.vertices[-1]) for name, way in self.ways.items()}}

    def change(self, name):
        ends = self.ends.get(name)
        return less(ends[1], ends[0]) if ends else STAYS

    def change_at_end(self, name):
        """Of a step that goes all the time as its end does; None of what turns then."""
        return self.ways[name].change_at_end() if name in self.ways else self.change(name)

    def offset(self, name, fraction):
        return add(self.ends[name][0], scaled(self.change(name), fraction)) if name in self.ends else STAYS

    def edges(self, name, collider, fraction):
        """Of a collider at a moment."""
        if name in self.ways:
            return self.ways[name].edges(fraction)
        offset = self.offset(name, fraction)
        return [(add(a, offset), add(b, offset)) for a, b in collider.edges]

    def seen(self, name, corner):
        """A corner of a way as the collider sees it, which then stands still."""
        return less(corner[:2], self.offset(name, corner[2]))

    def parts(self):
        """Into how many shorter steps the step was divided, by the first: each begins with a turn at once, and they are
        equally long. After a crush the rest is not divided."""
        def first_of(k):
            return round(1 / k[2]) if len(k) > 2 and k[1] - k[0] < AT_ONCE * (k[2] - k[1]) else 1

        return max([1] + [first_of(way.instants) for way in self.ways.values()])

    def longest(self, name):
        """The longest way of a vertex, rounded [m]."""
        if name not in self.ways:
            return size(self.change(name))
        vertices = self.ways[name].vertices
        return max(sum(size(less(b[i], a[i])) for a, b in zip(vertices, vertices[1:])) for i in range(len(vertices[0])))


class World:
    def __init__(self, header):
        self.body = tuple(hull(exact(header["points"])))
        self.colliders = {entry["id"]: Collider(entry) for entry in header["colliders"]}
        self.solids = [name for name, collider in self.colliders.items() if not collider.sensor]
        self.too_close = 0  # ways past what turns of which nothing can be said
        self.meets = lru_cache(maxsize=8192)(self.meets)
        self.box_of = lru_cache(maxsize=64)(self.box_of)

    def find_surfaces(self, movers):
        """Of the one-way chains. What moves alike in the first step is taken for one mover."""
        chains = [(name, repr(movers[name]) if name in movers else None, line, collider.one_way)
                  for name, collider in self.colliders.items() if collider.one_way is not None
                  for line in collider.lines]
        for name, segments in surfaces_of(chains).items():
            self.colliders[name].segments = segments

    def box_of(self, body):
        return [(float(min(corner[k] for corner in body)), float(max(corner[k] for corner in body))) for k in (0, 1)]

    def is_beside(self, body, start, end, low, high):
        """Whether a way is beside a box. Doubles will do to tell: the margin is more than their rounding."""
        for k, (lower, upper) in enumerate(self.box_of(body)):
            at, to = float(start[k]), float(end[k])
            first, last = min(at, to) + lower, max(at, to) + upper
            margin = 1e-9 * (1 + abs(first) + abs(last))
            if first > high[k] + margin or last < low[k] - margin:
                return True
        return False

    def meets(self, name, start, way, body):
        """Whether the open body meets a collider anywhere on a straight way, as the collider sees it: all places of the
        body are one convex polygon."""
        collider = self.colliders[name]
        if self.is_beside(body, start, add(start, way), collider.low, collider.high):
            return False
        edges = collider.edges
        if collider.one_way is not None:
            edges = collider.blocking_edges(shifted(self.body, start))
        swept = hull(shifted(body, start) + shifted(body, add(start, way)))
        if collider.radius:
            return is_near(collider.centre, swept, collider.radius)
        return any(enters(a, b, swept) for a, b in edges) or inside(middle_of(swept), collider.rings)

    def met(self, name, motion, start, end, body=None):
        """Whether the body meets a collider between two corners (x, y, fraction) of a way; None where what turns is too
        close to tell."""
        body = body or self.body
        if not motion.turns(name):
            first, last = motion.seen(name, start), motion.seen(name, end)
            return self.meets(name, first, less(last, first), body)
        way = motion.ways[name]
        if self.colliders[name].one_way is not None:
            return False
        vertices = (vertex for vertices in way.vertices for vertex in vertices)
        if self.is_beside(body, start, end, *box_around(vertices, way.collider.radius)):
            return False
        if start == end:
            return overlaps(way, way.seen(start), list(body))
        found = comes_to_overlap(way, list(body), start, end)
        self.too_close += found is None
        return found

    def overlapped(self, motion, corner, body=None):
        """The solids that the body overlaps at a corner of a way."""
        return [name for name in self.solids if self.colliders[name].one_way is None
                and self.met(name, motion, corner, corner, body)]

    def edges_near(self, motion, corner, reach, body=None):
        """(collider, edge) of all solids whose boxes come that near to the body at a corner. Of a circle, a piece of the
        tangent that faces the body."""
        body = body or self.body
        box = self.box_of(body)
        for name in self.solids:
            collider = self.colliders[name]
            if not motion.turns(name):
                place = motion.seen(name, corner)
                if self.is_beside(body, place, place, [x - reach for x in collider.low], [x + reach for x in collider.high]):
                    continue
            edges = motion.edges(name, collider, corner[2])
            if collider.radius:
                yield name, self.tangent(collider, edges[0][0], corner, body)
                continue
            for a, b in edges:
                if all(float(min(a[k], b[k])) <= float(corner[k]) + box[k][1] + reach and
                       float(max(a[k], b[k])) >= float(corner[k]) + box[k][0] - reach for k in (0, 1)):
                    yield name, (a, b)

    def tangent(self, collider, centre, corner, body):
        ways = [way_from_segment(centre, a, b) for a, b in sides(shifted(body, corner[:2]))]
        nearest = min(ways, key=lambda way: dot(way, way))
        if nearest == STAYS:
            return centre, centre
        out = scaled(nearest, -1 / Fraction(size(nearest)))
        top, along = add(centre, scaled(out, collider.radius)), (-out[1], out[0])
        return add(top, scaled(along, -8)), add(top, scaled(along, 8))
