"""Several characters in a trace, for check_trace.py: where they come to overlap, and whether they say so."""

from trace_geometry import (
    GAP, GRAZING, NEAR_PASS, ZERO, Fraction, add, between, dot, enters, hull, less, scaled, size, vector)


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
    """Several characters of one shape: they overlap where the difference of their places is inside `reach`."""

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

    def check(self, one, other):
        """Two steps at the same time: (clause, words)."""
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
        elif not self.leaves_free(mine, theirs):
            yield "passage", f"and character {other.who} come to overlap or pass through each other"

    def check_met(self, one, other, is_turned):
        """What two say of how they met. `is_turned(step, fraction)`: something may have turned it aside before."""
        of_one, of_other = ([met for met in a.get("met", []) if met["character"] == b.who]
                            for a, b in ((one, other), (other, one)))
        if [([-x for x in met["normal"]], met["fraction"]) for met in of_one] != [
                (met["normal"], met["fraction"]) for met in of_other]:
            yield "contact_invented", f"and character {other.who} do not say the same of how they met"
            return
        for met in of_one:
            n = vector(met["normal"])
            if abs(met["normal"][0] ** 2 + met["normal"][1] ** 2 - 1) > 1e-12:
                yield "normal", f"has a normal that is no unit vector at character {other.who}"
            moments = [(m[k], t[k]) for m, t in parts(one.path, other.path) for k in (0, 1)]
            gaps = [dot(n, less(m, t)) - self.width(n) for m, t in moments]
            if not any(0 < gap <= GAP for gap in gaps):
                yield "contact_invented", (f"and character {other.who} have met, and at no corner are within 1e-6 m: "
                                           f"{[float(gap) for gap in gaps]}")
            elif not is_turned(one, met["fraction"]) and not is_turned(other, met["fraction"]):
                yield from self.check_impact(one, other, n, Fraction(met["fraction"]))

    def check_impact(self, one, other, n, t):
        along = -dot(n, less(one.wanted, other.wanted))
        if along <= GRAZING * size(less(one.wanted, other.wanted)):
            return  # what holds one of them, a micrometre away, turns it into the other
        slack = GAP / along

        def meet_until(time, wide=ZERO):
            mine, theirs = ((step.path[0][:2], add(step.path[0][:2], scaled(step.wanted, time))) for step in (one, other))
            return self.meet((mine[0], add(mine[1], scaled(n, -wide))), theirs)

        if t > slack and meet_until(t - slack):
            yield "time_of_impact", f"meets character {other.who} earlier than at {float(t)} of the step"
        if not meet_until(t + slack, NEAR_PASS):
            yield "time_of_impact", f"does not meet character {other.who} by {float(t)} of the step"
