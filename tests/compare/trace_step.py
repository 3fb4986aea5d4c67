"""One record of a trace, with what the checks of check_trace.py need of it."""
from trace_geometry import GAP, ZERO, exact, less, scaled, size, vector
from trace_company import places_at
from trace_motion import Frame
from trace_world import Motion


class Step:
    """One record, with what the checks need of it."""

    def __init__(self, record, colliders, header):
        self.record, self.motion = record, Motion(record, colliders)
        self.who, self.last = record.get("character", 0), None  # the step before of the same character
        self.told = f"character {self.who} " if header.get("characters", 1) > 1 else ""
        self.sampled = record.get("path_exact") is False
        self.path = exact(record["path"])
        self.turn = record.get("turn")  # its place in the order of the step; None where all move at once
        self.pushed = False  # by another in its turn
        self.contacts, self.velocity = record["contacts"], record.get("velocity")
        self.dt = record.get("dt", header["dt"])
        self.up = vector(record.get("up", header["up"]))
        self.frame = Frame(self.up)
        self.gravity = record.get("gravity", header["gravity"])
        self.wanted = None  # [m]; None where the trace does not tell
        self.in_parts = any(len(way.instants) > 2 for way in self.motion.ways.values())  # so goes who is near what turns
        self.excused = []  # what crushes without room

    def get(self, key, default=None):
        return self.record.get(key, default)

    def note_others(self, others):
        stood = set() if self.turn is None else {other.who for other in others} - set(self.get("moving", []))
        self.ways_of_others = {other.who: [ZERO, ZERO] if other.who in stood else other.way() for other in others}
        ride = self.get("ride", {})
        if ride.get("character") in self.ways_of_others:
            # A rider takes over the velocity of its carrier, which went its way at another one where something stopped it.
            goes = [float(x) / self.dt for x in self.ways_of_others[ride["character"]]]
            self.velocity = [v - a + b for v, a, b in zip(self.velocity, ride["velocity"], goes)]

    def first_event(self):
        return min((event["fraction"] for event in self.contacts + self.get("met", [])), default=None)

    def unjudgeable(self):
        """What must not be before anything else can be asked."""
        fractions = [corner[2] for corner in self.path]
        if fractions[0] != 0 or fractions[-1] != 1 or fractions != sorted(fractions):
            yield "its way does not go from fraction 0 to 1"
        for way in self.motion.ways.values():
            yield from way.faults()

    def way(self):
        return less(self.path[-1][:2], self.path[0][:2])

    def goes_as_wanted(self, fraction):
        wanted = scaled(self.wanted, fraction)
        return any(size(less(less(place, self.path[0]), wanted)) <= GAP for place in places_at(self.path, fraction))
