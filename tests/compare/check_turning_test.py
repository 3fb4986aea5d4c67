#!/usr/bin/env python3
"""That check_trace.py finds what is wrong beside what turns: traces that are made here, whose answers are formulas.

A square of 1 m has its middle at x = 1. An arm of no thickness turns about the origin, 2 m long and flat at angle 0, so
that it meets the lower right corner of the square first, at (1.5, h): where tan(angle) = h / 1.5.
"""
import math
import random
import unittest
from fractions import Fraction

from check_trace import Checker
from trace_geometry import at_most, hull, less, turn
from trace_spoiling import GAP, Spoiling
from trace_turning import Leg, cosine_and_sine

CORNER = 1.5
RISE = 0.15  # of the square above the flat arm
MEETS = math.atan(RISE / CORNER)


def trace(ways):
    """`ways`: for each step the corners (height of the square's lower side, fraction), and the arm's two angles."""
    header = {
        "paperproof_trace": 1, "scene": "made", "contender": "box2d", "scalar": "float", "dt": 0.25,
        "points": [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]],
        "colliders": [{"id": "arm", "chain": [[0, 0], [2, 0]]}]}
    steps = [{
        "step": k, "path": [[1, height + 0.5, fraction] for height, fraction in corners], "requested": [0, 0],
        "velocity": [0, 0], "grounded": False, "start_overlap": [], "contacts": [],
        "movers": {"arm": [[0, 0, angle] for angle in angles]}} for k, (corners, angles) in enumerate(ways)]
    return header, steps


def staying(first, last, height=RISE):
    return trace([([(height, 0), (height, 1)], (first, last))])


class BesideWhatTurns(unittest.TestCase):
    def said(self, header, steps, too_close=0):
        checker = Checker(header)
        words = [words for _, words in checker.check(steps)]
        self.assertEqual(checker.too_close, too_close)
        return words

    def assert_passes(self, words, ends_inside):
        self.assertEqual(["passes or enters arm" in said for said in words], [True, False][:1 + ends_inside])
        self.assertEqual(words[1:], ["ends inside arm"] * ends_inside)

    def test_an_arm_that_comes_up_to_the_square_or_a_nanoradian_further(self):
        self.assertEqual(self.said(*staying(0, MEETS - 1e-9)), [])
        self.assert_passes(self.said(*staying(0, MEETS + 1e-9)), ends_inside=True)

    def test_an_arm_that_comes_down_from_above(self):
        # Onto the upper left corner at (0.5, 1.15), or beside it where the square is that much lower.
        meets = math.atan(1.15 / 0.5)
        self.assertEqual(self.said(*staying(1.5, meets + 1e-9)), [])
        self.assert_passes(self.said(*staying(1.5, meets - 1e-9)), ends_inside=True)

    def test_an_arm_that_sweeps_all_through_the_square(self):
        self.assert_passes(self.said(*staying(-1, 1.5)), ends_inside=False)
        self.assert_passes(self.said(*staying(1.5, -1)), ends_inside=False)

    def test_an_arm_that_goes_round_many_times_in_a_step(self):
        self.assert_passes(self.said(*staying(0, 4 * math.pi)), ends_inside=False)
        self.assertEqual(self.said(*staying(0, 4 * math.pi, height=2.01)), [], "the arm is 2 m long")

    def test_a_turn_and_back_between_two_steps_is_none(self):
        self.assertEqual(self.said(*staying(0.05, 0.05)), [])

    def test_a_square_that_rises_as_fast_as_the_arm(self):
        """At both ends a nanometre above it: in between the tangent sags below the straight way."""
        def height(angle):
            return CORNER * math.tan(angle) + 1e-9

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
        header, steps = staying(0, MEETS + 1e-3)
        steps[0]["movers"]["arm"][1][1] = -0.01
        self.assertEqual(self.said(header, steps), [], "the mover has gone down by more than the arm came up")
        steps[0]["movers"]["arm"][1][1] = 0.01
        self.assert_passes(self.said(header, steps), ends_inside=True)

    def test_a_square_deep_inside_a_solid_that_touches_it_nowhere(self):
        header, steps = staying(0, 1)
        header["colliders"] = [{"id": "arm", "polygon": [[-9, -9], [9, -9], [9, 9], [-9, 9]]}]
        self.assert_passes(self.said(header, steps), ends_inside=True)
        header["colliders"][0]["holes"] = [[[-5, -5], [5, -5], [5, 5], [-5, 5]]]
        self.assertEqual(self.said(header, steps), [])

    def test_an_overlap_at_the_start_that_is_told_or_is_none(self):
        header, steps = staying(MEETS + 0.01, MEETS + 0.02)
        steps[0]["start_overlap"] = ["arm"]
        self.assertEqual(self.said(header, steps), [])
        header, steps = staying(MEETS - 1e-9, MEETS - 0.01)
        steps[0]["start_overlap"] = ["arm"]
        self.assertEqual(self.said(header, steps), ["does not overlap arm at the start, as it says"])

    def test_a_touch_without_depth_is_too_close_to_tell(self):
        self.assertEqual(self.said(*staying(0, 0, height=0), too_close=1), [])


class Bounds(unittest.TestCase):
    def test_all_places_of_a_part_of_a_way_are_around_its_polygon(self):
        """Triangles at random, small and large, slow and fast: no side keeps a corner outside."""
        chance = random.Random(1)
        for _ in range(40):
            size, speed = 10 ** chance.uniform(-3, 1), 10 ** chance.uniform(-3, 1)
            body = hull([tuple(Fraction(chance.uniform(-size, size)) for _ in range(2)) for _ in range(3)])
            way = [tuple(Fraction(chance.uniform(-speed, speed)) for _ in range(2)) for _ in range(2)]
            leg = Leg(body, way, [Fraction(chance.uniform(-2, 2)) for _ in range(2)])
            first, last = sorted(Fraction(chance.random()) for _ in range(2))
            polygon, wider = leg.between(first, last)
            for share in (first + (last - first) * Fraction(k, 4) for k in range(5)):
                for corner in leg.corners(share):
                    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
                        self.assertGreaterEqual(turn(a, b, corner) + wider * at_most(less(b, a)), 0)

    def test_cosines_and_sines_of_any_angle_are_right_to_more_than_a_double(self):
        chance = random.Random(1)
        for angle in [0.0, math.pi, -math.pi / 2, 1e6] + [chance.uniform(-30, 30) for _ in range(100)]:
            c, s = cosine_and_sine(Fraction(angle))
            self.assertLessEqual(abs(c * c + s * s - 1), 1e-24)
            self.assertLessEqual(abs(float(c) - math.cos(angle)), 2.0 ** -52)
            self.assertLessEqual(abs(float(s) - math.sin(angle)), 2.0 ** -52)


class SpoiltTurning(Spoiling, unittest.TestCase):
    """Of a square that stays while the arm comes up to it and goes down again."""
    header, steps = trace([([(RISE, 0), (RISE, 1)], angles) for angles in ((0, MEETS - GAP), (MEETS - GAP, 0))])

    def test_an_arm_that_jumps(self):
        self.expect("has arm begin", lambda _, steps: steps[1]["movers"]["arm"][0].__setitem__(2, 0))

    def test_a_square_that_is_lower_than_it_was(self):
        def spoil(_, steps):
            for step in steps:
                for corner in step["path"]:
                    corner[1] -= 2 * GAP

        self.expect("passes or enters arm", spoil)
        self.expect("ends inside arm", spoil)

    def test_a_crush_excuses_the_arm(self):
        def spoil(_, steps):
            steps[0]["movers"]["arm"][1][2] = steps[1]["movers"]["arm"][0][2] = MEETS + GAP
            steps[0]["crush"] = ["arm"]
            steps[1]["start_overlap"] = ["arm"]

        self.assertEqual(self.found(spoil), [])


if __name__ == "__main__":
    unittest.main()
