"""What happens to sensors along a way, and what is reported of it, for check_trace.py."""
from trace_geometry import GAP, ZERO, Fraction, add, between, circle_crossings, crossings, less, scaled, size
from trace_world import STAYS


class SensorChecks:
    """Of a checker: it has the world, its colliders and the body, and says what it skips."""

    def sensor_events(self, name, corners):
        """(change, leg, fraction of the leg) of everything that happens to a sensor, which stands still."""
        states = []  # in turn at an instant and between two, with the leg and its fraction
        sensor = self.colliders[name]
        for leg, (start, end) in enumerate(zip(corners, corners[1:])):
            way = less(end, start)
            near = self.world.meets(name, start, way, self.body)
            found = []
            if near and sensor.radius:
                found = circle_crossings(start, way, self.body, sensor.centre, sensor.radius)
            elif near:
                found = crossings(start, way, self.body, sensor.edges)
            times = [ZERO] + sorted({t for t in found if 0 < t < 1}) + [Fraction(1)]
            for first, last in zip(times, times[1:]):
                for t in (first, (first + last) / 2):
                    at = add(start, scaled(way, t))
                    states.append((near and self.world.meets(name, at, STAYS, self.body), leg, first if t == first else last))
        states.append((self.world.meets(name, corners[-1], STAYS, self.body), len(corners) - 2, Fraction(1)))
        for i, (before, now) in enumerate(zip(states, states[1:])):
            if before[0] != now[0]:
                instant = before if i % 2 == 0 else now
                yield "enter" if now[0] else "exit", instant[1], instant[2]

    def check_sensors(self, step, _):
        if not self.asks("sensor") or step.sampled:
            return
        path = step.path
        for name, collider in self.colliders.items():
            if not collider.sensor:
                continue
            if step.motion.turns(name):
                self.skip("sensor", "turns")
                continue
            corners = [step.motion.seen(name, corner) for corner in path]
            expected = [(change, between(path[leg], path[leg + 1], share)[2])
                        for change, leg, share in self.sensor_events(name, corners)]
            found = [(e["change"], Fraction(e["fraction"])) for e in step.get("sensors", []) if e["id"] == name]
            if [change for change, _ in found] != [change for change, _ in expected]:
                words = [f"{change} at {float(t)}" for change, t in expected] or ["nothing"]
                yield "sensor", f"does not report {', '.join(words)} at the sensor {name}"
                continue
            length = sum(size(less(end, start)) for start, end in zip(corners, corners[1:]))
            for (change, reported), (_, right) in zip(found, expected):
                if not abs(reported - right) * Fraction(length) <= GAP:
                    yield "sensor", f"has the {change} of {name} at {float(reported)}, not at {float(right)}"
