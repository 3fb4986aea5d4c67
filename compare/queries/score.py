#!/usr/bin/env python3
"""Scores answers to questions of first contact. It needs Python alone.

usage: score.py QUERIES.jsonl ANSWERS.jsonl

An answer is a line {"id": 0, "contact": 0.53, "ns": 120}: the fraction of the way, null where the way is free; ns may be
left out. The status is 1 where a contact was missed or comes late: then something passes.
"""
import json
import sys
from collections import defaultdict
from fractions import Fraction
from math import hypot

ALLOWED = 1e-6  # an answer may be so far off, along the way [m]


class Score:
    def __init__(self):
        self.asked = self.missed = self.late = self.invented = self.early = self.unanswered = 0
        self.error = 0.0
        self.times = []

    def add(self, query, answer):
        self.asked += 1
        if answer is None:
            self.unanswered += 1
            return
        self.times += [answer["ns"]] if "ns" in answer else []
        exact, said = query["contact"], answer["contact"]
        if exact is None:
            self.invented += said is not None
        elif said is None:
            self.missed += 1
        else:
            off = float(Fraction(said) - Fraction(exact)) * hypot(*query["displacement"])
            self.late += off > ALLOWED
            self.early += off < -ALLOWED
            self.error = max(self.error, abs(off))

    def cells(self):
        ns = f"{sum(self.times) / len(self.times):.0f}" if self.times else "-"
        return [self.asked, self.missed, self.late, self.invented, self.early, self.unanswered, f"{self.error:.2g}", ns]


def main():
    with open(sys.argv[2], encoding="utf-8") as file:
        answers = {answer["id"]: answer for answer in map(json.loads, file)}
    scores = defaultdict(Score)
    with open(sys.argv[1], encoding="utf-8") as file:
        for query in map(json.loads, file):
            kind = "degenerate" if query["degenerate"] else query["source"].split("/")[0]
            scores[kind].add(query, answers.get(query["id"]))
            if not query["degenerate"]:
                scores["all but degenerate"].add(query, answers.get(query["id"]))
    heading = ["questions", "asked", "missed", "late", "invented", "early", "unanswered", "error, m", "ns"]
    rows = [heading] + [[kind, *score.cells()] for kind, score in sorted(scores.items())]
    widths = [max(len(str(row[i])) for row in rows) for i in range(len(heading))]
    for row in rows:
        print("  ".join(str(cell).ljust(widths[0]) if i == 0 else str(cell).rjust(widths[i]) for i, cell in enumerate(row)))
    judged = scores["all but degenerate"]
    return judged.missed + judged.late + judged.unanswered > 0


if __name__ == "__main__":
    sys.exit(main())
