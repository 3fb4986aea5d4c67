"""Whether a step can have gone the way that a trace says: how long its legs are, and how fast it ends.

A leg takes its share of the step. In that time a character goes no farther than at the speed that it wanted, which a walk
keeps across up on the steepest ground, and with the belts that it touches. Some rules move it at once: the gap is restored,
straight ground is followed, `snap` and `step_height` follow ground down and climb. What moves pushes it as far as it goes
itself and 0.25 m more. What holds a character that is stuck leaves it only the latter.
"""
import math

from trace_geometry import GAP, less, size

AT_ONCE = 5e-6  # the start's gap is restored, and ground followed that hardly bends [m]
AIMED = 1e-6  # of each leg [m]
BEYOND = 0.25  # what moves pushes farther than it goes [m]
STAIRS = 4  # climbed in one step
PARTS = 2e-6  # share of the way for which a step in parts waits
ROUNDING = 1e-9


class Legs:
    def __init__(self, world, character):
        self.world, self.character = world, character
        self.kept = 1 / math.cos(math.radians(character["max_climb_degrees"]))

    def own_speed(self, step):
        """[m/s]"""
        want = [float(x) / step.dt for x in step.wanted]
        unsteered = less(want, step.frame.world(float(step.steered) / step.dt, 0))
        speed = max(math.hypot(*want), math.hypot(*unsteered))
        if step.in_parts:  # later ones fall, steer and jump
            faster = max(self.character["acceleration"], self.character.get("air_acceleration") or 0)
            speed += (math.hypot(*step.gravity) + faster) * step.dt + self.character["jump_speed"]
        return speed * self.kept

    def conveyed(self, step):
        touched = {name for corner in step.path for name, _ in self.world.edges_near(step.motion, corner, float(GAP))}
        return sum(abs(self.world.colliders[name].surface_speed) for name in touched)

    def pushed(self, step, others, own):
        """How far all goes that moves and may reach the character [m]."""
        ways = {name: step.motion.longest(name) for name in step.motion.first_and_last() if step.motion.goes(name)}
        reached = {name for corner in step.path for name, _ in self.world.edges_near(
            step.motion, corner, own + max(ways.values()))} if ways else set()
        return sum(way for name, way in ways.items() if name in reached) + sum(
            size(less(b[:2], a[:2])) for other in others for a, b in zip(other.path, other.path[1:]))

    def faults(self, step, others, first, held):
        """@param first the leg that is looked at first. @param held it is stuck: it goes nowhere by itself."""
        def excess(speed):
            return sum(max(0.0, size(less(b[:2], a[:2])) - float(b[2] - a[2]) * step.dt * speed)
                       for a, b in zip(step.path[first:], step.path[first + 1:]))

        own = self.own_speed(step)
        speed, wish = 0 if held else own, own * step.dt
        largest = max(abs(float(x)) for corner in step.path for x in corner[:2])
        room = AT_ONCE + len(step.path) * (AIMED + largest * 2.0 ** -50) + ROUNDING * (1 + wish)
        if step.in_parts:
            room += PARTS * wish
        if step.began_grounded and not held:
            stairs = self.character.get("step_height", 0)
            room += self.character.get("snap", 0) + (STAIRS * 2 * stairs + wish if stairs else 0)
        ends_at = math.hypot(*step.velocity)
        too_fast = ROUNDING * (1 + ends_at)
        if excess(speed) <= room and ends_at <= speed + too_fast:
            return
        speed += self.conveyed(step)
        moved = self.pushed(step, others, wish)
        if excess(speed) > room + (moved + BEYOND if moved else 0):
            yield f"goes {excess(speed)} m farther than at {speed} m/s, and what moves goes {moved} m"
        if ends_at > speed + moved / step.dt + too_fast:
            yield f"ends at {ends_at} m/s, and nothing made it as fast"
