#!/usr/bin/env python3
"""That check_trace.py finds what is wrong: a good trace of octagon_sweep through article_bullet, and one among movers
that is made here, spoilt in one way each.

    check_trace_test.py TRACE.jsonl
"""
import json
import sys
import unittest
from math import nextafter

from check_trace import Checker
from trace_geometry import exact
from trace_one_way import lines_of, surfaces_of
from trace_spoiling import GAP, Spoiling
from trace_turning import Way, comes_to_overlap

with open(sys.argv.pop(), encoding="utf-8") as file:
    HEADER, *STEPS = map(json.loads, file)


class Surfaces(unittest.TestCase):
    """Of one-way chains, against a box of 1 m that has its lower left corner in a place."""

    def found(self, *lines):
        chains = [(number, None, exact(line), (0, 1)) for number, line in enumerate(lines)]
        return [[surface for _, _, surface in segments] for segments in surfaces_of(chains).values()]

    def is_above(self, surface, x, y):
        return surface.is_below(exact([[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]]))

    def test_of_a_peak_is_one_and_goes_on_straight(self):
        ((left, right),) = self.found([[-4, 0], [0, 1], [4, 0]])
        self.assertIs(left, right)
        for x, y, above in ((-0.5, 1, True), (-0.5, 0.999, False), (0, 1, True), (4, 0, True), (3.9, 0, False),
                            (5, -0.25, True), (5, -0.26, False), (-8, -0.75, True), (-8, -0.76, False)):
            self.assertEqual(self.is_above(left, x, y), above, (x, y))

    def test_is_joined_from_chains_that_run_either_way(self):
        (left,), (right,) = self.found([[-4, 0], [0, 1]], [[4, 0], [0, 1]])
        self.assertIs(left, right)

    def test_is_not_joined_where_three_meet(self):
        surfaces = self.found([[-4, 0], [0, 1]], [[4, 0], [0, 1]], [[0, 1], [4, 4]])
        self.assertEqual(len({surface for chain in surfaces for surface in chain}), 3)

    def test_is_cut_where_a_chain_turns_back_or_goes_straight_up(self):
        (first, second), = self.found([[0, 0], [4, 0], [1, 3]])
        self.assertIsNot(first, second)
        (first, second), = self.found([[0, 0], [4, 0], [4, 2], [6, 2]])
        self.assertIsNot(first, second)


class Lines(unittest.TestCase):
    def test_of_a_polygon_are_the_runs_of_edges_that_face_one_way(self):
        bowl = [[0, 0], [6, 0], [6, 3], [5, 3], [5, 1], [1, 1], [1, 3], [0, 3]]
        lines = [exact([[6, 3], [5, 3]]), exact([[5, 1], [1, 1]]), exact([[1, 3], [0, 3]])]
        self.assertEqual(lines_of(exact(bowl), (0, 1)), lines)
        self.assertEqual(len(lines_of(exact(bowl[::-1]), (0, 1))), 3)
        self.assertEqual(lines_of(exact([[0, 0], [4, 0], [2, 2]]), (0, 1)), [exact([[4, 0], [2, 2], [0, 0]])])


class SpoiltTraces(Spoiling, unittest.TestCase):
    header, steps = HEADER, STEPS[:3]

    def test_the_good_trace_has_a_contact(self):
        self.assertEqual(len(STEPS[0]["contacts"]), 1)

    def test_a_way_through_the_platform(self):
        def spoil(_, steps):
            steps[0]["path"] = [steps[0]["path"][0], [0, -3, 1]]
            steps[1:] = []

        self.expect("passes or enters platform", spoil)

    def test_an_end_inside_the_platform(self):
        def spoil(_, steps):
            steps[0]["path"][-1] = [0, 0.01, 1]

        self.expect("ends inside platform", spoil)

    def test_a_step_that_could_have_fallen(self):
        def stay(ledge):
            def spoil(header, steps):
                x, y, _ = steps[0]["path"][0]
                steps[0].update(path=[[x, y, 0], [x, y, 1]], contacts=[])
                steps[1:] = []
                right, low = (max(p[0] for p in header["points"]), min(p[1] for p in header["points"]))
                if ledge == "wall":
                    left = x + right + GAP
                    header["colliders"].append({"id": "wall", "chain": [[left, y - 9], [left, y + 9]]})
                elif ledge == "floor":
                    header["colliders"].append({"id": "floor", "chain": [[x - 9, y + low - GAP], [x + 9, y + low - GAP]]})
            return spoil

        self.expect("hangs: it could have fallen", stay(None))
        self.expect("hangs: it could have fallen", stay("wall"))
        self.assertNotIn("hangs: it could have fallen", self.found(stay("floor")))

    def test_paper_of_no_thickness_in_the_way(self):
        def spoil(header, _):
            header["colliders"].append({"id": "paper", "chain": [[-1, 0.5], [1, 0.5]]})

        self.expect("passes or enters paper", spoil)

    def test_a_one_way_chain_in_the_way_only_against_its_normal(self):
        def paper(one_way):
            return lambda header, _: header["colliders"].append(
                {"id": "paper", "chain": [[-1, 0.5], [1, 0.5]], "one_way": one_way})

        self.expect("passes or enters paper", paper([0, 1]))
        self.assertEqual(self.found(paper([0, -1])), [])

    def test_a_drop_through_a_one_way_chain_and_through_nothing_else(self):
        def dropping(names):
            def spoil(header, steps):
                header["colliders"].append({"id": "paper", "chain": [[-1, 0.5], [1, 0.5]], "one_way": [0, 1]})
                header["colliders"].append({"id": "tip", "chain": [[0.75, 0.5], [1, 0.5]], "one_way": [0, 1]})
                steps[0]["drop"] = names
            return spoil

        self.assertEqual(self.found(dropping(["paper"])), [])
        self.expect("drops through platform, which is no one-way chain", dropping(["paper", "platform"]))
        self.expect("does not drop through tip, as it says", dropping(["paper", "tip"]))

    def test_an_overlap_that_is_none(self):
        self.expect("does not overlap", lambda _, steps: steps[0].update(start_overlap=["platform"]))

    def test_a_jump_between_two_steps(self):
        def spoil(_, steps):
            for corner in steps[1]["path"]:
                corner[0] += 1

        self.expect("not where the last one ended", spoil)

    def test_a_fraction_that_is_too_early_or_too_late(self):
        along = 50 / 32  # the step is 50 px long: 2e-6 m is more than the slack, 0.5e-6 m less
        for off, words in ((2e-6, "earlier"), (-2e-6, "does not meet"), (0.5e-6, None), (-0.5e-6, None)):
            def spoil(_, steps):
                steps[0]["contacts"][0]["fraction"] += off / along

            if words:
                self.expect(words, spoil)
            else:
                self.assertEqual(self.found(spoil), [])

    def test_a_gap_that_is_wrong_or_too_wide(self):
        self.expect("is nowhere", lambda _, steps: steps[0]["contacts"][0].update(separation=1e-7))

        def lift(_, steps):
            for step in steps:
                for corner in step["path"]:
                    corner[1] += 1e-6
                for contact in step["contacts"]:
                    contact["separation"] += 1e-6

        self.expect("keeps a gap", lift)

    def test_a_gap_of_zero_that_is_not_the_one_it_was_put_with(self):
        def rest(_, steps):
            contact = steps[0]["contacts"][0]
            x, y, _ = steps[0]["path"][-1]
            for step in steps:
                step.update(requested=[0, -1], path=[[x, y - contact["separation"], t] for t in (0, 1)],
                            contacts=[dict(contact, fraction=0, separation=0)])

        def arrive(header, steps):
            rest(header, steps)
            steps[0]["path"][0][1] += 0.5
            steps[0]["contacts"][0]["fraction"] = 0.5

        self.assertEqual([words for words in self.found(rest) if "gap" in words], [])
        self.expect("keeps a gap of 0.0 m", arrive)

    def test_a_contact_point_off_the_platform(self):
        self.expect("is not on platform", lambda _, steps: steps[0]["contacts"][0].update(point=[0, 1e-6]))


def moving_trace():
    """A square of 1 m rides a lift that rises by 0.25 in every step, through the line of a sensor, until it has to stay
    under a ceiling and the lift comes into it; then the lift goes down again. A paper comes to its left side.
    """
    header = {
        "paperproof_trace": 1, "scene": "made", "contender": "octagon_sweep", "scalar": "double", "dt": 0.25,
        "points": [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]],
        "colliders": [
            {"id": "lift", "polygon": [[-2, -1], [2, -1], [2, 0], [-2, 0]]},
            {"id": "paper", "chain": [[-0.5, -4], [-0.5, 4]]},
            {"id": "ceiling", "polygon": [[-2, 1.75 + 2 * GAP], [2, 1.75 + 2 * GAP], [2, 3], [-2, 3]]},
            {"id": "line", "chain": [[-4, 1.125], [4, 1.125]], "sensor": True}],
    }
    lift = [0, 0.25, 0.5, 0.75, 1, 0.75]
    square = [0.5 + GAP + height for height in (0, 0.25, 0.5, 0.75, 0.75, 0.75)]
    paper = [-1, -GAP, -GAP, -GAP, -GAP, -GAP]
    steps = []
    for k in range(5):
        step = {
            "step": k, "path": [[0, square[k], 0], [0, square[k + 1], 1]], "requested": [0, 0.25 - 2.0 ** -10],
            "velocity": [0, 0], "grounded": True, "start_overlap": [], "contacts": [],
            "movers": {"lift": [[0, lift[k]], [0, lift[k + 1]]], "paper": [[paper[k], 0], [paper[k + 1], 0]]}}
        if k < 4:
            step["contacts"] = [{"collider": "lift", "point": [0, lift[k]], "normal": [0, 1], "fraction": 0,
                                 "separation": GAP, "side": "bottom"}]
        steps.append(step)
    # Its head is at 1 when it begins.
    steps[0]["sensors"] = [{"id": "line", "change": "enter", "fraction": (0.125 - GAP) / 0.25}]
    steps[3]["crush"] = ["lift"]
    steps[4]["start_overlap"] = ["lift"]
    return header, steps


class SpoiltMovingTraces(Spoiling, unittest.TestCase):
    header, steps = moving_trace()

    def test_a_rider_that_lags_behind(self):
        def spoil(_, steps):
            steps[1]["path"] = [steps[1]["path"][0], [0, steps[1]["path"][1][1] - 2 * GAP, 1]]

        self.expect("passes or enters lift", spoil)

    def test_a_rider_that_moves_later_than_what_carries_it(self):
        def spoil(_, steps):
            start, end = steps[1]["path"]
            steps[1]["path"] = [start, start[:2] + [0.5], end]

        self.expect("passes or enters lift", spoil)

    def test_a_paper_that_passes(self):
        def spoil(_, steps):
            for step in steps:
                step["movers"]["paper"][1][0] = 2
            for step in steps[1:]:
                step["movers"]["paper"][0][0] = 2

        self.assertEqual(len(self.found(spoil)), 1)
        self.expect("passes or enters paper", spoil)

    def test_a_crush_that_is_not_named(self):
        self.expect("ends inside lift", lambda _, steps: steps[3].pop("crush"))

    def test_a_crush_by_what_does_not_move(self):
        def spoil(_, steps):
            steps[3]["crush"] = ["ceiling"]

        self.expect("ends inside lift", spoil)
        self.expect("crushed by ceiling, which does not move", spoil)

    def test_a_crush_excuses_nothing_but_what_it_names(self):
        def spoil(_, steps):
            steps[3]["path"][1][1] += 4 * GAP
            steps[4:] = []

        self.expect("ends inside ceiling", spoil)

    def test_a_character_that_is_let_in_again_unsaid(self):
        self.expect("passes or enters lift", lambda _, steps: steps[4].update(start_overlap=[]))

    def test_an_overlap_that_the_mover_has_left(self):
        self.expect("does not overlap lift", lambda _, steps: steps[2].update(start_overlap=["lift"]))

    def test_a_mover_that_jumps_or_is_left_out(self):
        self.expect("not where it was", lambda _, steps: steps[2]["movers"]["paper"][0].__setitem__(1, 1e-9))
        self.expect("not the same movers", lambda _, steps: steps[2]["movers"].pop("paper"))

    def test_a_contact_point_where_the_mover_was_before(self):
        self.expect("is not on lift", lambda _, steps: steps[1]["contacts"][0].update(point=[0, 0]))

    def test_a_contact_point_far_from_the_rider(self):
        self.expect("with lift that is not on the character",
                    lambda _, steps: steps[1]["contacts"][0].update(point=[1.5, 0.25]))

    def test_a_fraction_that_is_not_that_of_the_relative_motion(self):
        self.expect("earlier than at 0.1", lambda _, steps: steps[1]["contacts"][0].update(
            fraction=0.1, point=[0, 0.25 + 0.025]))

    def test_a_sensor_that_is_not_reported_or_reported_wrongly(self):
        self.expect("does not report enter at 0.49", lambda _, steps: steps[0].pop("sensors"))
        self.expect("does not report enter at 0.49", lambda _, steps: steps[0]["sensors"][0].update(change="exit"))
        self.expect("does not report nothing", lambda _, steps: steps[1].update(sensors=steps[0]["sensors"]))
        for off, wrong in ((1e-5, True), (1e-6, False)):
            def spoil(_, steps):
                steps[0]["sensors"][0]["fraction"] += off

            self.assertEqual(any("has the enter of line" in said for said in self.found(spoil)), wrong)

    def test_sensors_passed_in_one_step(self):
        """Falling by 10 m through a line, and through both bars of a C that is one sensor."""
        def spoil(header, steps):
            header["colliders"] = [
                {"id": "line", "chain": [[-4, 0], [4, 0]], "sensor": True},
                {"id": "bars", "sensor": True, "polygon": [
                    [-2, 2], [3, 2], [3, -2], [-2, -2], [-2, -2.5], [4, -2.5], [4, 2.5], [-2, 2.5]]}]
            events = [("bars", "enter", 0.2), ("bars", "exit", 0.35), ("line", "enter", 0.45), ("line", "exit", 0.55),
                      ("bars", "enter", 0.65), ("bars", "exit", 0.8)]
            steps[1:] = []
            steps[0].update(path=[[0, 5, 0], [0, -5, 1]], contacts=[], movers={}, sensors=[
                {"id": name, "change": change, "fraction": fraction} for name, change, fraction in events])

        self.assertEqual(self.found(spoil), [])


class Circles(unittest.TestCase):
    """A box of 2 m beside a circle of 5 m, against triangles of 3, 4, 5."""

    def checker(self, **more):
        return Checker({"points": [[-1, -1], [1, -1], [1, 1], [-1, 1]], "contender": "octagon_sweep", "scalar": "double",
                        "colliders": [{"id": "ball", "circle": [0, 0, 5], **more}]})

    def meets(self, start, way=(0, 0)):
        return self.checker().meets("ball", *exact([start, way]))

    def test_are_overlapped_from_an_ulp_nearer_than_their_radius(self):
        for x, y, overlaps in ((0, 6, False), (0, nextafter(6, 0), True), (-4, 5, False), (-4, nextafter(5, 0), True),
                               (nextafter(-4, -9), 5, False), (0, 0, True)):
            self.assertEqual(self.meets((x, y)), overlaps, (x, y))

    def test_are_passed_by_a_way_along_their_tangent(self):
        # The lower right corner goes along the tangent through (-3, 4), up to the right by (4, 3).
        start = (-4 - 40, 5 - 30)
        self.assertFalse(self.meets(start, (80, 60)))
        self.assertTrue(self.meets(start, (80, nextafter(60, 0))))

    def test_that_turn_go_where_their_centres_go(self):
        checker = self.checker()
        for end, meets in ((6, False), (6 - 1e-12, True)):
            entry = {"k": [0, 1], "vertices": [[[0, -20]], [[20, -20]]]}
            way, body = Way(entry, checker.colliders["ball"]), checker.body
            path = exact([[0, -20 + end, 0], [20, -20 + end, 1]])
            self.assertEqual(comes_to_overlap(way, body, *path), meets)
            path = exact([[0, -20 + end, 0], [40, -20 + end, 1]])  # it leaves the circle behind
            self.assertEqual(comes_to_overlap(way, body, *path), meets)

    def test_that_are_sensors_are_entered_and_left_where_an_edge_touches_them(self):
        found = list(self.checker(sensor=True).sensor_events("ball", exact([[-10, 0], [10, 0]])))
        self.assertEqual([change for change, _, _ in found], ["enter", "exit"])
        for (_, _, share), right in zip(found, (0.2, 0.8)):
            self.assertAlmostEqual(float(share), right, 12)

    def test_are_touched_where_a_contact_says(self):
        header = {"paperproof_trace": 1, "scene": "made", "contender": "octagon_sweep", "scalar": "double", "dt": 0.25,
                  "points": [[-1, -1], [1, -1], [1, 1], [-1, 1]], "colliders": [{"id": "ball", "circle": [0, 0, 5]}]}
        gap = 2.0 ** -21
        step = {"step": 0, "path": [[0, 7, 0], [0, 6 + gap, 1]], "requested": [0, -1], "velocity": [0, 0],
                "grounded": True, "start_overlap": [], "movers": {}, "contacts": [
                    {"collider": "ball", "point": [0, 5], "normal": [0, 1], "fraction": 1, "separation": gap,
                     "side": "bottom"}]}

        def found(**changed):
            contact = {**step["contacts"][0], **changed}
            return [words for _, words in Checker(header).check([{**step, "contacts": [contact]}])]

        self.assertEqual(found(), [])
        self.assertTrue(any("is not on ball" in words for words in found(point=[0, 5.0001])))
        self.assertTrue(any("is nowhere" in words for words in found(separation=2 * gap)))
        self.assertTrue(any("passes or enters ball" in words for _, words in Checker(header).check(
            [{**step, "path": [[0, 7, 0], [0, -7, 1]], "contacts": []}])))


def shouldering_trace():
    """A lift rises by 0.5 past a diamond. Its corner meets the diamond's lower left side after half the step, and pushes
    it aside; at the end the side of the lift is where its corner was.
    """
    header = {
        "paperproof_trace": 1, "scene": "made", "contender": "octagon_sweep", "scalar": "double", "dt": 0.25,
        "points": [[0, -0.5], [0.5, 0], [0, 0.5], [-0.5, 0]],
        "colliders": [{"id": "lift", "polygon": [[-2, -1], [0, -1], [0, 0], [-2, 0]]}]}
    slant, room = 0.5 ** 0.5, 2.0 ** -20  # the corner stops `room` below the diamond's side
    place = [0.25, 0.5 + room]
    step = {
        "step": 0, "path": [place + [0], place + [0.5], [place[0] + 0.125, place[1] + 0.125, 1]], "requested": [0, 0],
        "velocity": [0, 0], "grounded": False, "start_overlap": [], "movers": {"lift": [[0, 0], [0, 0.5]]},
        "contacts": [{"collider": "lift", "point": [0, 0.25], "normal": [slant, slant], "fraction": 0.5 + 2 * room,
                      "separation": slant * room, "side": "left"}]}
    return header, [step]


class SpoiltShoulderingTraces(Spoiling, unittest.TestCase):
    header, steps = shouldering_trace()

    def test_a_contact_that_is_right_only_after_its_fraction(self):
        self.expect("is not on lift", lambda _, steps: steps[0]["contacts"][0].update(point=[0, 0.5]))

    def test_a_contact_point_on_the_side_of_the_lift(self):
        self.expect("is nowhere", lambda _, steps: steps[0]["contacts"][0].update(point=[0, 0.25 - 2e-8]))

    def test_a_fraction_before_the_character_stopped(self):
        self.expect("is not on lift", lambda _, steps: steps[0]["contacts"][0].update(fraction=0.5 - 1e-6))
        self.expect("before the step", lambda _, steps: steps[0]["contacts"][0].update(fraction=-0.5))


if __name__ == "__main__":
    unittest.main()
