"""Several characters in a trace, for check_trace.py: where they come to overlap, and whether they say so."""

from trace_geometry import (
    GAP, GRAZING, NEAR_PASS, ZERO, Fraction, add, between, dot, enters, hull, less, scaled, sides, size, turn, vector)


def places_at(way, t):
    """All corners of a way of (x, y, fraction) at that moment, or the place between two."""
    corners = [corner[:2] for corner in way if corner[2] == t]
    if corners:
        return corners
    before = max(i for i, corner in enumerate(way) if corner[2] < t)
    a, b = way[before], way[before + 1]
    return [between(a[:2], b[:2], (t - a[2]) / (b[2] - a[2]))]


def parts(one, other):
    """What two do at the same time, as (from, to) of each: ways of (x, y, fraction) from 0 to 1. Jumps, which take no
    time, come one after the other, those of the one first."""
    times = sorted({corner[2] for corner in one + other})
    for t, following in zip(times, times[1:] + [None]):
        mine, theirs = places_at(one, t), places_at(other, t)
        for a, b in zip(mine, mine[1:]):
            yield (a, b), (theirs[0], theirs[0])
        for a, b in zip(theirs, theirs[1:]):
            yield (mine[-1], mine[-1]), (a, b)
        if following is not None:
            yield (mine[-1], places_at(one, following)[0]), (theirs[-1], places_at(other, following)[0])


class Company:
    """Several characters of one shape: they overlap where the difference of their places is inside `reach`. Where they
    take turns, one moves while the others stand: those before it where they ended, those after it where they began."""

    def __init__(self, body):
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

    def leaves_free(self, way, other):
        """Whether another's way keeps clear of a way of (x, y, fraction) from 0 to 1."""
        return not any(self.meet(*part) for part in parts(way, other))

    def stands(self, other, one):
        """The way of another in the turn of one."""
        at = other.path[-1 if other.turn < one.turn else 0][:2]
        return [(*at, ZERO), (*at, Fraction(1))]

    def sides_between(self, place, of):
        """(gap along it, unit normal towards the place, rounded) of each side of two that may keep them apart."""
        for a, b in sides(self.reach):
            along = less(b, a)
            yield float(turn(b, a, less(place, of))) / size(along), [float(along[1]) / size(along), -float(along[0]) / size(along)]

    @staticmethod
    def goes(other, one):
        """Whether another went along its way in the turn of one, as that says."""
        return other.who in one.get("moving", [])

    def is_under(self, other, one):
        """Whether one touches another from above where its step ends: where that stands or goes in the turn, or ends."""
        def touches(place):
            sides = list(self.sides_between(one.path[-1][:2], place))
            return max(gap for gap, _ in sides) <= GAP and any(gap >= -1e-10 and dot(n, one.up) > 0 for gap, n in sides)

        return touches(self.acts(other, one)[-1][:2]) or touches(other.path[-1][:2])

    def acts(self, other, one):
        """The way of another as one meets it in its turn: straight and even, or it stands."""
        start, end = other.path[0][:2], other.path[-1][:2]
        return [(*start, ZERO), (*end, Fraction(1))] if self.goes(other, one) else self.stands(other, one)

    def check(self, one, other):
        """Two steps at the same time, or in turns: (clause, words)."""
        mine, theirs = one.path, other.path
        overlapped = self.meet(mine[:1] * 2, theirs[:1] * 2)
        for a, b in ((one, other), (other, one)):
            if (b.who in a.get("start_overlap_characters", [])) != overlapped:
                yield "continuity", f"and character {other.who}: {a.who} says {not overlapped} of an overlap at the start"
        if overlapped:
            return
        if one.get("path_exact") is False:
            mine, theirs = [mine[0], mine[-1]], [theirs[0], theirs[-1]]
        if self.meet(mine[-1:] * 2, theirs[-1:] * 2):
            yield "overlap", f"and character {other.who} come to overlap or pass through each other"
        elif one.turn is not None and not self.leaves_free(self.stands(one, other), theirs):
            yield "passage", f"is where character {other.who} goes in its turn"
        elif not self.leaves_free(mine, theirs if one.turn is None else self.stands(other, one)):
            yield "passage", f"and character {other.who} come to overlap or pass through each other"

    def check_met(self, one, other, is_turned):
        """What one says of how it met another in its turn. `is_turned(step, fraction)`: something may have turned it aside
        before."""
        theirs = self.acts(other, one)
        goes = less(theirs[-1], theirs[0])
        for met in (met for met in one.get("met", []) if met["character"] == other.who):
            n = vector(met["normal"])
            if abs(met["normal"][0] ** 2 + met["normal"][1] ** 2 - 1) > 1e-12:
                yield "normal", f"has a normal that is no unit vector at character {other.who}"
            moments = [(m[k], t[k]) for m, t in parts(one.path, theirs) for k in (0, 1)]
            gaps = [dot(n, less(m, t)) - self.width(n) for m, t in moments]
            then = [places_at(way, Fraction(met["fraction"])) for way in (one.path, theirs)]
            apart = min(dot(n, less(m, t)) for m in then[0] for t in then[1]) - self.width(n)
            if not any(0 < gap <= GAP for gap in gaps):
                yield "contact_invented", (f"and character {other.who} have met, and at no corner are within 1e-6 m: "
                                           f"{[float(gap) for gap in gaps]}")
            elif apart > 2 * GAP:
                yield "time_of_impact", f"says it met character {other.who} at {met['fraction']}, {float(apart)} m away"
            elif not is_turned(one, met["fraction"]):
                yield from self.check_impact(one, other, theirs[0][:2], goes, n, Fraction(met["fraction"]))

    def check_impact(self, one, other, theirs, goes, n, t):
        """`theirs`, `goes`: where the other begins, and its way."""
        along = -dot(n, less(one.wanted, goes))
        if along <= GRAZING * size(less(one.wanted, goes)):
            return  # what holds one of them, a micrometre away, turns it into the other
        slack = GAP / along

        def meet_until(time, wide=ZERO):
            mine = one.path[0][:2]
            end = add(add(mine, scaled(one.wanted, time)), scaled(n, -wide))
            return self.meet((mine, end), (theirs, add(theirs, scaled(goes, time))))

        if t > slack and meet_until(t - slack):
            yield "time_of_impact", f"meets character {other.who} earlier than at {float(t)} of the step"
        if not meet_until(t + slack, NEAR_PASS):
            yield "time_of_impact", f"does not meet character {other.who} by {float(t)} of the step"
