#!/usr/bin/env python3
"""What compare/plots.py counts and draws, on a few rows.

usage: plots_test.py REPOSITORY    (exit status 77: skipped, with the reason)
"""
import importlib.util
import json
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

if not importlib.util.find_spec("matplotlib"):
    print("skipped: there is no matplotlib here (Debian, Ubuntu: python3-matplotlib)")
    sys.exit(77)
REPOSITORY = Path(sys.argv.pop(1))
sys.path.insert(0, str(REPOSITORY / "compare"))
import plots

HEADER = {"paperproof_rows": 1}


def shot(contender, speed, thickness, tunnels=0, **more):
    return {"scene": "paper", "contender": contender, "scalar": "double", "verdict": "tunnels" if tunnels else "holds",
            "swept": {"question": "", "axes": ["speed_m_s", "thickness_m", "phase"], "bad": "tunnels"},
            "parameters": {"speed_m_s": speed, "thickness_m": thickness}, "tunnels": tunnels, **more}


def precise(contender, dt, error, ns, **more):
    return {"scene": "rest", "contender": contender, "scalar": "double", "mode": "work_precision", "verdict": "holds",
            "parameters": {"dt_s": dt}, "error_max_m": error, "ns_per_step": ns, "ns_per_step_max": ns and 2 * ns, **more}


def failed(contender, dt):
    return {"scene": "rest", "contender": contender, "mode": "work_precision", "verdict": "failed", "parameters": {"dt_s": dt}}


class Maps(unittest.TestCase):
    def maps_of(self, rows):
        maps = plots.Maps(rows[0])
        for row in rows:
            maps.add(row)
        return maps

    def test_a_cell_counts_the_cases_with_its_two_values_and_those_that_are_bad(self):
        maps = self.maps_of([shot("mask", 10, 0.1), shot("mask", 10, 0.1, tunnels=2), shot("mask", 20, 0.1, tunnels=1),
                             shot("mask", 20, 0.1, verdict="not_applicable"), shot("mask", 20, 0.01, verdict="flagged"),
                             shot("mask", 30, 0.1, parameters={"speed_m_s": 30})])
        self.assertEqual(maps.cells, {"mask": {(10, 0.1): [1, 2], (20, 0.1): [1, 1], (20, 0.01): [0, 1]}})
        self.assertEqual([plots.state_of(cell) for cell in ((0, 0), (0, 2), (1, 2), (2, 2))], ["", "none", "some", "all"])

    def test_by_verdict_whatever_does_not_hold_is_bad(self):
        rows = [shot("mask", 10, 0.1, verdict=verdict) for verdict in ("holds", "flagged", "failed", "not_applicable")]
        rows[0]["swept"]["bad"] = "does_not_hold"
        maps = self.maps_of(rows)
        self.assertEqual(maps.cells["mask"], {(10, 0.1): [2, 3]})
        self.assertEqual(maps.title, "Where does paper hold?")

    def test_contenders_differ_by_knobs_and_number_type_but_not_by_what_an_axis_shows(self):
        maps = self.maps_of([shot("mask", 10, 0.1), shot("mask", 10, 0.1, knob="unit=1 speed_m_s=10"),
                             shot("mask", 10, 0.1, scalar="float"), shot("box2d", 10, 0.1, scalar="float"),
                             shot("grid", 10, 0.1, verdict="not_applicable")])
        self.assertEqual(list(maps.shown()), ["mask", "mask unit=1", "mask in float", "box2d"], "grid ran nowhere")

    def test_the_border_lies_between_none_and_some_that_ran(self):
        border = plots.border_of({(0, 0): (0, 2), (1, 0): (1, 2), (2, 0): (2, 2), (0, 1): (0, 0), (1, 1): (0, 1)})
        self.assertEqual(border[0:2] + border[3:5], [(0.5, -0.5), (0.5, 0.5), (0.5, 0.5), (1.5, 0.5)])
        self.assertEqual(len(border), 6)


class Curves(unittest.TestCase):
    def figure(self, rows):
        with plots.matplotlib.rc_context(plots.settings(plots.LIGHT)):
            return plots.draw_curves("rest", rows, plots.LIGHT).axes[0]

    def test_a_point_is_time_for_a_second_of_motion_against_error_and_its_bar_goes_to_the_largest_time(self):
        axes = self.figure([precise("mask", 0.1, 0.01, 50), precise("mask", 0.05, 0, 50),
                            precise("mask", 0.1, 1, 1, knob="unit=1"),
                            {"contender": "mask", "mode": "work_precision", "verdict": "holds", "curve": "dt_s", "slope": -0.004, "slope_within": 0.02}])
        line, = [line for line in axes.lines if line.get_gid()]
        self.assertEqual(line.get_xydata().tolist(), [[500, 0.01], [1000, plots.LEAST_ERROR]])
        bars, = axes.collections
        self.assertEqual([bar.tolist() for bar in bars.get_segments()], [[[500, 0.01], [1000, 0.01]], [[1000, 1e-9], [2000, 1e-9]]])
        self.assertEqual([text.get_text() for text in axes.get_legend().get_texts()], ["mask, slope 0.00 \u00b1 0.02"])

    def test_what_failed_is_struck_out_at_its_place_or_else_in_the_legend_and_what_goes_beyond_a_limit_is_hollow(self):
        axes = self.figure([precise("mask", 0.1, 0.01, 50), precise("mask", 0.05, 0.5, 50, reason="safety: step 1: passed it"),
                            precise("mask", 0.01, 0.2, 60, ns_per_step_bare=40, reason="progress: hangs; validity: too fast"),
                            failed("mask", 0.01), failed("grid", 0.1), failed("grid", 0.01), precise(plots.LAW, 0.1, 0.3, None)])
        hollow = [line.get_xydata().tolist() for line in axes.lines if line.get_fillstyle() == "none"]
        self.assertEqual(hollow, [[[4000, 0.2]]])
        crosses = [line.get_xydata().tolist() for line in axes.lines if line.get_marker() == "x" and len(line.get_xdata())]
        self.assertEqual(crosses, [[[1000, 0.5]]])
        self.assertEqual([text.get_text() for text in axes.get_legend().get_texts()],
                         ["mask", "mask: 1 failed", "grid: 2 failed", plots.LAW], "what has no cost is a line across")


class Field(unittest.TestCase):
    @staticmethod
    def run_of(contender, group, worst, badness, **more):
        return {"contender": contender, "verdict": "holds", "worst": worst, "badness": badness,
                "swept": {"question": f"field: {group}", "axes": ["speed_m_s"], "bad": "does_not_hold"}, **more}

    def test_a_cell_has_the_worst_and_counts_the_runs_that_do_anything_wrong(self):
        refused = {**self.run_of("rapier", "play", "", 0), "verdict": "not_applicable"}
        del refused["worst"], refused["badness"]
        rows = [self.run_of("octagon_sweep", "seams", "holds", 0), self.run_of("rapier", "seams", "loses 12 %", 0.21, scalar="float", engine="R 1"),
                self.run_of("rapier", "seams", "inside 3 mm", 2.01, engine="R 1"), self.run_of("rapier", "seams", "holds", 0, engine="R 1"), refused]
        with plots.matplotlib.rc_context(plots.settings(plots.LIGHT)):
            axes = plots.draw_field(rows, plots.LIGHT).axes[0]
        self.assertEqual([text.get_text() for text in axes.texts], ["holds", "inside 3 mm\n2 of 3 runs", "cannot run"])
        self.assertEqual([plots.matplotlib.colors.to_hex(patch.get_facecolor()) for patch in axes.patches], [plots.LIGHT["none"], plots.LIGHT["all"]])
        self.assertEqual([text.get_text() for text in axes.get_yticklabels()], ["octagon_sweep", "rapier"], "a peer in float is no other one")


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def plots(self, *arguments):
        return subprocess.run([sys.executable, REPOSITORY / "compare/plots.py", *arguments], cwd=self.folder, text=True,
                              capture_output=True)

    def test_each_picture_is_an_svg_for_both_themes_and_two_pngs_and_always_the_same(self):
        border = shot("mask", 5, 0.1, border="speed")
        sweep = [HEADER, shot("mask", 10, 0.1), shot("mask", 20, 0.1, tunnels=1), border, {"scene": "paper", "contender": "mask"}]
        (self.folder / "sweep.jsonl").write_text("".join(json.dumps(row) + "\n" for row in sweep))
        other = shot("mask", 10, 0.1)
        other["swept"]["axes"] = ["speed_m_s"]
        (self.folder / "rows.json").write_text(json.dumps({**HEADER, "rows": [other, precise("mask", 0.1, 0.1, 1)]}))
        inputs = ("sweep.jsonl", "rows.json", REPOSITORY / "compare/benchmarks/table.json")
        self.assertEqual(self.plots(*inputs, "--out", "one").returncode, 0)
        self.assertEqual(self.plots("sweep.jsonl", "--out", "two").returncode, 0)
        names = [f"{name}{end}" for name in ("Where-do-bullets-pass", "Where-do-bullets-pass-2", "rest", "table")
                 for end in (".svg", ".png", "-dark.png")]
        self.assertEqual(sorted(file.name for file in (self.folder / "one").iterdir()), sorted(names))
        for name in names[:3]:
            self.assertEqual((self.folder / "one" / name).read_bytes(), (self.folder / "two" / name).read_bytes(), name)
        picture = self.folder / "one/Where-do-bullets-pass.svg"
        self.assertEqual(xml.parse(picture).getroot().find("{*}title").text, "Where do bullets pass?")
        self.assertIn("1 of 2 cases get through", picture.read_text())
        self.assertIn(f"fill: {plots.DARK['all']} !important", picture.read_text())

    def test_what_gives_no_picture_is_said(self):
        (self.folder / "none.json").write_text(json.dumps({**HEADER, "rows": [{"scene": "paper", "contender": "mask"}]}))
        (self.folder / "bad.json").write_text("{")
        for name, says in (("none.json", "others give no picture"), ("bad.json", "expected files"), ("no.jsonl", "expected files")):
            told = self.plots(name, "--out", "out")
            self.assertEqual((told.returncode, told.stderr.count("\n")), (1, 1), told.stderr)
            self.assertIn(says, told.stderr)


if __name__ == "__main__":
    unittest.main()
