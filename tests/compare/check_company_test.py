#!/usr/bin/env python3
"""That check_trace.py finds what is wrong between several characters: a good trace that is made here, spoilt in one way
each.
"""
import unittest

from trace_spoiling import GAP, Spoiling


def company_trace():
    """Two squares of 1 m, 1 m apart, each want to go 1 m to the other: they meet after half a step, and stand."""
    header = {
        "paperproof_trace": 1, "scene": "made", "contender": "octagon_sweep", "scalar": "double", "dt": 0.25,
        "characters": 2, "points": [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]],
        "colliders": [{"id": "far", "polygon": [[-9, -9], [9, -9], [9, -8]]}]}
    steps = []
    for character, (start, way) in enumerate(((0, 1), (2, -1))):
        stop, when = start + way * (0.5 - GAP / 2), 0.5 - GAP / 2
        common = {"character": character, "grounded": False, "start_overlap": [], "movers": {}, "contacts": []}
        steps.append({**common, "step": 0, "path": [[start, 0, 0], [stop, 0, when], [stop, 0, 1]], "requested": [way, 0],
                      "velocity": [0, 0],
                      "met": [{"character": 1 - character, "normal": [-way, 0], "fraction": 0.5, "side": "right"}]})
        steps.append({**common, "step": 1, "path": [[stop, 0, 0], [stop, 0, 1]], "requested": [0, 0],
                      "velocity": [0, 0]})
    return header, sorted(steps, key=lambda step: step["step"])


class SpoiltCompany(Spoiling, unittest.TestCase):
    header, steps = company_trace()

    def test_one_that_passes_the_other(self):
        def spoil(_, steps):
            steps[0]["path"] = [[0, 0, 0], [3, 0, 1]]
            steps[2:] = []

        self.expect("character 0 and character 1 come to overlap or pass", spoil)

    def test_one_that_ends_inside_the_other(self):
        def spoil(_, steps):
            steps[0]["path"][1:] = [[0.5 + GAP, 0, 1]]
            steps[2:] = []

        self.expect("come to overlap", spoil)

    def test_ways_that_cross_are_free_as_long_as_nobody_is_there_at_that_time(self):
        def spoil(leaves, arrives):
            def change(header, steps):
                header["contender"] = "discrete"
                steps[0]["path"] = [[0, 0, 0], [0, 2, 0.25], [0, 2, 0.75], [0, 0, 1]]
                steps[1]["path"] = [[2, 0, 0], [2, 0, leaves], [-2, 0, arrives], [-2, 0, 1]]
                steps[2:] = []

            return change

        self.assertEqual(self.found(spoil(0.25, 0.75)), [])
        self.expect("come to overlap", spoil(0.75, 1))

    def test_a_jump_through_the_other_in_no_time(self):
        def spoil(_, steps):
            steps[0]["path"] = [[0, 0, 0], [0, 0, 0.25], [4, 0, 0.25], [4, 0, 1]]
            steps[2:] = []

        self.expect("come to overlap", spoil)

    def test_of_samples_only_the_ends_count(self):
        def spoil(header, steps):
            header["contender"] = "box2d"
            steps[0]["path"] = [[0, 0, 0], [0.75, 0, 0.75], [0, 0, 1]]
            for step in steps:
                step["path_exact"] = False
            steps[2:] = []

        self.assertEqual(self.found(spoil), [])

    def test_a_meeting_that_only_one_tells_or_tells_otherwise(self):
        self.expect("do not say the same", lambda _, steps: steps[0].pop("met"))
        self.expect("do not say the same", lambda _, steps: steps[1]["met"][0].update(fraction=0.25))

    def test_a_meeting_at_another_time(self):
        for fraction, words in ((0.5 + 1e-6, "earlier"), (0.5 - 1e-6, "does not meet"), (0.5 + 4e-7, None)):
            def spoil(_, steps):
                for step in steps[:2]:
                    step["met"][0]["fraction"] = fraction

            if words:
                self.expect(words, spoil)
            else:
                self.assertEqual(self.found(spoil), [])

    def hit_where_it_stands(self, *, post=False, requested=1, **said):
        """Character 0 does not move, and the other comes 1 m in half of the step."""
        def spoil(header, steps):
            if post:
                beside = -0.5 - 2 * GAP
                header["colliders"].append(
                    {"id": "post", "polygon": [[-2, -0.1], [beside, -0.1], [beside, 0.1], [-2, 0.1]]})
            steps[0].update(path=[[0, 0, 0], [0, 0, 1]], requested=[requested, 0], **said)
            steps[1].update(path=[[2, 0, 0], [1 + GAP, 0, 0.5 - GAP / 2], [1 + GAP, 0, 1]], requested=[-2, 0])
            steps[2:] = []

        return spoil

    def test_who_is_stuck_does_not_come_as_requested(self):
        self.expect("earlier", self.hit_where_it_stands())
        self.assertEqual(self.found(self.hit_where_it_stands(stuck=True)), [])

    def test_who_is_held_by_what_is_a_micrometre_away_does_not_go_as_requested(self):
        self.expect("does not meet", self.hit_where_it_stands(requested=-1))
        self.assertEqual(self.found(self.hit_where_it_stands(requested=-1, post=True)), [])

    def test_what_a_meeting_turns_it_into_at_once_is_no_impact_of_the_requested_motion(self):
        def contact_at(fraction):
            def spoil(header, steps):
                top, at = -0.5 - GAP, 0 if fraction == 0 else 0.5
                header["colliders"] = [{"id": "floor", "polygon": [[-9, -9], [9, -9], [9, top], [-9, top]]}]
                steps[0]["contacts"] = [{"collider": "floor", "point": [at, top], "normal": [0, 1],
                                         "fraction": fraction, "separation": GAP, "side": "bottom"}]

            return spoil

        self.assertEqual(self.found(contact_at(0.5 - GAP / 4)), [])
        self.expect("that it does not move towards", contact_at(0))

    def test_a_meeting_from_afar(self):
        def spoil(_, steps):
            steps[0]["path"] = [[0, 0, 0], [0.25, 0, 0.25], [0.25, 0, 1]]
            steps[2:] = []

        self.expect("at no corner are within 1e-6 m", spoil)

    def test_records_that_are_missing_or_out_of_order(self):
        self.expect("where that of 0 belongs", lambda _, steps: steps.pop(0))
        self.expect("where that of 0 belongs", lambda _, steps: steps.reverse())

    def test_an_overlap_at_the_start_that_is_not_told_or_is_none(self):
        def put(_, steps):
            steps[2].update(path=[[1, 0, 0], [1, 0, 1]], respawn=True)

        self.expect("says False of an overlap at the start that is True", put)
        self.expect("says True of an overlap at the start that is False",
                    lambda _, steps: steps[3].update(start_overlap_characters=[0]))

        def told(_, steps):
            put(_, steps)
            for step in steps[2:]:
                step["start_overlap_characters"] = [1 - step["character"]]

        self.assertEqual(self.found(told), [])


if __name__ == "__main__":
    unittest.main()
