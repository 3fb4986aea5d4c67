"""A peer for paperproof that goes where it is told and stops at nothing.

paperproof compare thin_platform --peer 'python3 compare/peers/straight.py'

Put your controller in place of `Character.step`: see README.md beside this file.
"""
import json
import sys


class Character:
    def __init__(self):
        self.x = self.y = 0.0

    def put(self, position, velocity):
        """The harness puts it somewhere: at the start, and after it fell out of a map."""
        self.x, self.y = position

    def step(self, wanted, dt):
        """One step of `dt` seconds. `wanted` is a velocity [m/s]: walking, falling and jumping are in it."""
        self.x += wanted[0] * dt
        self.y += wanted[1] * dt
        # Yours stops at `colliders`, and says the velocity that is left, whether it stands, and what it met and when:
        # "contacts": [{"collider": "floor", "normal": [0, 1], "fraction": 0.6}]
        return {"path": [[self.x, self.y, 1]], "velocity": wanted, "grounded": False}


def say(what):
    print(json.dumps(what), flush=True)


run = json.loads(sys.stdin.readline())["run"]  # the scene
colliders = run["colliders"]  # [{"id": "floor", "polygon": [[x, y], ...]}, {"id": "sheet", "chain": ...}]; metres, y is up
points = run["points"]  # of the character, relative to its position
say({"name": "straight", "version": "1", "can": ["movers", "turning", "one_way", "several", "circles", "conveyors"]})

characters = [Character() for _ in range(run.get("characters", 1))]
for line in sys.stdin:
    step = json.loads(line)
    answers = []
    for character, asked in zip(characters, step["characters"]):
        if "put" in asked:
            character.put(**asked["put"])
        answers.append(character.step(asked["wanted"], step["dt"]))
    say({"characters": answers})
