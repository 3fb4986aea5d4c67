"""Whether there was room where a trace says that a mover crushed, for check_trace.py.

Room is a free place at the end of the step, at the end of a straight way that meets nothing (the way takes what is left of
the step, and what moves goes on meanwhile), no longer than the longest motion of a crusher's vertex and 0.25 m; and no
farther than that from where the character ended. The way begins at a corner of the travelled way, or where the crusher
touches the character. Openings of less than 2e-7 m are closed.

The places that are looked at are those where the rims of the space that each edge takes from the body cross, the middles
between two crossings, and a fan. They are guessed in doubles, and each is tried exactly: whoever finds one has proved
that there is room. None found is no proof that there is none.
"""
from itertools import islice
from math import cos, hypot, pi, sin

from trace_geometry import ZERO, Fraction, add, between, hull, less, scaled, sides, turn, vector
from trace_world import wider

BEYOND = 0.25  # how far may be pushed beyond the crusher's own motion [m]
CLEAR = Fraction(1, 10**7)  # half of the narrowest opening [m]
LEFT = 1.000001  # guesses keep so much more
FAN = 24  # directions
STRIDES = (0.02, 0.1, 0.25, 0.5, 0.75, 0.98)  # of the longest way
MOST_TRIED = 400


def is_in(point, convex, low, high):
    return (low[0] < point[0] < high[0] and low[1] < point[1] < high[1]
            and all(turn(a, b, point) > 1e-12 for a, b in sides(convex)))


def guesses(world, motion, at, reach):
    """Displacements from `at` (x, y, 1), the nearest first. A rim is its start and its way to the end."""
    body = wider(world.body, CLEAR * Fraction(LEFT))
    taken = []
    for _, edge in world.edges_near(motion, at, reach, body):
        ends = [less(end, at[:2]) for end in edge]
        # Around nothing larger than the reach: what lies beyond does not matter, and doubles are fine near zero.
        taken.append([tuple(map(float, p)) for p in hull([less(end, corner) for end in ends for corner in body])])
    rims = [(start, less(end, start)) for ring in taken for start, end in sides(ring) if start != end]
    found = [(0.0, 0.0)] + [(d * reach * cos(2 * pi * k / FAN), d * reach * sin(2 * pi * k / FAN)) for k in range(FAN) for d in STRIDES]
    for rim in rims:
        shares = crossings(rim, rims)
        shares += [(p + q) / 2 for p, q in zip(shares, shares[1:])]
        found += [add(rim[0], scaled(rim[1], share)) for share in shares]
    near = sorted({d for d in found if hypot(*d) <= reach}, key=lambda d: hypot(*d))
    boxes = [tuple(tuple(pick(axis) for axis in zip(*ring)) for pick in (min, max)) for ring in taken]
    return (d for d in near if not any(is_in(d, ring, *box) for ring, box in zip(taken, boxes)))


def crossings(rim, rims):
    """Where others cross a rim, as shares of it, in order; with its ends and the place nearest to the origin."""
    (x, y), (along, up) = rim
    shares = [0.0, 1.0, min(max(-(x * along + y * up) / (along * along + up * up), 0.0), 1.0)]
    # Plain products: millions of pairs are looked at.
    for (other_x, other_y), (other_along, other_up) in rims:
        off_x, off_y = x - other_x, y - other_y
        begin = other_along * off_y - other_up * off_x
        end = begin + other_along * up - other_up * along
        if (begin > 0) == (end > 0):
            continue
        share = begin / (begin - end)
        place = other_along * (off_x + share * along) + other_up * (off_y + share * up)
        if 0 <= place <= other_along * other_along + other_up * other_up:
            shares.append(share)
    return sorted(shares)


class Room:
    def __init__(self, world, motion, sides, others_free):
        """`sides`: by collider, the body's place as the collider saw it when it was last free of what it overlaps now.
        `others_free(way)`: whether the other characters leave a way free."""
        self.world, self.motion, self.sides, self.others_free = world, motion, sides, others_free

    def starts(self, path, crushers):
        """(corners of the way so far) where a way may begin: no later than something that crushes is met."""
        for k, (corner, following) in enumerate(zip(path, path[1:])):
            if corner[2] < 1:
                yield path[:k + 1]
            if any(self.world.met(name, self.motion, corner, following) is not False for name in crushers):
                touch = self.touched(corner, following, crushers)
                if touch and corner[2] < touch[2] < 1:
                    yield path[:k + 1] + [touch]
                return

    def touched(self, corner, following, crushers):
        """The last place on a leg that is known to come before the crushers."""
        first, last = ZERO, Fraction(1)
        for _ in range(40):
            middle = (first + last) / 2
            there = between(corner, following, middle)
            if any(self.world.met(name, self.motion, corner, there) is not False for name in crushers):
                last = middle
            else:
                first = middle
        return between(corner, following, first) if first else None

    def find(self, path, crushers):
        """The end of a way, or None."""
        reach = max(self.motion.longest(name) for name in crushers) + BEYOND
        ends = (self.straight(so_far, Fraction(1), reach, path[-1]) for so_far in self.starts(path, crushers))
        return next(filter(None, ends), None)

    def straight(self, so_far, until, reach, around=None):
        """The end of a free straight way from the last of the corners so far, at that fraction, or None; with `around` it is
        no farther than the reach from there."""
        start = so_far[-1]
        # Each wider body begins where the body is: what it overlaps there it need not be clear of.
        body = wider(self.world.body, CLEAR)
        inside = self.world.overlapped(self.motion, start)
        close = self.world.overlapped(self.motion, start, body)
        ends = ((*add(start[:2], vector(d)), until) for d in guesses(self.world, self.motion, (*start[:2], until), reach))
        near = (end for end in ends if not around or hypot(*map(float, less(end[:2], around[:2]))) <= reach)
        return next((end for end in islice(near, MOST_TRIED) if self.is_room(start, end, inside, close, body)
                     and self.others_free(so_far + [end])), None)

    def way_out(self, start, reach):
        """The end of a straight way out of what is overlapped at a corner, as things are then; or None."""
        return self.straight([start], start[2], reach)

    def is_room(self, start, there, inside, close, body):
        world, motion = self.world, self.motion
        for name in world.solids:
            if world.colliders[name].one_way is None and world.met(name, motion, there, there, body) is not False:
                return False
            if name in inside:
                if name in self.sides and world.meets(
                        name, self.sides[name], less(motion.seen(name, there), self.sides[name]), world.body):
                    return False
                continue
            if world.met(name, motion, start, there, world.body if name in close else body) is not False:
                return False
        return True
