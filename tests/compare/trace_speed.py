"""What holds a character, carries it and takes its speed, for check_trace.py. trace_ground.py tries where there is ground."""
import itertools
import math

from trace_geometry import GAP, Fraction, add, dot, less, scaled, shifted, show, sides, size, vector

SLOWER = 1e-9  # of speed, for each m/s of it: rounding
TOUCH = Fraction(7, 10**7)  # what is no farther is touched [m]


class SpeedChecks:
    """Of a checker: it has the world, ground and company, and says what it skips."""

    def check_ground(self, step, others):
        path, motion, record = step.path, step.motion, step.record
        if record["start_overlap"] or step.get("crush") or self.world.overlapped(motion, path[-1]):
            self.skip("hanging", "inside of something")
            return
        def is_near(place):
            return size(less(place[:2], path[-1][:2])) <= 2 * sum(self.company.size)

        edges = [edge for other in others if is_near(other.path[-1]) for edge in sides(shifted(self.body, other.path[-1][:2]))]
        before = path[-2]
        if record["grounded"] and self.asks("ground_invented"):
            if not self.ground.is_grounded(motion, path[-1], step.up, before, edges):
                yield "ground_invented", "is grounded, and nothing is under it"
        if not record["grounded"] and self.asks("ground_missed"):
            yield from self.check_ground_missed(step, before)
        if self.asks("hanging"):
            across = (step.up[1], -step.up[0])
            unsteered = less(step.wanted, scaled(across, step.steered))
            beside = edges or any(is_near(self.company.stands(other, step)[-1]) for other in others)
            hangs = self.ground.hangs(motion, path, step.up, unsteered, step.get("drop", []), beside)
            if hangs is None:
                self.skip("hanging", "beside what moves, or another character")
            elif hangs:
                yield "hanging", "could have fallen"

    def check_carrier(self, step, others):
        """Another character that carries one is under it, where it stands or goes in the turn, or ends."""
        if "character" not in step.get("ride", {}):
            return
        ride = step.record["ride"]
        carrier = next((other for other in others if other.who == ride["character"]), None)
        if carrier is None or not self.company.is_under(carrier, step):
            yield "ground_invented", f"rides character {ride['character']}, which is not there"
            return
        goes = vector(carrier.record["velocity"])
        rounding = 1e-9 * (1 + size(goes))
        if size(less(vector(ride["velocity"]), goes)) > rounding:
            yield "velocity", f"rides character {carrier.who} at {ride['velocity']} m/s, which goes at {carrier.record['velocity']}"
        before = step.last.get("ride", {}) if step.last else {}
        rides_on = before.get("character") == carrier.who and [met["character"] for met in step.get("met", [])] == [carrier.who]
        if rides_on and not step.contacts and len(step.path) == 2:
            # Along a way without a bend it goes at one speed, relative to what carries it.
            relative = scaled(less(step.way(), step.ways_of_others[carrier.who]), 1 / Fraction(step.dt))
            off = size(less(less(vector(step.record["velocity"]), vector(ride["velocity"])), relative))
            if off > 2 * GAP / Fraction(step.dt):
                yield "velocity", f"ends {off} m/s faster or slower than it goes on character {carrier.who}"

    def check_ground_missed(self, step, before):
        """On ground that it touches, and does not leave, it is grounded. It leaves ground from which the same motion for one
        more step would part it by more than it touches."""
        velocity = vector(step.record["velocity"])
        for contact in step.contacts:
            n, name = vector(contact["normal"]), contact["collider"]
            if float(dot(n, step.up)) < self.ground.surely_walkable:
                continue
            change = step.motion.change_at_end(name)
            if change is None:
                self.skip("ground_missed", "on what turns to the end")
                continue
            relative = less(velocity, scaled(change, 1 / Fraction(step.dt)))
            for below, up, along, gap in self.ground.supports(step.motion, step.path[-1], step.up, before):
                if below != name or along < self.ground.surely_walkable or gap > GAP:
                    continue
                later = (*add(step.path[-1][:2], scaled(relative, Fraction(step.dt))), Fraction(1))
                down = (*less(later[:2], scaled(up, TOUCH)), Fraction(1))
                stays = self.world.met(name, step.motion, later, down)
                if stays and float(dot(up, relative)) * step.dt <= 1e-9:
                    yield "ground_missed", f"touches {name}, does not leave it, and is not grounded"
                    return

    def check_speed(self, step, _):
        if not self.asks("speed_lost", "velocity"):
            return
        record, frame = step.record, step.frame
        if (record["start_overlap"] or step.get("crush") or step.get("stuck") or step.get("dropped") or step.in_parts
                or self.is_pushed_unsaid(step)):
            self.skip("speed_lost", "begins inside, crushed, stuck, dropped or pushed, or goes in parts")
            return
        want = [float(x) / step.dt for x in step.wanted]
        have, made = step.velocity, [float(x) / step.dt for x in step.way()]
        largest = max(abs(float(x)) for corner in step.path for x in corner[:2])
        rounding = (1e-5 if self.header["scalar"] == "float" else SLOWER) * (1 + math.hypot(*want)) + largest * 1e-14 / step.dt
        normals = [vector(c["normal"]) for c in step.contacts] + [vector(m["normal"]) for m in step.get("met", [])]
        restored = rounding + 2 * float(GAP) / step.dt  # a gap is kept from what is touched
        if not normals:
            for what, value, slack in (("way", made, restored), ("speed", have, rounding)):
                off = less(value, want)
                if math.hypot(*off) > slack:
                    slower = off[0] * want[0] + off[1] * want[1] < 0
                    yield "speed_lost" if slower else "velocity", f"touches nothing, and its {what} is {value} m/s, not {want}"
            return
        faces = [(frame.across(n), frame.rise(n)) for n in normals]
        yield from self.check_loss(step, want, have, made, faces, rounding, restored)
        if not self.is_pushed(step) and "ride" not in record and not step.get("met"):
            gravity = vector(step.gravity)
            at_rest = step.steered == 0 and frame.rise(want) <= 0 and step.before is not None and not any(step.before)
            if at_rest and float(dot(step.way(), gravity)) < -2 * float(GAP) * size(gravity):
                yield "velocity", f"goes up by {show(step.way())} m from rest, against gravity, and nothing takes it there"
            steepest = math.tan(math.radians(self.header["character"]["max_climb_degrees"]) + 1e-6)
            walks = max(abs(frame.across(want)), abs(frame.across(want) - float(step.steered) / step.dt)) + rounding
            climbs = abs(frame.across(have)) <= walks and abs(frame.rise(have)) <= walks * steepest + rounding
            across = step.frame.world(float(step.steered) / step.dt, 0)
            if math.hypot(*have) > max(math.hypot(*want), math.hypot(*less(want, across))) + rounding and not climbs:
                yield "velocity", f"comes out at {have} m/s, and wanted {want}"

    def check_loss(self, step, want, have, made, faces, rounding, restored):
        frame, walk, rise = step.frame, step.frame.across(want), step.frame.rise(want)
        slope = self.ground.surely_walkable
        steered = float(step.steered)
        opposed = any((across * walk < 0 or across * steered < 0) and up < slope for across, up in faces)
        # Two surfaces that close in on it, and one of them ahead, stop it together.
        between = any(a[0] * b[0] + a[1] * b[1] < 0 and min(a[0] * walk, b[0] * walk) < 0
                      for a, b in itertools.combinations(faces, 2))
        for what, value, slack in (("speed", have, rounding), ("way", made, restored)):
            lost = (walk - frame.across(value)) * math.copysign(1, walk)
            if abs(walk) > slack and lost > slack and not opposed and not between:
                ahead = scaled((step.up[1], -step.up[0]), Fraction(math.copysign(2 * float(GAP), walk)))
                there = (*add(step.path[-1][:2], ahead), Fraction(1))
                hidden = [name for name in self.world.solids if self.world.met(name, step.motion, step.path[-1], there)]
                if hidden:
                    yield "contact_missed", f"is stopped by {hidden[0]}, and does not name it"
                else:
                    yield "speed_lost", f"loses {lost} m/s of its {what} across up, and nothing opposes it"
        climbed = step.began_grounded or step.record["grounded"] or any(up >= slope for _, up in faces)
        side_hit = self.header["character"].get("side_hit_ends_rise") and any(abs(up) < 0.7 for _, up in faces)
        if rise < 0:
            lost = frame.rise(have) - rise
            if lost > rounding and not any(up > 1e-9 for _, up in faces):
                yield "speed_lost", f"loses {lost} m/s of its fall, and nothing is under it"
        elif rise > 0 and not climbed and not side_hit:
            lost = rise - frame.rise(have)
            if lost > rounding and not any(up < -1e-9 for _, up in faces):
                yield "speed_lost", f"loses {lost} m/s of its rise, and nothing is over it"
