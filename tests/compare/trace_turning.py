"""What turns, for check_trace.py: each vertex goes on a straight line from one instant to the next.

Seen from the character, which stands still then. A part of the way is free where from each edge one line keeps it apart
all the time; else its middle is looked at, and then its halves, down to WIDTH.
"""
from bisect import bisect_right
from collections import deque

from trace_geometry import (
    ZERO, Fraction, add, between, cross, enters, exact, hull, inside, is_near, less, middle_of, scaled, shifted, sides,
    size, turn)

WIDTH = Fraction(1, 10**9)  # of the shortest part that is looked at, as a share of a straight way
MOST_PARTS = 2000  # that are looked at before it is called too close to tell: a touch takes about 60


class Way:
    """Of the vertices of a collider in one step."""

    def __init__(self, entry, collider):
        self.instants = list(map(Fraction, entry["k"]))
        self.vertices = [exact(vertices) for vertices in entry["vertices"]]
        self.collider = collider

    def faults(self):
        count = self.collider.vertex_count
        if self.instants[0] != 0 or self.instants[-1] != 1 or any(
                late <= early for early, late in zip(self.instants, self.instants[1:])):
            yield f"has {self.collider.id} turn at instants that do not ascend from 0 to 1"
        elif len(self.vertices) != len(self.instants) or any(len(vertices) != count for vertices in self.vertices):
            yield f"has {self.collider.id} turn without {count} vertices at each instant"

    def change_at_end(self):
        """How it would go in the step, if it went all the time as in the last straight stretch; None if it turns there."""
        ways = [less(late, early) for early, late in zip(*self.vertices[-2:])]
        if any(size(less(way, ways[0])) > 1e-12 for way in ways):
            return None
        return scaled(ways[0], 1 / (1 - self.instants[-2]))

    def at(self, fraction):
        """All vertices at a moment."""
        k = min(bisect_right(self.instants, fraction), len(self.instants) - 1) - 1
        share = (fraction - self.instants[k]) / (self.instants[k + 1] - self.instants[k])
        return [between(a, b, share) for a, b in zip(self.vertices[k], self.vertices[k + 1])]

    def edges(self, fraction):
        return self.collider.edges_of(self.at(fraction))

    def stretches(self, start, end):
        """Of a leg between two corners: (share of it where the stretch begins, and ends)."""
        length = end[2] - start[2]
        if length == 0:
            return [(ZERO, Fraction(1))]
        within = [(k - start[2]) / length for k in self.instants if start[2] < k < end[2]]
        shares = [ZERO] + within + [Fraction(1)]
        return list(zip(shares, shares[1:]))

    def seen(self, corner):
        """The vertices from a corner of the character's way."""
        return [less(vertex, corner[:2]) for vertex in self.at(corner[2])]


def overlaps(way, vertices, body):
    """Whether the body overlaps the collider, as it sees its vertices at one moment."""
    if way.collider.radius:
        return is_near(vertices[0], body, way.collider.radius)
    return any(enters(a, b, body) for a, b in way.collider.edges_of(vertices)) or inside(
        middle_of(body), way.collider.rings_of(vertices))


def stays_right(first, last, corner):
    """Whether a corner is at no time on the left of an edge that goes from `first` to `last`: the product of the edge and
    the way to the corner is a parabola, which lies above the least of its three control points, or above its vertex.
    """
    edges, ways = [less(b, a) for a, b in (first, last)], [less(corner, a) for a, _ in (first, last)]
    begin, end = -cross(edges[0], ways[0]), -cross(edges[1], ways[1])
    middle = -(cross(edges[0], ways[1]) + cross(edges[1], ways[0])) / 2
    return begin >= 0 and end >= 0 and (middle >= 0 or middle * middle <= begin * end)


def keeps_apart(first, last, body):
    """Whether one line separates the body from an edge all the time: along a side of the body, or along the edge."""
    ends = first + last
    if any(all(turn(u, v, end) <= 0 for end in ends) for u, v in sides(body)):
        return True
    if first[0] == first[1] and last[0] == last[1]:
        return False
    back = first[::-1], last[::-1]
    return any(all(stays_right(*edge, corner) for corner in body) for edge in ((first, last), back))


def may_meet(way, first, last, body):
    """Whether the body may overlap it while each vertex goes from a place of `first` to one of `last`."""
    pairs = zip(way.collider.edges_of(first), way.collider.edges_of(last))
    return not all(keeps_apart(*pair, body) for pair in pairs) or overlaps(way, first, body)


def comes_to_overlap(way, body, start, end):
    """Whether the body overlaps the collider at any moment of a leg; None where that is too close to tell."""
    parts, close = deque((way.seen(between(start, end, first)), way.seen(between(start, end, last)), last - first)
                         for first, last in way.stretches(start, end)), False
    if way.collider.radius:  # its centre goes straight, and so does the body
        return any(is_near(first[0], hull(body + shifted(body, less(first[0], last[0]))),
                           way.collider.radius) for first, last, _ in parts)
    for _ in range(MOST_PARTS):
        if not parts:
            return None if close else False
        first, last, length = parts.popleft()
        if not may_meet(way, first, last, body):
            continue
        middle = [scaled(add(a, b), Fraction(1, 2)) for a, b in zip(first, last)]
        if any(overlaps(way, vertices, body) for vertices in (middle, last)):
            return True
        if length <= WIDTH:
            close = True
        else:
            parts += [(first, middle, length / 2), (middle, last, length / 2)]
    return None
