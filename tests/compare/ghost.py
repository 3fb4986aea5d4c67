"""A peer that moves straight through everything, and knows by bounding boxes what it overlaps.

usage: ghost.py [lies]    lies: it says that nothing is overlapped, ever
"""
import json
import sys


def box(points, at):
    return [min(p[k] for p in points) + at[k] for k in (0, 1)] + [max(p[k] for p in points) + at[k] for k in (0, 1)]


run = json.loads(sys.stdin.readline())["run"]
print(json.dumps({"name": "ghost", "version": "1", "can": ["movers", "one_way"], "overlap": True, "machine": "script"}), flush=True)
place = [0, 0]
for line in sys.stdin:
    asked = json.loads(line)
    if "overlap" in asked:
        mine, met = box(run["points"], asked["overlap"]), []
        for one in run["colliders"]:
            there = box(one.get("polygon") or one["chain"], asked.get("movers", {}).get(one["id"], {"to": [0, 0]})["to"])
            if all(mine[k] < there[k + 2] and there[k] < mine[k + 2] for k in (0, 1)) and sys.argv[1:] != ["lies"]:
                met.append(one["id"])
        print(json.dumps({"overlaps": met}), flush=True)
        continue
    me = asked["characters"][0]
    place = me.get("put", {"position": place})["position"]
    place = [place[k] + me["wanted"][k] * asked["dt"] for k in (0, 1)]
    print(json.dumps({"characters": [{"path": [[*place, 1]], "velocity": me["wanted"]}], "ns": 700}), flush=True)
