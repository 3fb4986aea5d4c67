"""What turns, for check_trace.py: between bounds, as the sine of a fraction is none.

Seen from what turns, that stands still, and the character turns the other way while it goes along a curve. In a short
part of its way the curve is nearly straight: between its places at both ends and `bend` around them. So a part is
certainly free where nothing comes into all of that; else its middle is looked at, and then its halves, down to WIDTH.
"""
from collections import deque
from fractions import Fraction
from functools import lru_cache

from trace_geometry import ZERO, add, at_most, enters, hull, inside, less, scaled

WIDTH = Fraction(1, 10**9)  # of the shortest part that is looked at, as a share of a straight way
MOST_PARTS = 200  # that are looked at before it is called too close to tell: a touch takes about 60
SURE = Fraction(1, 10**12)  # an overlap is this deep, and free is this far away [m]: much more than sines are rounded by

PI = Fraction("3.14159265358979323846264338327950288419716939937510")
UNIT = 1 << 100


@lru_cache(maxsize=4096)
def cosine_and_sine(angle):
    """To 1e-25: the series for what is left of the angle without its whole turns, in whole numbers of UNIT parts."""
    x = round((angle - 2 * PI * (angle // (2 * PI))) * UNIT)
    sums, term, k = [0, 0, 0, 0], UNIT, 0  # of the terms whose signs are those of cos, sin, -cos, -sin
    while term:
        sums[k % 4] += term
        k += 1
        term = term * x // (k * UNIT)
    return Fraction(sums[0] - sums[2], UNIT), Fraction(sums[1] - sums[3], UNIT)


def turned_back(point, angle):
    c, s = cosine_and_sine(angle)
    return (c * point[0] + s * point[1], c * point[1] - s * point[0])


class Leg:
    """A straight way of a body, and what turns meanwhile: both evenly while the share of it goes from 0 to 1."""

    def __init__(self, body, places, angles):
        """`places` of the body less those of the point that the mover turns about, and its angles, at both ends."""
        self.body = body
        self.start, self.way = places[0], less(places[1], places[0])
        self.angle, self.turn = angles[0], angles[1] - angles[0]
        # Of the curve of a corner, by the share: the second derivative is at most that long.
        farthest = max(at_most(add(place, corner)) for place in places for corner in body)
        self.curvature = self.turn**2 * farthest + 2 * abs(self.turn) * at_most(self.way)

    def corners(self, share, size=Fraction(1)):
        """Of the body, as the mover sees them."""
        place = add(self.start, scaled(self.way, share))
        return [turned_back(add(place, scaled(corner, size)), self.angle + share * self.turn) for corner in self.body]

    def between(self, first, last):
        """A convex polygon, and how far around it all places of the body between two shares are."""
        bend = self.curvature * (last - first) ** 2 / 8
        return hull(self.corners(first) + self.corners(last)), bend + SURE


def meets(collider, convex, wider=ZERO):
    """Whether a collider comes into a convex polygon, or so near to it."""
    if any(enters(a, b, convex, wider) for a, b in collider.edges):
        return True
    middle = (sum(p[0] for p in convex) / len(convex), sum(p[1] for p in convex) / len(convex))
    return inside(middle, collider.rings)


def overlaps(collider, leg, share, smaller):
    """Whether a body certainly overlaps a collider at one moment. `smaller`: the factor that takes SURE off its sides."""
    return meets(collider, leg.corners(share, smaller))


def is_free(collider, leg, share):
    """Whether it certainly does not."""
    return not meets(collider, *leg.between(share, share))


def comes_to_overlap(collider, leg, smaller):
    """Whether a body certainly overlaps a collider at any moment; None where that is too close to tell."""
    parts, close = deque([(ZERO, Fraction(1))]), False
    for _ in range(MOST_PARTS):
        if not parts:
            return None if close else False
        first, last = parts.popleft()
        if not meets(collider, *leg.between(first, last)):
            continue
        middle = (first + last) / 2
        if overlaps(collider, leg, middle, smaller):
            return True
        if last - first <= WIDTH:
            close = True
        else:
            parts += [(first, middle), (middle, last)]
    return None
