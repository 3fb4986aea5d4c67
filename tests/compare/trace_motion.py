"""What a character wanted in a step, for check_trace.py: from gravity, up, limits, inputs and the state before.

The law: the speed across up comes nearer to what the input asks for by acceleration times dt. A press of the jump button
that is allowed sets the speed along up. Gravity is added, the fall limited, and the way is the speed times dt. Whoever
rides something does all of that relative to it, and goes along besides.
"""
from collections import namedtuple
from math import cos, hypot, radians, tan, ulp

from trace_geometry import less

CLIMB = 1e-8  # ground of exactly the climb limit is walkable, whatever its normal was rounded to [rad]


def clamp(x, low, high):
    return min(max(x, low), high)


class Frame:
    """Sees vectors across up (to the right of it) and along it."""

    def __init__(self, up):
        self.x, self.y = map(float, up)

    def across(self, v):
        return float(v[0]) * self.y - float(v[1]) * self.x

    def rise(self, v):
        return float(v[0]) * self.x + float(v[1]) * self.y

    def world(self, across, rise):
        return (across * self.y + rise * self.x, rise * self.y - across * self.x)


# In metres; `steered`: the part of the way across up that steering added; `size`: of the largest of the numbers that it was
# computed from.
Wanted = namedtuple("Wanted", "way steered size")


class Intent:
    """Of one character; feed it every step in order. What a step ended with is taken from the trace, where it is judged;
    the state of the button is not."""

    def __init__(self, header, start):
        self.character = header["character"]
        self.parts = header.get("substeps", 1)
        self.begin_anew({"velocity": start["velocity"]})

    def begin_anew(self, state, moved=True):
        """With a state that is told. Who has not been moved remembers the rest."""
        self.velocity = state["velocity"]
        self.grounded, self.jumping = state.get("grounded", False), state.get("jumping", False)
        self.held, self.pending = state.get("jump_held", False), state.get("jump_pending", False)
        self.ride = state.get("ride")
        if not moved:
            return
        self.pending_left = self.coyote_left = 0.0
        self.crushed, self.sides, self.left_ground = False, set(), False
        self.carrier = (0.0, 0.0)  # how fast what carries went in the step before

    def wanted(self, step, dt, frame, gravity, motion, colliders, wall_ahead, ways):
        """None where the trace does not say it: a rider of what turns. `ways`: how far each of the other characters goes."""
        c, part = self.character, dt / (self.parts * motion.parts())
        own = [a - b for a, b in zip(self.velocity, self.ride["velocity"] if self.ride else (0, 0))]
        before, rise = frame.across(own), frame.rise(own)
        move = step["input"].get("move")
        walk = before
        if move is not None:
            most = part * (c["acceleration"] if self.grounded else c.get("air_acceleration", c["acceleration"]))
            walk += clamp(clamp(move, -1, 1) * c["walk_speed"] - walk, -most, most)
        self.began_grounded = self.grounded
        if (walk - before) * before < 0 and self.grounded and rise > 0 and not self.left_ground:
            # A climb slows with the walk: it comes from the walk, where it is no steeper than ground.
            if rise <= abs(before) * tan(radians(c["max_climb_degrees"]) + CLIMB):
                rise *= max(walk / before, 0)
        rise = self.press(step["input"].get("jump", False), part, rise, move or 0, wall_ahead)
        if c.get("coyote_time", 0) > 0:
            self.coyote_left = c["coyote_time"] if self.grounded else max(self.coyote_left - part, 0)
        rise += frame.rise(gravity) * part
        if "max_fall_speed" in c:
            rise = max(rise, -c["max_fall_speed"])
        speed = frame.world(walk + frame.across(gravity) * part, rise)
        carried = self.carried(step, dt, motion, colliders, ways)
        if carried is None:
            self.rise = float("inf")
            return None
        self.rise = rise + frame.rise(carried) / dt
        places = [abs(float(x)) for ends in motion.ends.values() for place in ends for x in place]
        size = max([hypot(*speed) * dt, hypot(*carried), hypot(*self.velocity) * dt] + [ulp(x) * 1e12 for x in places])
        return Wanted([v * dt + by for v, by in zip(speed, carried)], (walk - before) * dt, size)

    def press(self, button, dt, rise, move, wall_ahead):
        c, buffer = self.character, self.character.get("jump_buffer")
        if button and not self.held:
            self.pending, self.pending_left = True, buffer or 0
        elif self.pending and buffer is not None:
            self.pending_left -= dt
            self.pending = self.pending_left > 0
        elif not button:
            self.pending = False
        if self.held and not button and self.jumping and rise > 0:
            rise *= c["jump_cut"]
        self.held = button
        if not self.pending or self.jumping or self.crushed or not (self.grounded or self.coyote_left > 0):
            return rise
        if c["no_jump_toward_wall"] and move != 0:
            if ("left" if move < 0 else "right") in self.sides or (self.grounded and wall_ahead(move)):
                return rise
        self.jumping, self.grounded, self.pending, self.coyote_left = True, False, False, 0.0
        return c["jump_speed"] * (1 if button else c["jump_cut"])

    def carried(self, step, dt, motion, colliders, ways):
        """By what it rides: the way of a mover, or of another character, in this step, and what a conveyor's surface ran in
        the one before."""
        if not self.ride:
            return (0.0, 0.0)
        if "character" in self.ride:
            return tuple(map(float, ways[self.ride["character"]]))
        name, speed = self.ride["collider"], self.ride["velocity"]
        collider = colliders[name]
        if step["input"].get("drop") and collider.one_way is not None:
            return [v * dt for v in speed]
        if motion.turns(name):
            return None
        way = tuple(map(float, motion.change(name)))
        if collider.surface_speed != 0:
            way = tuple(w + (v - c) * dt for w, v, c in zip(way, speed, self.carrier))
        return way

    def end_later_parts(self, step, dt, parts, frame):
        if self.pending and self.jumped_later(step, dt, parts, frame):
            self.jumping, self.pending, self.coyote_left = True, False, 0.0
        for _ in range(parts - 1):
            if self.pending and self.character.get("jump_buffer") is not None:
                self.pending_left -= dt / parts
                self.pending = self.pending_left > 0
            if not self.grounded:
                self.coyote_left = max(self.coyote_left - dt / parts, 0)

    def jumped_later(self, step, dt, parts, frame):
        """Who lands in a part of a step may jump in the next. A jump that went on before, or ends with the step, needs
        ground in a part before the last."""
        jumping = step.get("jumping", False)
        if jumping and not self.jumping:
            return True
        walkable = cos(radians(self.character["max_climb_degrees"]) + CLIMB)
        landed = any(contact["fraction"] * parts < parts - 1 and frame.rise(contact["normal"]) >= walkable
                     for contact in step["contacts"])
        if jumping or not landed:
            return landed and frame.rise(step["velocity"]) > self.rise
        # It landed once more, if it went up as only a jump does.
        rises = [(frame.rise(b) - frame.rise(a), float(b[2]) - float(a[2])) for a, b in zip(step["path"], step["path"][1:])]
        fast = self.character["jump_speed"] / 2 * dt
        return step["grounded"] and any(time > 0 and rise > fast * time for rise, time in rises)

    def end(self, step, dt, motion, frame):
        if motion.parts() > 1:
            self.end_later_parts(step, dt, motion.parts(), frame)
        self.velocity, self.grounded = step["velocity"], step["grounded"]
        self.jumping = step.get("jumping", False) and (self.jumping or not self.grounded)
        self.crushed = bool(step.get("crush")) or (self.crushed and step.get("stuck", False))
        self.sides = {contact["side"] for contact in step["contacts"]}
        self.ride = step.get("ride")
        self.left_ground = not self.ride and any(step.get("ground_velocity", (0, 0)))
        on_collider = self.ride and "collider" in self.ride
        self.carrier = tuple(float(x) / dt for x in (motion.change(self.ride["collider"]) if on_collider else (0, 0)))


def differs(wanted, step, scalar):
    """In words, where the step says that it was asked for something else, by more than rounding."""
    rounding = (1e-5 if scalar == "float" else 2e-12) * wanted.size + 1e-300
    if hypot(*less(wanted.way, step["requested"])) > rounding:
        return f"wanted to go {tuple(wanted.way)}, and says {tuple(step['requested'])}"
    if abs(wanted.steered - step["steered"]) > rounding:
        return f"was steered by {wanted.steered} m, and says {step['steered']}"
    return None
