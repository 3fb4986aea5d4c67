"""For tests of check_trace.py: a good trace, spoilt in one way each."""
import copy

from check_trace import Checker

GAP = 2.0 ** -21  # at a contact of the traces that are made [m]


class Spoiling:
    """With `header` and `steps`, a trace that is good."""

    def found(self, spoil):
        """What is said about the trace after `spoil` has changed header and steps."""
        header, steps = copy.deepcopy(self.header), copy.deepcopy(self.steps)
        spoil(header, steps)
        return [words for _, words in Checker(header).check(steps)]

    def expect(self, words, spoil):
        found = self.found(spoil)
        self.assertTrue(any(words in said for said in found), f"{words!r} is not in {found}")

    def test_the_good_trace_has_nothing(self):
        self.assertEqual(self.found(lambda header, steps: None), [])
