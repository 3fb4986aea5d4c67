"""The movers' scripts, for check_trace.py: where each mover is at a time, and whether a trace has it there."""
from bisect import bisect_right
from math import cos, fmod, hypot, sin

from trace_geometry import Fraction, less, size
from trace_world import wider

POSE = 1e-9  # rounding of a pose [m], for each metre of its coordinates
AT_ONCE = 0.05  # what is near a character turns at once by so much of its size at most [m],
PARTS = 32  # or by that part of the turn of a step where that is more
NEAR = 0.1  # [m]
SAMPLES = 8  # moments within a step at which that is looked at


def value_at(entries, time, loop):
    """Of a path or of turns: linear between entries. With how often a loop has begun anew."""
    first, last = entries[0]["t"], entries[-1]["t"]
    length, rounds = last - first, 0
    if not time > first or not length > 0:
        return entries[0]["at"], 0
    if loop == "once":
        time = min(time, last)
    else:
        rest = fmod(time - first, length if loop == "loop" else 2 * length)
        rounds = round((time - first - rest) / length) if loop == "loop" else 0
        time = first + rest if rest <= length else last - (rest - length)
    k = min(bisect_right([entry["t"] for entry in entries], time), len(entries) - 1)
    a, b = entries[k - 1], entries[k]
    share = min(max((time - a["t"]) / (b["t"] - a["t"]), 0), 1)
    if isinstance(a["at"], list):
        return [x + share * (y - x) for x, y in zip(a["at"], b["at"])], rounds
    return a["at"] + share * (b["at"] - a["at"]), rounds


def angle_at(mover, time):
    turns = mover.get("turns") or [{"t": 0, "at": 0}]
    angle, rounds = value_at(turns, time, mover["loop"])
    return angle + rounds * (turns[-1]["at"] - turns[0]["at"])


class Scripts:
    def __init__(self, header, world):
        self.movers = header.get("movers", [])
        self.world, self.colliders = world, world.colliders
        self.near = wider(world.body, Fraction(NEAR))
        box = world.box_of(world.body)
        self.extent = hypot(*(high - low for low, high in box))
        self.farthest = max(size(corner) for corner in world.body)
        self.dt, self.begins, self.length, self.step = header["dt"], 0.0, 0.0, -1
        self.float = header["scalar"] == "float"

    def times(self, step):
        """When it begins and ends [s]. Lengths of their own are added up."""
        if "dt" not in step:
            return step["step"] * self.dt, (step["step"] + 1) * self.dt
        if step["step"] != self.step:
            self.begins += self.length
            self.step = step["step"]
        self.length = step["dt"]
        return self.begins, self.begins + step["dt"]

    def faults(self, times, motion, path):
        begin, end = times
        for mover in self.movers:
            for name in mover["colliders"] if not mover.get("body") else ():  # that Box2D moves
                if motion.turns(name):
                    yield from self.turned(mover, name, motion, begin, end, path)
                elif name in motion.ends:
                    for time, place in zip((begin, end), motion.ends[name]):
                        at, _ = value_at(mover["path"], time, mover["loop"])
                        off = hypot(*(float(p) - x for p, x in zip(place, at)))
                        if not off <= self.slack(at):
                            yield f"has {name} {off} m from where its script has it at {time} s"
                else:
                    yield f"has no place of {name}, which goes by a script"
        told = {name for mover in self.movers for name in mover["colliders"]}
        for name in motion.first_and_last():
            if name not in told:
                yield f"moves {name}, of which there is no script"

    def slack(self, at):
        return (1e-6 if self.float else POSE) * (1 + max(map(abs, at)))

    def pose(self, mover, time, point):
        at, _ = value_at(mover["path"], time, mover["loop"])
        angle = angle_at(mover, time)
        x, y = map(float, point)
        return [x * cos(angle) - y * sin(angle) + at[0], x * sin(angle) + y * cos(angle) + at[1]]

    def turned(self, mover, name, motion, begin, end, path):
        """Poses at both ends. In between a vertex may leave its arc: what is near a character turns at once, about a point
        near it, by a small angle, and then goes straight."""
        way, points = motion.ways[name], self.colliders[name].points
        turn = abs(angle_at(mover, end) - angle_at(mover, begin))
        is_near = self.world.met(name, motion, path[0], path[0], self.near) is not False
        at_once = min(turn, max(AT_ONCE / self.extent, turn / PARTS)) if is_near else turn
        for share in [0, 1] + [k / SAMPLES for k in range(1, SAMPLES)]:
            time = end if share == 1 else begin + share * (end - begin)
            there = way.at(share) if share not in (0, 1) else way.vertices[-share]
            for point, vertex in zip(points, there):
                pose = self.pose(mover, time, point)
                off, slack = hypot(*(float(p) - x for p, x in zip(vertex, pose))), self.slack(pose)
                if share not in (0, 1):
                    radius = size(point)
                    away = max(size(less(vertex, corner[:2])) for corner in path)
                    slack += at_once * max(radius, 2 * away + 4 * self.farthest) + radius * at_once ** 2 / 8
                    slack += 1e-6 * radius * turn
                if not off <= slack:
                    yield f"has {name} {off} m from where its script has it at {time} s, and may leave that by {slack} m"
                    return
