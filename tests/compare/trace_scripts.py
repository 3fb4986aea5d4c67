"""The movers' scripts, for check_trace.py: where each mover is at a time, and whether a trace has it there."""
from bisect import bisect_right
from math import cos, fmod, hypot, sin

POSE = 1e-9  # rounding of a pose [m], for each metre of its coordinates
ARC = 0.05  # how far a vertex may be from where it turns [m]
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


class Scripts:
    def __init__(self, header, colliders):
        self.movers = header.get("movers", [])
        self.colliders = colliders
        self.dt, self.begins, self.step = header["dt"], 0.0, -1
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

    length = 0.0

    def faults(self, step, motion):
        begin, end = self.times(step)
        told = set()
        for mover in self.movers:
            told.update(mover["colliders"])
            if mover.get("body"):
                continue  # Box2D moves it
            for name in mover["colliders"]:
                if motion.turns(name):
                    yield from self.turned(mover, name, motion.ways[name], begin, end)
                elif name in motion.ends:
                    for time, place in zip((begin, end), motion.ends[name]):
                        at, _ = value_at(mover["path"], time, mover["loop"])
                        off = hypot(*(float(p) - x for p, x in zip(place, at)))
                        if not off <= self.slack(at):
                            yield f"has {name} {off} m from where its script has it at {time} s"
                else:
                    yield f"has no place of {name}, which goes by a script"
        for name in motion.first_and_last():
            if name not in told:
                yield f"moves {name}, of which there is no script"

    def slack(self, at):
        return (1e-6 if self.float else POSE) * (1 + max(map(abs, at)))

    def pose(self, mover, time, point):
        at, _ = value_at(mover["path"], time, mover["loop"])
        turns = mover.get("turns")
        if not turns:
            return [float(p) + x for p, x in zip(point, at)]
        angle, rounds = value_at(turns, time, mover["loop"])
        angle += rounds * (turns[-1]["at"] - turns[0]["at"])
        x, y = map(float, point)
        return [x * cos(angle) - y * sin(angle) + at[0], x * sin(angle) + y * cos(angle) + at[1]]

    def turned(self, mover, name, way, begin, end):
        points = self.colliders[name].points
        for share, slack in [(0, None), (1, None)] + [(k / SAMPLES, ARC) for k in range(1, SAMPLES)]:
            time = end if share == 1 else begin + share * (end - begin)
            there = way.at(share) if share not in (0, 1) else way.vertices[-share]
            poses = [self.pose(mover, time, point) for point in points]
            off = max(hypot(*(float(p) - x for p, x in zip(vertex, pose))) for vertex, pose in zip(there, poses))
            if not off <= (slack or max(map(self.slack, poses))):
                yield f"has {name} {off} m from where its script has it at {time} s"
                return
