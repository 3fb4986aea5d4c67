"""One-way chains as surfaces, for check_trace.py.

Chains of equal `one_way` that stand, or are of one mover, are joined where one ends and one begins as their segments run
(blocking normals on the left), and no more of them meet; they are cut where they do not go on across `one_way`. Each part
is a surface: its end segments go on straight. A body is above where its open interior is wholly on the `one_way` side of
that line; then, and only then, every real segment of the part is in its way. `cross(place, one_way)` ascends along every
segment whose blocking normal is on the left.
"""
from bisect import bisect_left, bisect_right

from trace_geometry import ZERO, cross, hull, less, sides, turn


class Surface:
    def __init__(self, edges, one_way):
        self.one_way = one_way
        self.line = [edges[0][0]] + [b for _, b in edges]
        self.places = [cross(v, one_way) for v in self.line]

    def edge_at(self, place):
        """The one that is passed there; beyond the ends the first or the last."""
        i = min(max(bisect_left(self.places, place), 1), len(self.line) - 1)
        return self.line[i - 1], self.line[i]

    def is_below(self, body):
        """Of a convex body, by its corners. Between two vertices the line is straight, and so is the rim of a body."""
        if any(turn(*self.edge_at(cross(corner, self.one_way)), corner) < 0 for corner in body):
            return False
        rim = [(a, b) for a, b in sides(hull(body)) if cross(less(b, a), self.one_way) > 0]
        places = [cross(corner, self.one_way) for corner in body]
        first, last = (bisect(self.places, end, 1, len(self.line) - 1)
                       for bisect, end in ((bisect_right, min(places)), (bisect_left, max(places))))
        return not any(all(turn(a, b, vertex) > 0 for a, b in rim) for vertex in self.line[first:last])


def lines_of(ring, one_way):
    """The lines of a one-way polygon: the runs of its edges that face where `one_way` points, by their corners."""
    if sum(cross(a, b) for a, b in sides(ring)) < 0:
        ring = ring[::-1]
    # Counter-clockwise a face is on the right: `cross` descends where it faces along `one_way`.
    edges = [(a, b, cross(less(b, a), one_way) < 0) for a, b in sides(ring)]
    start = next(i for i, (*_, faces) in enumerate(edges) if not faces)
    lines, before = [], False
    for a, b, faces in edges[start:] + edges[:start]:
        if faces:
            lines[-1:] = [lines[-1] + [b]] if before else lines[-1:] + [[a, b]]
        before = faces
    return lines


def surfaces_of(chains):
    """For each of some colliders, by name, its segments that block with their surfaces: (a, b, surface).

    `chains`: (name, mover, line, one_way); `mover` is the same for what goes along together, and None for what stands.
    """
    segments, after, ends = [], {}, {}  # a segment: [name, a, b, one_way]
    for name, mover, line, one_way in chains:
        before = ZERO
        for i, (a, b) in enumerate(zip(line, line[1:])):
            way = cross(less(b, a), one_way)
            forwards, number = way > 0, len(segments)
            if way != 0:
                segments.append([name, a, b, one_way] if forwards else [name, b, a, one_way])
                if before * way > 0:
                    after.update({number - 1: number} if forwards else {number: number - 1})
                for at, is_end, begins in ((a, i == 0, forwards), (b, i == len(line) - 2, not forwards)):
                    if is_end:
                        ends.setdefault((mover, one_way, at), ([], []))[begins].append(number)
            before = way
    for ending, beginning in ends.values():
        if len(ending) == len(beginning) == 1:
            after[ending[0]] = beginning[0]
    found = {name: [] for name, *_ in chains}
    for first in set(range(len(segments))) - set(after.values()):
        part = [first]
        while part[-1] in after:
            part.append(after[part[-1]])
        surface = Surface([segments[i][1:3] for i in part], segments[first][3])
        for i in part:
            name, a, b, _ = segments[i]
            found[name].append((a, b, surface))
    return found
