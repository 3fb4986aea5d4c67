"""For check_trace.py: whether a step hangs. It could have fallen, straight and far enough, and did not."""
from math import cos, hypot, inf, nextafter, radians

from trace_geometry import GAP, add, dot, less, size

LEAST_FALL = 1e-9  # less of a fall is none [m]
LEAST_OPENING = 2e-7  # narrower ones count as closed [m]
CLIMB_MARGIN = 1e-6  # ground that is so much steeper than the climb limit is ground [rad]
ANGLE = 1e-12  # normals are rounded


class Plane:
    """Displacements that keep clear of an edge on one side of it: those at least as far along the normal as the edge goes."""

    def __init__(self, normal, gap, moved):
        self.normal, self.gap = normal, gap
        self.bound = normal[0] * moved[0] + normal[1] * moved[1]

    def along(self, d):
        return self.normal[0] * d[0] + self.normal[1] * d[1] - self.bound

    def holds(self, d):
        return self.along(d) >= -ANGLE * (hypot(*d) + abs(self.bound))

    def room(self, aside):
        approach = -(self.normal[0] * aside[0] + self.normal[1] * aside[1])
        return self.gap / approach if approach > ANGLE else inf


def planes_beside(body, edge, moved):
    """Of all directions that separate a counter-clockwise body from an edge, the best first; where they overlap, the best
    one alone."""
    a, b = edge
    directions = [(a, b), (b, a)] + [(end, start) for start, end in zip(body, body[1:] + body[:1])]
    planes = []
    for start, end in directions:
        across = (end[1] - start[1], start[0] - end[0])
        length = size(across)
        gap = min(dot(across, corner) for corner in body) - max(dot(across, a), dot(across, b))
        planes.append(Plane((float(across[0]) / length, float(across[1]) / length), float(gap) / length, moved))
    planes.sort(key=lambda plane: -plane.gap)
    return [plane for plane in planes if plane.gap >= 0] or planes[:1]


def nearest_free(wanted, obstacles):
    """The nearest displacement that one plane of each obstacle holds, unless it leads into too narrow an opening."""
    def is_free(d):
        held = [[plane for plane in planes if plane.holds(d)] for planes in obstacles]
        if not all(held):
            return False
        length = hypot(*d)
        rooms = [min((max(plane.room(aside) for plane in planes) for planes in held), default=inf)
                 for aside in ((-d[1] / length, d[0] / length), (d[1] / length, -d[0] / length))] if length else [inf]
        return sum(rooms) >= LEAST_OPENING

    planes = [plane for planes in obstacles for plane in planes]
    candidates = [wanted]
    for i, p in enumerate(planes):
        off = p.along(wanted)
        candidates.append((wanted[0] - off * p.normal[0], wanted[1] - off * p.normal[1]))
        for q in planes[:i]:
            over = p.normal[0] * q.normal[1] - p.normal[1] * q.normal[0]
            if abs(over) > ANGLE:
                candidates.append(((p.bound * q.normal[1] - q.bound * p.normal[1]) / over,
                                   (q.bound * p.normal[0] - p.bound * q.normal[0]) / over))
    candidates.sort(key=lambda d: hypot(d[0] - wanted[0], d[1] - wanted[1]))
    return next((d for d in candidates if is_free(d)), None)


def hangs(step, path, body, edges_near, max_climb_degrees):
    """Whether the step could have fallen, and fell less than half of that.

    `edges_near(corner, before)` yields (edge, displacement of it in the step) of all that may hold a character at that corner,
    to which it came from the corner before."""
    wanted = (float(step["requested"][0]) - float(step["steered"]), float(step["requested"][1]))
    fell = float(path[0][1] - path[-1][1])
    largest = max(abs(float(x)) for x in path[0][:2])
    least = max(LEAST_FALL, nextafter(largest, inf) - largest)
    if not -wanted[1] > least or not fell < -wanted[1] / 2:
        return False
    ground = cos(radians(max_climb_degrees) + CLIMB_MARGIN)
    obstacles = []
    for before, corner in zip([path[0], *path], path):
        there = [add(corner[:2], point) for point in body]
        for edge, moved in edges_near(corner, before):
            planes = planes_beside(there, edge, moved)
            if planes[0].gap > GAP:
                continue
            if planes[0].gap < -GAP or any(plane.normal[1] >= ground for plane in planes):
                return False
            obstacles.append(planes)
    free = nearest_free(wanted, obstacles)
    fall = min(-free[1], -wanted[1]) if free else 0
    return fall > least and fell < fall / 2
