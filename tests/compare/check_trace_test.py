#!/usr/bin/env python3
"""That check_trace.py finds what is wrong: a good trace of octagon_sweep through article_bullet, spoilt in one way each.

    check_trace_test.py TRACE.jsonl
"""
import copy
import json
import sys
import unittest

from check_trace import Checker

with open(sys.argv.pop(), encoding="utf-8") as file:
    HEADER, *STEPS = map(json.loads, file)


class SpoiltTraces(unittest.TestCase):
    def found(self, spoil):
        """What is said about the trace after `spoil` has changed header and steps."""
        header, steps = copy.deepcopy(HEADER), copy.deepcopy(STEPS[:3])
        spoil(header, steps)
        return [words for _, words in Checker(header).check(steps)]

    def expect(self, words, spoil):
        found = self.found(spoil)
        self.assertTrue(any(words in said for said in found), f"{words!r} is not in {found}")

    def test_the_good_trace_has_nothing(self):
        self.assertEqual(self.found(lambda header, steps: None), [])
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

    def test_a_contact_point_off_the_platform(self):
        self.expect("is not on platform", lambda _, steps: steps[0]["contacts"][0].update(point=[0, 1e-6]))


if __name__ == "__main__":
    unittest.main()
