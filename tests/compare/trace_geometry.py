"""For check_trace.py: exact geometry of the plane, whose points are pairs of fractions, and the tolerances."""
try:
    from gmpy2 import mpq as Fraction  # the same numbers, in a fifth of the time
except ImportError:
    from fractions import Fraction

GAP = Fraction(1, 10**6)  # largest gap at a contact, and largest error of an impact along its normal [m]
ROUNDING = 1e-8  # of a reported separation or contact point [m]: positions of 1e6 m are known to 1e-10
SAME = Fraction(1, 10**12)  # two fractions of one moment may be rounded so far apart [steps]
NEAR_PASS = Fraction(4, 10**7)  # a way that passes a solid this closely may be called a contact [m]
NEAR_DROP = Fraction(2, 10**6)  # and one that passes a one-way chain this closely may be said to drop through it [m]
GRAZING = 1e-3  # an approach of less than this part of the relative motion grazes, and says little of when
ZERO = Fraction(0)


def vector(v):
    return tuple(map(Fraction, v))


def exact(points):
    return list(map(vector, points))


def sides(ring):
    return list(zip(ring, ring[1:] + ring[:1]))


def shifted(points, by):
    return [add(point, by) for point in points]


def between(start, end, share):
    return tuple(a + share * (b - a) for a, b in zip(start, end))


def middle_of(points):
    return (sum(p[0] for p in points) / len(points), sum(p[1] for p in points) / len(points))


def add(a, b):
    return (a[0] + b[0], a[1] + b[1])


def less(a, b):
    return (a[0] - b[0], a[1] - b[1])


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


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
    for u, v in sides(convex):
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
    return sum((a[1] > point[1]) != (b[1] > point[1]) and (turn(a, b, point) > 0) == (b[1] > a[1])
               for ring in rings for a, b in sides(ring)) % 2 == 1


def is_near(point, convex, radius):
    """Whether a point is inside a counter-clockwise convex polygon, or nearer to it than a radius."""
    if all(turn(u, v, point) > 0 for u, v in sides(convex)):
        return True
    ways = (way_from_segment(point, a, b) for a, b in sides(convex))
    return any(dot(way, way) < radius * radius for way in ways)


def circle_crossings(start, way, body, centre, radius):
    """Where on a straight way a corner of the body meets a circle, or an edge of the body touches it; rounded."""
    length = size(way)
    if length == 0:
        return
    r, along = float(radius), [float(k) / length for k in way]
    for a, b in sides(body):
        arm = [float(k) for k in less(centre, add(start, a))]
        foot, aside = arm[0] * along[0] + arm[1] * along[1], arm[0] * along[1] - arm[1] * along[0]
        if abs(aside) <= r:
            half = (r * r - aside * aside) ** 0.5
            yield from (Fraction((foot - half) / length), Fraction((foot + half) / length))
        edge = [float(k) for k in less(b, a)]
        out = edge[1] / size(edge), -edge[0] / size(edge)
        speed = out[0] * along[0] + out[1] * along[1]
        if speed != 0:
            yield Fraction((out[0] * arm[0] + out[1] * arm[1] - r) / speed / length)


def crossings(start, way, body, edges):
    """Where on a straight way a corner of the body meets an edge, or an end of an edge one of the body."""
    pairs = [(add(start, corner), a, b, way) for corner in body for a, b in edges]
    pairs += [(end, a, b, scaled(way, -1)) for edge in edges for end in edge for a, b in sides(shifted(body, start))]
    for point, a, b, moved in pairs:
        along = less(b, a)
        speed = cross(along, moved)
        if speed != 0:
            yield -turn(a, b, point) / speed


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1]


def scaled(v, by):
    return (v[0] * by, v[1] * by)


def way_from_segment(point, a, b):
    """The shortest way from a segment to a point."""
    edge, off = less(b, a), less(point, a)
    share = min(max(dot(off, edge) / dot(edge, edge), ZERO), Fraction(1))
    return less(off, scaled(edge, share))


def distance(point, a, b):
    """From a point to a segment, rounded once at the end."""
    return size(way_from_segment(point, a, b))


def size(v):
    """The length of a vector, rounded once."""
    return float(dot(v, v)) ** 0.5


def show(point):
    return f"({float(point[0])}, {float(point[1])})"
