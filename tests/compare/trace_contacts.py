"""Contacts and impacts, for check_trace.py.

A contact is as it says at a corner of the way no later than its fraction. What was wanted meets nothing before the first
contact that is reported, and meets that one then.
"""
from trace_geometry import (
    GAP, NEAR_PASS, ROUNDING, SAME, ZERO, Fraction, add, distance, dot, less, scaled, shifted, show, sides, size, vector)

NEARLY = Fraction(1, 10**4)  # what is farther away is not touched at all [m]


class ContactChecks:
    """Of a checker: it has the world, the body and its wider ones, and says what it skips."""

    def check_contacts(self, step, _):
        if self.asks("gap", "normal", "contact_invented", "contact_missed", "time_of_impact") and not step.sampled:
            for contact in step.contacts:
                yield from self.check_contact(contact, step)
            yield from self.check_impacts(step)

    def check_contact(self, contact, step):
        name, n = contact["collider"], vector(contact["normal"])
        if name not in self.colliders or self.colliders[name].sensor:
            yield "contact_invented", f"has a contact with {name}, which is no solid of the scene"
            return
        if abs(dot(n, n) - 1) > 1e-12:
            yield "normal", f"has a normal that is no unit vector at {name}"
        # Where a touch takes long to come the way may have other corners before the fraction.
        corners = [corner for corner in step.path if corner[2] <= Fraction(contact["fraction"]) + SAME]
        if not corners or not 0 <= contact["fraction"] <= 1:
            yield "contact_invented", f"has a contact with {name} at {contact['fraction']}, outside the step"
            return
        found = [list(self.contact_faults(contact, corner, step)) for corner in reversed(step.path)]
        in_time = min(found[-len(corners):], key=lambda faults: ("contact_invented" in dict(faults), len(faults)))
        if in_time and not all(found):
            yield "time_of_impact", f"has a contact with {name} at {contact['fraction']}, and comes to it later"
        else:
            yield from in_time

    def contact_faults(self, contact, corner, step):
        """If this is the corner where the character stopped before it."""
        name, n, point = contact["collider"], vector(contact["normal"]), vector(contact["point"])
        collider, place = self.colliders[name], corner[:2]
        edges = step.motion.edges(name, collider, corner[2])
        # Along a side that nearly faces the character the middle of both its ends is a little off.
        if not collider.distance(point, edges) <= 10 * ROUNDING * max(1, float(collider.radius)):
            yield "contact_invented", f"has a contact point {show(point)} that is not on {name}"
        off = min(distance(point, a, b) for a, b in sides(shifted(self.body, place)))
        if not off <= GAP + Fraction(ROUNDING):
            clause = "gap" if off <= NEARLY else "contact_invented"
            yield clause, f"has a contact point {show(point)} with {name} that is {off} m from the character"
            return
        gap = dot(n, less(place, point)) + min(dot(n, corner) for corner in self.body)
        if not abs(gap - Fraction(contact["separation"])) <= ROUNDING:
            yield "gap" if 0 < gap <= NEARLY else "normal", f"is nowhere {contact['separation']} m from {name} along its normal"
        elif not self.keeps_apart(n, point, edges, collider):
            yield "normal", f"has the normal {show(n)} at {name}, which is of no face there"
        put = self.put[step.who]
        moved = less(place, put.path[0][:2])
        is_as_put = gap == 0 and edges == [tuple(shifted(edge, moved)) for edge in put.motion.edges(name, collider, ZERO)]
        if not (0 < gap <= GAP or is_as_put):
            yield "gap" if abs(gap) <= NEARLY else "normal", f"keeps a gap of {float(gap)} m at {name}"

    def keeps_apart(self, n, point, edges, collider):
        """Whether some edge at the point lies wholly behind the normal. (One that goes on ahead of it may be hidden by the
        one that is touched.)"""
        if collider.radius:
            return size(less(less(point, edges[0][0]), scaled(n, collider.radius))) <= 1e-6 * max(1, float(collider.radius))
        touched = [(a, b) for a, b in edges if distance(point, a, b) <= 10 * ROUNDING]
        return any(max(dot(n, less(end, point)) for end in edge) <= 10 * ROUNDING for edge in touched)

    def check_impacts(self, step):
        """What the wanted motion meets first, and when."""
        path, record, motion = step.path, step.record, step.motion
        if record["start_overlap"] or step.get("crush") or step.get("stuck") or step.in_parts or self.is_pushed_unsaid(step):
            self.skip("contact_missed", "begins inside, crushed, stuck or pushed, or goes in parts")
            return
        events = [(Fraction(contact["fraction"]), contact) for contact in step.contacts]
        first, contact = min(events, key=lambda event: event[0], default=(Fraction(1), None))
        met = min((Fraction(m["fraction"]) for m in step.get("met", [])), default=None)
        if met is not None and met <= first:
            first, contact = met, None  # another character may have turned it aside
        if self.is_pushed(step) and (first == 0 or not step.goes_as_wanted(min(first, path[1][2]))):
            return  # touched where it began, or pushed aside by a mover from there
        # A last leg without time follows the ground down: its contact is none of the wanted motion.
        follows = path[-1][2] == path[-2][2] == 1 and first == 1
        for name in self.world.solids:
            if motion.turns(name) or name in step.get("drop", []):
                continue
            yield from self.check_impact(name, contact, first, follows, step)

    def is_pushed_unsaid(self, step):
        """By another, which its own motion did not meet."""
        return step.pushed and not step.get("met")

    def is_pushed(self, step):
        """Whether something that moves comes near to the way that was travelled, or wanted."""
        legs = list(zip(step.path, step.path[1:]))
        legs.append((step.path[0], (*add(step.path[0][:2], step.wanted), Fraction(1))))
        return any(step.motion.goes(name) and any(self.world.met(name, step.motion, *leg, self.bodies[NEARLY]) is not False
                                                  for leg in legs) for name in self.world.solids)

    def check_impact(self, name, contact, first, follows, step):
        start = step.motion.seen(name, step.path[0])
        wanted = less(step.wanted, step.motion.change(name))
        is_first = contact is not None and contact["collider"] == name
        reported = [c for c in step.contacts if c["collider"] == name]
        normal = vector((contact if is_first else reported[0])["normal"]) if reported else None
        along = abs(dot(normal, wanted)) if normal else ZERO
        speed = Fraction(size(wanted))
        if is_first and along == 0:
            yield "contact_invented", f"has a contact with {name} that it does not move towards"
            return
        if speed == 0:
            return
        # Of what is not reported the normal is not known: by that much nearer a corner may be grazed.
        slack = GAP / along if along else 1000 * GAP / speed
        clause = "time_of_impact" if reported else "contact_missed"
        if first > slack and self.world.meets(name, start, scaled(wanted, first - slack), self.body):
            yield clause, f"meets {name} earlier than at {float(first)} of the step"
        # What passes so closely may be called a contact, too.
        by_then = scaled(wanted, first + slack)
        if is_first and not follows and not self.world.meets(name, start, by_then, self.bodies[NEAR_PASS]):
            yield "time_of_impact", f"does not meet {name} by {float(first)} of the step"

    def is_turned(self, step, fraction):
        """Whether something may have turned a character aside before it met another at that fraction."""
        fraction = Fraction(fraction)
        if step.get("stuck") or step.first_event() != fraction:
            return True
        stops = [[corner[2] for corner in step.path if corner[2] <= event["fraction"]][-1:]
                 for event in step.contacts + step.get("met", [])]
        if len(stops) > 1 and stops[0] in stops[1:]:
            return True
        if step.goes_as_wanted(fraction):
            return False
        end = (*add(step.path[0][:2], scaled(step.wanted, fraction)), fraction)
        return any(self.world.met(name, step.motion, step.path[0], end, self.bodies[GAP]) is not False
                   for name in self.world.solids)
