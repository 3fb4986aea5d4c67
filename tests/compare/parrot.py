"""A peer that says again what a trace has. It ends with status 1 where it is asked for another motion.

usage: parrot.py TRACE [WHAT IT LEAVES OUT OF CONTACTS, OR contacts]
"""
import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    header, *steps = map(json.loads, file)
json.loads(sys.stdin.readline())
exact = steps[0].get("path_exact", True)
print(json.dumps({"name": "parrot", "version": "1", "can": ["movers", "one_way", "circles", "conveyors"],
                  "path_exact": exact, "scalar": header["scalar"]}), flush=True)
for step, line in zip(steps, sys.stdin):
    asked = json.loads(line)
    for mine, theirs in zip(step["requested"], asked["characters"][0]["wanted"]):
        assert abs(mine - theirs * asked["dt"]) <= 1e-5, f"step {step['step']}: another motion"
    said = {"path": step["path"][1:], "velocity": step["velocity"], "grounded": step["grounded"]}
    if "ride" in step:
        normals = [c["normal"] for c in step["contacts"] if c["collider"] == step["ride"]["collider"]]
        said["ground"] = {"collider": step["ride"]["collider"], "normal": normals[0] if normals else [0, 1]}
    left_out = ["side", *sys.argv[2:]]
    if "contacts" not in left_out:
        said["contacts"] = [{key: contact[key] for key in contact if key not in left_out} for contact in step["contacts"]]
    print(json.dumps({"characters": [said], "ns": 1000}), flush=True)
