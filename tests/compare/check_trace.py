#!/usr/bin/env python3
"""Judges a trace of paperproof without any of its code: Python's standard library, exact fractions, nothing else. (Where
gmpy2 is installed, its fractions take a fifth of the time.)

    check_trace.py [--all | --clauses NAME,NAME...] [--but NAME,NAME...] FILE.jsonl...

It asks for the clauses that the trace's header guarantees, for all that it knows (--all), or for those named. One line
for each that is broken: file, step, clause, what happened. At the end of each file it says how much it judged, and what
it did not judge. Exit status: 0 all holds, 1 something does not, 2 not a trace, or one that does not say what was wanted.

overlap, passage, one_way: the way that was travelled, corner by corner, enters no solid that the character was not
    already in, no other character, and no one-way chain from above; the step does not end inside. What moves is where its
    way has it at each moment. Only a mover that crushes may come into the character: whether it left room, `crush` asks.
crush: there is no room where a step says that a mover crushed: trace_room.py. It finds room, or does not judge.
gap, normal, contact_invented: a contact is as it says at a corner of the way no later than its fraction: its point lies
    on both, the gap along its normal is its separation, above 0 and at most 1e-6 m (0 where the scene put them so), the
    normal keeps the two apart, and the motion leads into it.
time_of_impact, contact_missed: what was wanted, from where the step began, meets nothing before the first contact that is
    reported, and meets that one then, to 1e-6 m along the normal.
sensor: the events are those of the way, in order, with fractions that are right to 1e-6 m along it.
wanted: trace_motion.py works out what was wanted from scene, inputs and the state before.
speed_lost, velocity: no leg is longer, and no end faster, than trace_legs.py allows. Without a contact a character goes as
    wanted and as fast. With contacts it loses speed across up only
    to what is no ground and opposes it, a fall only to what looks up, a rise only to what looks down or to the end of
    a climb; and comes out no faster than it was, but along ground.
ground_invented, ground_missed, hanging: trace_ground.py.
rest: where position, velocity and input have repeated, position does not change, bit for bit.
start_inside: a step that begins inside of solids leaves them at once, by a way that is not longer than another that
    trace_room.py finds, or is held there, and says that it is stuck or crushed; a step that says it is stuck is inside of
    something, and no straight way out is found.
refusal: a refused step had no finite input, no length, or would have left 2e6 m.
continuity: a step begins where the last one ended, movers too; fractions ascend from 0 to 1; only who left the map's box
    is put back; the last one is that of the run, where the header says how many `steps` it has, or was refused.
mover_way: movers are where their scripts have them: trace_scripts.py.

Of characters that go at the same time contacts, ground, falls, speed, room and starts inside are not asked: others may have
turned them aside, held or pushed them. In turns all is asked.

Every number of a trace is a double, and every double is a fraction: the answers are exact but where a tolerance is named.
"""
import argparse
import collections
import itertools
import json
import math
import sys

from trace_company import Company
from trace_contacts import NEARLY, ContactChecks
from trace_geometry import GAP, NEAR_DROP, NEAR_PASS, ZERO, Fraction, add, less, show, size, vector
from trace_ground import Ground
from trace_legs import Legs
from trace_motion import Intent, differs
from trace_room import Room
from trace_scripts import Scripts
from trace_sensors import SensorChecks
from trace_speed import SpeedChecks
from trace_step import Step
from trace_world import STAYS, World, wider

CLAUSES = ("overlap", "passage", "one_way", "gap", "time_of_impact", "contact_missed", "contact_invented", "normal", "sensor",
           "rest", "start_inside", "refusal", "hanging", "speed_lost", "ground_invented", "ground_missed", "crush", "wanted",
           "velocity", "continuity", "mover_way")
BESIDE_OTHERS = {"gap", "time_of_impact", "contact_missed", "contact_invented", "normal", "start_inside", "hanging", "speed_lost",
                 "ground_invented", "ground_missed", "crush", "velocity"}  # not asked of those that go at the same time
NEEDED = ("scene", "contender", "scalar", "mode", "dt", "points", "gravity", "up", "character", "starts", "guarantees",
          "colliders")
NEEDED_IN_A_STEP = ("step", "input")
NEEDED_UNLESS_REFUSED = ("path", "requested", "steered", "velocity", "grounded", "start_overlap", "movers", "contacts")
UNSAID = {"jump_cut": 1, "max_climb_degrees": 50, "no_jump_toward_wall": False, "wall_reach": 1 / 32}  # of a character
FARTHEST = 2e6  # [m]
LEFT_BOX = 10.0  # who leaves a map's box by this is put back [m]
SHORTEST = 1e-5  # a way out is no longer than another by this: gaps at its end differ [m]
WAY_OUT = 10.0  # a way out of a solid is looked for this far [m]


class Checker(ContactChecks, SensorChecks, SpeedChecks):
    def __init__(self, header, clauses=None):
        missing = [key for key in NEEDED if key not in header]
        if missing:
            raise ValueError(f"the header does not say what was wanted: no {', '.join(missing)}")
        self.header = header = {**header, "character": {**UNSAID, **header["character"]}}
        self.clauses = set(header["guarantees"] if clauses is None else clauses)
        self.count = header.get("characters", 1)
        self.world = World(header)
        self.body, self.colliders = self.world.body, self.world.colliders
        self.bodies = {by: wider(self.body, by) for by in (GAP, NEAR_DROP, NEAR_PASS, NEARLY)}
        self.legs = Legs(self.world, header["character"])
        self.ground = Ground(self.world, header["character"]["max_climb_degrees"])
        self.scripts = Scripts(header, self.world)
        self.company = Company(self.body)
        self.intents = [Intent(header, start) for start in header["starts"]]
        self.last = {}  # by character: the step before,
        self.repeated = collections.Counter()  # how often it has been the same,
        self.put = {}  # the step in which it was put where it began,
        self.sides = collections.defaultdict(dict)  # and where it was last free of what it is inside of
        self.judged = collections.Counter()
        self.skipped = collections.Counter()  # (clause, why): in how many steps it was not judged

    def asks(self, *clauses):
        return not self.clauses.isdisjoint(clauses)

    def skip(self, clause, why):
        if clause in self.clauses:
            self.skipped[clause, why] += 1

    def check(self, records):
        """(record, clause, words) of every clause that is asked for and broken."""
        return (fault for fault in self.faults(records) if fault[1] in self.clauses)

    def faults(self, records):
        together, record = [], None
        for number, record in enumerate(records):
            needed = NEEDED_IN_A_STEP + (() if "refused" in record else NEEDED_UNLESS_REFUSED)
            missing = [key for key in needed if key not in record]
            if missing:
                raise ValueError(f"step {record.get('step', 'without a number')}: no {', '.join(missing)}")
            if number == 0 and "movers" in record:
                self.world.find_surfaces(record["movers"])
            self.judged["steps"] += 1
            who, due = record.get("character", 0), number % self.count
            if who != due or who >= len(self.intents):
                yield self.fatal(record, f"has a record of character {who} where that of {due} belongs")
                return
            if "refused" in record:
                yield from ((record, "refusal", words) for words in self.check_refusal(record))
                continue
            self.judged["contacts"] += len(record["contacts"])
            together.append(Step(record, self.colliders, self.header))
            words = "; ".join(together[-1].unjudgeable())
            if words:
                yield self.fatal(record, f"{together[-1].told}cannot be judged: {words}")
                return
            if len(together) == self.count:
                turns = [step.turn for step in together]
                if turns != [None] * self.count and set(turns) != set(range(self.count)):
                    raise ValueError(f"step {record['step']}: the turns are {turns}: expected another one of each, or none")
                yield from self.check_together(together)
                together = []
        if record is None:
            raise ValueError("expected a step")
        steps, had = self.header.get("steps"), record["step"] + 1
        if steps is not None and had != steps and not ("refused" in record and had < steps):
            yield record, "continuity", f"is the last one, and the run has {steps} steps"

    def fatal(self, record, words):
        """Nothing after it can be judged, which is said whatever is asked for."""
        self.clauses.add("continuity")
        return record, "continuity", words

    def check_together(self, together):
        for step in together:
            step.last = self.last.get(step.who)
            others = [other for other in together if other is not step]
            step.note_others(others)
            step.pushed = step.turn is not None and any(self.company.goes(other, step) for other in others)
            yield from ((step.record, clause, step.told + words) for clause, words in self.check_alone(step, others))
        for one, other in itertools.permutations(together, 2):
            faults = list(self.company.check(one, other)) if one.who < other.who else []
            if one.turn is not None and self.asks("time_of_impact", "contact_invented", "normal") and not one.sampled:
                faults += self.company.check_met(one, other, self.is_turned)
            yield from ((one.record, clause, one.told + words) for clause, words in faults)
        self.last.update((step.who, step) for step in together)

    def is_repeated(self, step):
        """Whether nothing differs from the step before, so that neither does the verdict."""
        same = step.last is not None and self.count == 1 and {**step.record, "step": 0} == {**step.last.record, "step": 0}
        self.repeated[step.who] = self.repeated[step.who] + 1 if same else 0
        return self.repeated[step.who] > 1  # once more than needed: the state before was another one

    def check_alone(self, step, others):
        same = self.is_repeated(step)
        for check in (self.check_start, self.check_wanted, self.check_movers, self.check_rest):
            yield from check(step, same)
        if self.count > 1 and step.turn is None:
            # Others may have turned it aside, held or pushed it.
            step.excused = step.get("crush", [])
            for clause in BESIDE_OTHERS & self.clauses:
                self.skip(clause, "goes at the same time as others")
            for check in (self.check_way, self.check_sensors):
                yield from check(step, others)
        elif not same:
            for check in (self.check_carrier, self.check_crush, self.check_stuck, self.check_way, self.check_contacts, self.check_sensors,
                          self.check_ground, self.check_speed, self.check_legs):
                yield from check(step, others)
        self.note_sides(step)

    # Where a step begins, and what it wants.

    def check_start(self, step, _):
        start, who, last = step.path[0], step.who, step.last
        if last is None or step.get("respawn"):
            self.put[who] = step
        if last is None or last.path[-1][:2] != start[:2]:
            self.sides[who] = {}
        if last is None:
            at = vector(self.header["starts"][who]["position"])
            rounding = 2.0 ** -23 * (1 + size(at)) if self.header["scalar"] == "float" else 0
            if not size(less(start, at)) <= rounding and not step.get("respawn"):
                yield "continuity", f"begins at {show(start)}, not where the scene puts it: {show(at)}"
            return
        if step.get("respawn"):
            if not self.may_respawn(start, step):
                yield "continuity", "says that it was put back, and had not left the map"
        elif last.path[-1][:2] != start[:2]:
            yield "continuity", f"begins at {show(start)}, not where the last one ended"
        now, before = step.motion.first_and_last(), last.motion.first_and_last()
        if now.keys() != before.keys() or step.motion.ways.keys() != last.motion.ways.keys():
            yield "continuity", "has not the same movers as the step before"
        for name in now.keys() & before.keys():
            if now[name][0] != before[name][1]:
                yield "continuity", f"has {name} begin elsewhere, not where it was"

    def may_respawn(self, start, step):
        if self.header.get("mode") == "lockstep":
            return True
        box = self.header.get("respawn_box")
        if box is None:
            return False
        left = [float(x) for x in step.last.path[-1][:2]]
        outside = max(max(box[0][k] - left[k], left[k] - box[1][k]) for k in (0, 1))
        return outside >= LEFT_BOX * (1 - 1e-9) and start[:2] == vector(self.header["starts"][step.who]["position"])

    def check_wanted(self, step, _):
        intent = self.intents[step.who]
        if step.get("respawn") and step.last is not None:
            moved = step.last.path[-1][:2] != step.path[0][:2]
            intent.begin_anew(step.get("from", {"velocity": (0, 0)}), moved)
        elif step.get("from"):
            intent.begin_anew(step.record["from"])
        wanted = intent.wanted(step.record, step.dt, step.frame, step.gravity, step.motion, self.colliders,
                               lambda move: self.has_wall(step, move), step.ways_of_others)
        step.began_grounded, step.jumped = intent.began_grounded, intent.jumping and not intent.grounded
        if wanted is None:
            self.skip("wanted", "carried by what turns")
            step.wanted, step.steered = vector(step.record["requested"]), Fraction(step.record["steered"])
        else:
            words = differs(wanted, step.record, self.header["scalar"])
            if words:
                yield "wanted", words
            step.wanted, step.steered = vector(wanted.way), Fraction(wanted.steered)
        intent.end(step.record, step.dt, step.motion, step.frame)

    def has_wall(self, step, move):
        reach = Fraction(math.copysign(self.header["character"]["wall_reach"], move))
        there = add(step.path[0][:2], (step.up[1] * reach, -step.up[0] * reach))
        return any(self.world.met(name, step.motion, step.path[0], (*there, ZERO)) for name in self.world.solids)

    def check_movers(self, step, same):
        if self.asks("mover_way"):
            times = self.scripts.times(step.record)
            faults = [] if same else self.scripts.faults(times, step.motion, step.path)
            yield from (("mover_way", words) for words in faults)

    def check_rest(self, step, _):
        last = step.last
        put = step.get("from", {}) if step.get("respawn") else {}
        step.before = put.get("velocity", last.record["velocity"] if last else None)
        if not self.asks("rest") or last is None or step.get("respawn") or step.way() == STAYS or self.count > 1:
            return
        before = last.record
        repeated = last.way() == STAYS and last.before == before["velocity"] == step.record["velocity"]
        if repeated and before["input"] == step.record["input"] and not self.is_pushed(last) and not self.is_pushed(step):
            yield "rest", f"goes by {show(step.way())} m where position and velocity had repeated"

    # The way.

    def note_sides(self, step):
        """Where the character was last free of what it ends inside of, as the collider sees it."""
        known = self.sides[step.who]
        inside = self.world.overlapped(step.motion, step.path[-1])
        for name in set(known) - set(inside):
            del known[name]
        for name in inside:
            if name in known or step.motion.turns(name):
                continue
            free = [corner for corner in step.path if not self.world.met(name, step.motion, corner, corner)]
            if free:
                known[name] = step.motion.seen(name, free[-1])

    def room(self, step, others):
        return Room(self.world, step.motion, self.sides[step.who],
                    lambda way: all(self.company.leaves_free(way, self.company.stands(other, step)) for other in others))

    def check_crush(self, step, others):
        named = step.get("crush", [])
        if not named:
            return
        moving = [name for name in named if step.motion.goes(name)]
        for name in named:
            if name not in moving:
                yield "crush", f"is crushed by {name}, which does not move"
        if not moving:
            return
        if any(step.motion.turns(name) for name in step.get("start_overlap")):
            self.skip("crush", "begins inside what turns")
            step.excused = moving
            return
        room = self.room(step, others).find(step.path, moving)
        self.judged["crushes"] += 1
        if room is None or "crush" in self.clauses:  # one breach is said once
            step.excused = moving
        if room is not None:
            yield "crush", f"is crushed by {', '.join(moving)}, and has room at {show(room)}"

    def check_stuck(self, step, others):
        if not step.get("stuck") or not self.asks("start_inside"):
            return
        start, inside = step.path[0], step.record["start_overlap"]
        if not inside:
            if not self.world.overlapped(step.motion, step.path[-1]):
                yield "start_inside", "says that it is stuck, and is inside of nothing"
            return
        if any(map(step.motion.goes, step.motion.first_and_last())):
            self.skip("start_inside", "among what moves")
            return
        out = self.room(step, others).way_out(start, WAY_OUT)
        if out:
            yield "start_inside", f"says that it is stuck, and there is a way out to {show(out)}"

    def check_legs(self, step, others):
        """How far and how fast it goes at most, and whether it leaves what it begins inside of at once, or is held there."""
        if not self.asks("velocity", "start_inside") or step.sampled:
            return
        inside, says_so = step.record["start_overlap"], step.get("stuck") or step.get("crush")
        if any(map(step.motion.turns, inside)):
            self.skip("start_inside", "begins inside what turns")
            return
        start, after = step.path[0], step.path[1]
        left = [name for name in inside if after[2] == 0 and not self.world.met(name, step.motion, after, after)]
        held = len(left) < len(inside)
        ends_inside = any(self.world.met(name, step.motion, step.path[-1], step.path[-1]) for name in inside)
        characters = [other for other in others if other.who in step.get("start_overlap_characters", [])
                      and self.company.meet(step.path[-1:] * 2, other.path[-1:] * 2)]
        if ((held and ends_inside) or characters) and not says_so:
            yield "start_inside", "begins and ends inside, and does not say that it is stuck"
        for words in self.legs.faults(step, others, 1 if left else 0, held):
            yield "start_inside" if held else "velocity", words
        shorter = size(less(after[:2], start[:2])) - SHORTEST
        if inside and not held and shorter > 0:
            out = self.room(step, others).way_out(start, shorter)
            if out:
                yield "start_inside", f"leaves what it begins inside of to {show(after)}, and the way to {show(out)} is shorter"

    def check_way(self, step, _):
        path, motion, allowed = step.path, step.motion, step.record["start_overlap"]
        for name in allowed:
            if not self.world.met(name, motion, path[0], path[0]):
                yield "start_inside", f"does not overlap {name} at the start, as it says"
        for name in self.world.solids:
            collider = self.colliders[name]
            if name in allowed or name in step.excused:
                continue
            if name in step.get("drop", []):
                yield from self.check_drop(step, name)
                continue
            ends_inside = collider.one_way is None and self.world.met(name, motion, path[-1], path[-1])
            if ends_inside:
                yield "overlap", f"ends inside {name}"
            for start, end in zip(path, path[1:]):
                if self.world.met(name, motion, start, end):
                    clause = "one_way" if collider.one_way is not None else "overlap" if ends_inside else "passage"
                    yield clause, f"passes or enters {name} on its way from {show(start)} to {show(end)}"

    def check_drop(self, step, name):
        if self.colliders[name].one_way is None:
            yield "one_way", f"drops through {name}, which is no one-way chain"
        elif not step.record["input"].get("drop"):
            yield "one_way", f"drops through {name}, and was not asked to"
        elif not any(self.world.met(name, step.motion, start, end, self.bodies[NEAR_DROP])
                     for start, end in zip(step.path, step.path[1:])):
            yield "one_way", f"does not drop through {name}, as it says"

    def check_refusal(self, record):
        values = [record.get("dt", self.header["dt"]), record["input"].get("move", 0)]
        bad = [v for v in values if not isinstance(v, (int, float)) or not math.isfinite(v)]
        last = self.last.get(record.get("character", 0))
        far = last is not None and max(
            abs(float(x) + v * values[0]) for x, v in zip(last.path[-1][:2], last.record["velocity"])) > FARTHEST / 2
        if not bad and values[0] > 0 and not far:
            yield f"is refused ({record['refused']}), and nothing is wrong with it"

    def summary(self):
        told = []
        if self.judged["crushes"]:
            told.append(f"room looked for at {self.judged['crushes']} crushes")
        if self.world.too_close:
            told.append(f"too close to tell on {self.world.too_close} ways past what turns")
        unjudged = [f"{clause} in {n} steps ({why})" for (clause, why), n in sorted(self.skipped.items())]
        unjudged += [f"{clause} (unknown)" for clause in sorted(self.clauses - set(CLAUSES))]
        return told, unjudged


def check_file(path, clauses, but):
    broken = collections.Counter()
    with open(path, encoding="utf-8") as file:
        header = json.loads(file.readline())
        if header.get("paperproof_trace") != 1:
            raise ValueError("not a trace: expected \"paperproof_trace\": 1 in the header")
        checker = Checker(header, clauses)
        checker.clauses -= set(but)
        for record, clause, words in checker.check(map(json.loads, file)):
            print(f"{path}: step {record['step']}: {clause}: {words}")
            broken[clause] += 1
    told, unjudged = checker.summary()
    counts = [f"{checker.judged['steps']} steps", f"{checker.judged['contacts']} contacts",
              f"{sum(broken.values())} violations of {len(checker.clauses)} clauses"]
    print(f"{path}: " + ", ".join(counts + [f"{clause} {count}" for clause, count in sorted(broken.items())] + told))
    if unjudged:
        print(f"{path}: not judged: {'; '.join(unjudged)}")
    return sum(broken.values())


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--all", action="store_true", help="ask for every clause, whatever the header guarantees")
    which.add_argument("--clauses", help="ask for these alone")
    parser.add_argument("--but", default="", help="do not ask for these")
    parser.add_argument("files", nargs="+")
    options = parser.parse_args(arguments)
    clauses = CLAUSES if options.all else options.clauses.split(",") if options.clauses else None
    but = options.but.split(",") if options.but else []
    if not {*but, *(clauses or ())} <= set(CLAUSES):
        parser.error(f"a clause is one of {', '.join(CLAUSES)}")
    violations = 0
    for path in options.files:
        try:
            violations += check_file(path, clauses, but)
        except (OSError, ValueError, KeyError, TypeError, IndexError) as error:
            print(f"{path}: {error if isinstance(error, (OSError, ValueError)) else repr(error)}", file=sys.stderr)
            return 2
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
