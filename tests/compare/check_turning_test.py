#!/usr/bin/env python3
"""That check_trace.py finds what is wrong beside what turns: traces that are made here, whose answers are fractions.

A square of 1 m has its middle at x = 1. An arm of no thickness is held at the origin, and its tip goes up and down at
x = 2, so that it meets the lower right corner of the square first, at (1.5, h): where the tip is 4/3 h high.
"""
import unittest

from check_trace import Checker
from trace_spoiling import GAP, Spoiling

RISE = 0.375  # of the square above the flat arm
MEETS = 0.5  # height of the tip


def entry(heights, instants=None):
    """Of the arm, whose tip goes from one height to the next."""
    instants = instants or [k / (len(heights) - 1) for k in range(len(heights))]
    return {"k": instants, "vertices": [[[0, 0], [2, height]] for height in heights]}


def trace(ways):
    """`ways`: for each step the corners (height of the square's lower side, fraction), and the arm's heights."""
    header = {
        "paperproof_trace": 1, "scene": "made", "contender": "box2d", "scalar": "float", "dt": 0.25,
        "points": [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]],
        "colliders": [{"id": "arm", "chain": [[0, 0], [2, 0]]}]}
    steps = [{
        "step": k, "path": [[1, height + 0.5, fraction] for height, fraction in corners], "requested": [0, 0],
        "velocity": [0, 0], "grounded": False, "start_overlap": [], "contacts": [],
        "movers": {"arm": entry(heights)}} for k, (corners, heights) in enumerate(ways)]
    return header, steps


def staying(*heights, height=RISE):
    return trace([([(height, 0), (height, 1)], heights)])


class BesideWhatTurns(unittest.TestCase):
    def said(self, header, steps, too_close=0):
        checker = Checker(header)
        words = [words for _, words in checker.check(steps)]
        self.assertEqual(checker.too_close, too_close)
        return words

    def assert_passes(self, words, ends_inside):
        self.assertEqual(["passes or enters arm" in said for said in words], [True, False][:1 + ends_inside])
        self.assertEqual(words[1:], ["ends inside arm"] * ends_inside)

    def test_an_arm_that_comes_up_to_the_square_or_a_hair_further(self):
        self.assertEqual(self.said(*staying(0, MEETS - 1e-9)), [])
        self.assert_passes(self.said(*staying(0, MEETS + 1e-9)), ends_inside=True)

    def test_an_arm_that_comes_down_from_above(self):
        # Onto the upper left corner at (0.5, 1.375): the tip is at 5.5 then.
        self.assertEqual(self.said(*staying(6, 5.5 + 1e-9)), [])
        self.assert_passes(self.said(*staying(6, 5.5 - 1e-9)), ends_inside=True)

    def test_an_arm_that_sweeps_all_through_the_square(self):
        self.assert_passes(self.said(*staying(-1, 6)), ends_inside=False)
        self.assert_passes(self.said(*staying(6, -1)), ends_inside=False)

    def test_an_arm_that_comes_in_and_goes_back_within_the_step(self):
        self.assert_passes(self.said(*staying(0, MEETS + 1e-6, 0)), ends_inside=False)
        self.assertEqual(self.said(*staying(0, MEETS - 1e-6, 0)), [])

    def test_a_turn_and_back_between_two_steps_is_none(self):
        self.assertEqual(self.said(*staying(0.05, 0.05)), [])

    def test_a_square_that_rises_as_fast_as_the_arm(self):
        def height(tip):
            return 0.75 * tip + 1e-9

        self.assertEqual(self.said(*trace([([(height(0.1), 0), (height(0.4), 1)], (0.1, 0.4))])), [])
        middle = height(0.25) - 1e-6
        words = self.said(*trace([([(height(0.1), 0), (middle, 0.5), (height(0.4), 1)], (0.1, 0.4))]))
        self.assertEqual(len(words), 2, "it comes into the corner between the two legs, and leaves it")

    def test_a_leap_in_no_time_past_the_arm_where_it_is_then(self):
        leap = [(RISE, 0), (RISE, 0.5), (-2, 0.5), (-2, 1)]
        self.assert_passes(self.said(*trace([(leap, (0, MEETS / 2))])), ends_inside=False)
        away = [(RISE, 0), (RISE, 0.5), (2, 0.5), (2, 1)]
        self.assertEqual(self.said(*trace([(away, (0, MEETS / 2))])), [])

    def test_what_turns_and_goes_along(self):
        def moved(by):
            header, steps = staying(0, MEETS + 1e-3)
            for vertex in steps[0]["movers"]["arm"]["vertices"][1]:
                vertex[1] += by
            return self.said(header, steps)

        self.assertEqual(moved(-0.01), [], "it has gone down by more than it came up")
        self.assert_passes(moved(0.01), ends_inside=True)

    def test_a_square_deep_inside_a_solid_that_touches_it_nowhere(self):
        header, steps = staying(0, 0)
        outline, hole = ([[-s, -s], [s, -s], [s, s], [-s, s]] for s in (9, 5))
        header["colliders"] = [{"id": "arm", "polygon": outline}]
        turned = [[x - y / 10, y + x / 10] for x, y in outline]
        steps[0]["movers"]["arm"]["vertices"] = [outline, turned]
        self.assert_passes(self.said(header, steps), ends_inside=True)
        header["colliders"][0]["holes"] = [hole]
        steps[0]["movers"]["arm"]["vertices"] = [outline + hole, turned + [[x - y / 10, y + x / 10] for x, y in hole]]
        self.assertEqual(self.said(header, steps), [])

    def test_an_overlap_at_the_start_that_is_told_or_is_none(self):
        header, steps = staying(MEETS + 0.01, MEETS + 0.02)
        steps[0]["start_overlap"] = ["arm"]
        self.assertEqual(self.said(header, steps), [])
        header, steps = staying(MEETS, MEETS - 0.01)
        steps[0]["start_overlap"] = ["arm"]
        self.assertEqual(self.said(header, steps), ["does not overlap arm at the start, as it says"])

    def test_a_touch_that_slides_is_exact(self):
        self.assertEqual(self.said(*staying(0, 0, height=0)), [])


class SpoiltTurning(Spoiling, unittest.TestCase):
    """Of a square that stays while the arm comes up to it and goes down again."""
    header, steps = trace([([(RISE, 0), (RISE, 1)], heights) for heights in ((0, MEETS - GAP), (MEETS - GAP, 0))])

    def test_an_arm_that_jumps(self):
        self.expect("has arm begin elsewhere",
                    lambda _, steps: steps[1]["movers"]["arm"]["vertices"][0][1].__setitem__(1, 0))

    def test_an_arm_that_no_longer_turns(self):
        self.expect("has not the same movers", lambda _, steps: steps[1]["movers"].update(arm=[[0, 0], [0, 0]]))

    def test_instants_that_go_back_or_end_early(self):
        for instants in ([0.5, 1], [0, 0.5], [0, 0]):
            self.expect("do not ascend from 0 to 1", lambda _, steps: steps[0]["movers"]["arm"].update(k=instants))

    def test_vertices_that_are_missing(self):
        self.expect("without 2 vertices", lambda _, steps: steps[0]["movers"]["arm"]["vertices"][1].pop())

    def test_a_square_that_is_lower_than_it_was(self):
        def spoil(_, steps):
            for step in steps:
                for corner in step["path"]:
                    corner[1] -= 2 * GAP

        self.expect("passes or enters arm", spoil)
        self.expect("ends inside arm", spoil)

    def test_a_crush_excuses_the_arm(self):
        def spoil(_, steps):
            steps[0]["movers"]["arm"] = entry([0, MEETS + GAP])
            steps[1]["movers"]["arm"] = entry([MEETS + GAP, 0])
            steps[0]["crush"] = ["arm"]
            steps[1]["start_overlap"] = ["arm"]

        self.assertEqual(self.found(spoil), [])


class OfWhoPromises(Spoiling, unittest.TestCase):
    """A contact with the arm, whose tip stays at 0.4: the line is at 0.3 under the corner, and turns its normal back."""
    n = [-0.2 / 1.04 ** 0.5, 1 / 1.04 ** 0.5]
    gap = 4e-7
    header, steps = trace([([(0.31, 0), (0.3 + gap / n[1], 0.5), (0.3 + gap / n[1], 1)], (0.4, 0.4))])
    header["contender"], header["scalar"] = "octagon_sweep", "double"
    steps[0]["contacts"] = [{"collider": "arm", "point": [1.5, 0.3], "normal": n, "fraction": 0.5, "separation": gap}]

    def test_a_point_that_is_not_on_the_arm(self):
        self.expect("not on arm", lambda _, steps: steps[0]["contacts"][0].update(point=[1.5, 0.31]))

    def test_an_arm_that_is_farther_away(self):
        self.expect("keeps a gap", lambda _, steps: (steps[0]["movers"].update(arm=entry([0.39, 0.39])),
                                                    steps[0]["contacts"][0].update(point=[1.5, 0.2925])))


if __name__ == "__main__":
    unittest.main()
