"""Several characters in a trace, for check_trace.py: where they come to overlap, and whether they say so."""
from fractions import Fraction

from trace_geometry import GAP, GRAZING, NEAR_PASS, ZERO, add, dot, enters, exact, hull, less, scaled, size


def places_at(way, t):
    """All corners of a way of (x, y, fraction) at that moment, or the place between two."""
    corners = [corner[:2] for corner in way if corner[2] == t]
    if corners:
        return corners
    before = max(i for i, corner in enumerate(way) if corner[2] < t)
    a, b = way[before], way[before + 1]
    share = (t - a[2]) / (b[2] - a[2])
    return [add(a[:2], scaled(less(b, a), share))]


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


def first_event(step):
    """The fraction of the earliest contact of a step with anything."""
    return min((event["fraction"] for event in step["contacts"] + step.get("met", [])), default=None)


def meets_at_once(contact, step):
    """Whether a step stops for a contact where it stops for another character: either may turn it into the other."""
    stops = [[corner[2] for corner in step["path"] if corner[2] <= event["fraction"]][-1:]
             for event in [contact] + step.get("met", [])]
    return stops[0] in stops[1:]


def goes_as_requested(step, fraction):
    """Whether a character is then where its requested motion takes it, to 1e-6 m."""
    way = exact(step["path"])
    wanted = scaled(tuple(map(Fraction, step["requested"])), Fraction(fraction))
    return any(size(less(less(place, way[0]), wanted)) <= GAP for place in places_at(way, Fraction(fraction)))


class Company:
    """Several characters of one shape: they overlap where the difference of their places is inside `reach`."""

    def __init__(self, body):
        self.body = body
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

    def check(self, one, other, promises, is_in_the_way):
        """Two records of one step. `is_in_the_way` says whether a collider may turn one of them aside before a
        fraction."""
        i, j = one["character"], other["character"]
        mine, theirs = exact(one["path"]), exact(other["path"])
        overlapped = self.meet((mine[0], mine[0]), (theirs[0], theirs[0]))
        for a, b in ((one, j), (other, i)):
            said = b in a.get("start_overlap_characters", [])
            if said != overlapped:
                yield f"and character {j}: {a['character']} says {said} of an overlap at the start that is {overlapped}"
        if not overlapped:
            if one.get("path_exact") is False:
                mine, theirs = [mine[0], mine[-1]], [theirs[0], theirs[-1]]
            if any(self.meet(*part) for part in parts(mine, theirs)):
                yield f"and character {j} come to overlap or pass through each other"
        if promises:
            yield from self.check_met(one, other, is_in_the_way)

    def check_met(self, one, other, is_in_the_way):
        j = other["character"]
        of_one = [met for met in one.get("met", []) if met["character"] == j]
        of_other = [met for met in other.get("met", []) if met["character"] == one["character"]]
        if [([-x for x in met["normal"]], met["fraction"]) for met in of_one] != [
                (met["normal"], met["fraction"]) for met in of_other]:
            yield f"and character {j} do not say the same of how they met"
            return
        for met in of_one:
            n = tuple(map(Fraction, met["normal"]))
            if abs(met["normal"][0] ** 2 + met["normal"][1] ** 2 - 1) > 1e-12:
                yield f"has a normal that is no unit vector at character {j}"
            moments = [(m[k], t[k]) for m, t in parts(exact(one["path"]), exact(other["path"])) for k in (0, 1)]
            gaps = [dot(n, less(m, t)) - self.width(n) for m, t in moments]
            if not any(0 < gap <= GAP for gap in gaps):
                yield f"and character {j} have met, and at no corner are within 1e-6 m: {[float(gap) for gap in gaps]}"
            t = met["fraction"]
            turned = any(step.get("stuck") or (not goes_as_requested(step, t) and is_in_the_way(step, t))
                         for step in (one, other))
            if t == first_event(one) == first_event(other) and not turned:
                yield from self.check_impact(one, other, met)

    def check_impact(self, one, other, met):
        n, t = tuple(map(Fraction, met["normal"])), Fraction(met["fraction"])
        mine, theirs = (tuple(map(Fraction, step["path"][0][:2])) for step in (one, other))
        wanted, by = (tuple(map(Fraction, step["requested"])) for step in (one, other))
        along = -dot(n, less(wanted, by))
        if along <= GRAZING * size(less(wanted, by)):
            return  # what holds one of them, a micrometre away, turns it into the other
        slack = GAP / along

        def meet_until(time, wider=ZERO):
            reach = less(scaled(n, -wider), (ZERO, ZERO))
            return self.meet((mine, add(add(mine, scaled(wanted, time)), reach)),
                             (theirs, add(theirs, scaled(by, time))))

        if t > slack and meet_until(t - slack):
            yield f"meets character {met['character']} earlier than at {float(t)} of the step"
        if not meet_until(t + slack, NEAR_PASS):
            yield f"does not meet character {met['character']} by {float(t)} of the step"
