"""Ground and falling, for check_trace.py: both are tried by moving the body.

Ground: something is right under the body, along a direction that keeps the two apart. A step hangs where the body could
have gone some way down, straight, from every corner of its way, and did not: the directions that are tried are the one
that is wanted, and those along every edge of the body and of what is near. The farthest that a body can go on a
direction, for what it wants, is what it wants projected onto that direction.
"""
from math import cos, hypot, inf, nextafter, radians

from trace_geometry import GAP, ZERO, Fraction, add, dot, enters, hull, less, scaled, shifted, sides, size

GROUND = 7.01e-7  # farther away nothing holds [m]
NEAR = 1e-4  # edges nearer than this may be in the way [m]
LEAST_FALL = 1e-8  # less of a fall is none [m]
OPENING = Fraction(2, 10**7)  # narrower ones count as closed [m]
CLIMB_MARGIN = 1e-6  # [rad]


class Ground:
    def __init__(self, world, max_climb_degrees):
        self.world = world
        self.walkable = cos(radians(max_climb_degrees) + CLIMB_MARGIN)
        self.surely_walkable = cos(radians(max_climb_degrees) - CLIMB_MARGIN)

    def supports(self, motion, corner, up, before=None, others=()):
        """(collider, unit normal, how much that is along up, gap) of what is right under the body; `others`: edges of other
        characters. One-way chains hold from the corner, or from the one before."""
        places = shifted(self.world.body, corner[:2])
        edges = list(self.world.edges_near(motion, corner, NEAR)) + [(None, edge) for edge in others]
        for name, (a, b) in edges:
            if name and not self.holds(name, (a, b), motion, [corner, before or corner]):
                continue
            normals = [(end[1] - start[1], start[0] - end[0]) for start, end in [(a, b), (b, a)]]
            normals += [(u[1] - v[1], v[0] - u[0]) for u, v in sides(places)]  # into the body
            for n in normals:
                length = size(n)
                if length == 0 or float(dot(n, up)) <= 1e-9 * length:
                    continue
                gap = float(min(dot(n, p) for p in places) - max(dot(n, a), dot(n, b))) / length
                if not -1e-10 <= gap <= float(GAP) * 1.01:
                    continue
                down = scaled(n, -Fraction(1.5e-6) / Fraction(length))
                if enters(a, b, hull(places + shifted(places, down))):
                    yield name, scaled(n, 1 / Fraction(length)), float(dot(n, up)) / length, gap

    def holds(self, name, edge, motion, corners):
        collider = self.world.colliders[name]
        if collider.one_way is None:
            return True
        if motion.turns(name):
            return False
        for corner in corners:
            seen, offset = motion.seen(name, corner), motion.offset(name, corner[2])
            blocking = collider.blocking_edges(shifted(self.world.body, seen))
            if any(set(shifted(ends, offset)) == set(edge) for ends in blocking):
                return True
        return False

    def is_grounded(self, motion, corner, up, before, others):
        return any(gap <= GROUND for *_, gap in self.supports(motion, corner, up, before, others))

    def hangs(self, motion, path, up, unsteered, dropped, others):
        """Whether the step could have fallen, and fell less than half of that. None where something moves near by.
        `unsteered`: what is wanted but for steering."""
        fall = -float(dot(unsteered, up))
        fell = -float(dot(less(path[-1][:2], path[0][:2]), up))
        largest = max(abs(float(x)) for corner in path for x in corner[:2])
        least = max(LEAST_FALL, nextafter(largest, inf) - largest)
        if fall <= least or fell >= fall / 2:
            return False
        reach = hypot(*map(float, unsteered)) + NEAR
        if others or any(motion.goes(name) for corner in path for name, _ in self.world.edges_near(motion, corner, reach)):
            return None
        corners = [corner for k, corner in enumerate(path) if k == 0 or corner[:2] != path[k - 1][:2]]
        if any(along >= self.walkable for before, corner in zip([path[0]] + corners, corners)
               for *_, along, _ in self.supports(motion, corner, up, before)):
            return False
        falls = ((-float(dot(way, up)), way) for way in self.directions(motion, corners, unsteered, up))
        return any(could > least and fell < could / 2 and all(self.is_open(motion, corner, way, dropped) for corner in corners)
                   for could, way in falls)

    def directions(self, motion, corners, unsteered, up):
        """Ways that lead down: what is wanted, as far as it goes along each direction."""
        yield unsteered
        edges = [edge for corner in corners for _, edge in self.world.edges_near(motion, corner, NEAR)]
        seen = set()
        for a, b in edges + sides(self.world.body):
            along = less(b, a)
            if along == (ZERO, ZERO):
                continue
            way = scaled(along, dot(along, unsteered) / dot(along, along))
            if dot(way, up) < 0 and way not in seen:
                seen.add(way)
                yield way

    def is_open(self, motion, corner, way, dropped):
        """Whether the body can go that way from a corner, and has an opening of 2e-7 m to do so."""
        aside = scaled((-way[1], way[0]), OPENING / Fraction(size(way)))
        bodies = [tuple(hull([add(p, scaled(aside, Fraction(k, 2))) for p in self.world.body for k in shift]))
                  for shift in ((0, 2), (-2, 0), (-1, 1))]
        end = (*add(corner[:2], way), corner[2])

        def is_free(body):
            return all(name in dropped or self.world.met(name, motion, corner, end, body) is False
                       for name in self.world.solids)

        return is_free(self.world.body) and any(map(is_free, bodies))
