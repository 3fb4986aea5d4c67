#!/usr/bin/env python3
"""Pictures of rows, for documents.

    plots.py ROWS... --out DIR [--keep FILE.json]

ROWS are files of rows (.json, .jsonl) that `paperproof` wrote, and figures that `benchmarks/table.py --json` wrote. Rows of
a sweep or a study give a picture for each question, with a heat map for each contender over the first two axes. Rows of
`work-precision` give one for each motion: error against run time. Rows of `study field` give one table; --keep writes of them
what it is drawn from. Figures give their ratios as bars.

Each picture is NAME.svg, which follows the reader's colours, light or dark, and NAME.png and NAME-dark.png. It takes Python's
matplotlib (Debian, Ubuntu: python3-matplotlib). The same rows give the same bytes with the same matplotlib."""
import argparse
import io
import json
import math
import re
import sys
from pathlib import Path

import matplotlib
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Outline

sys.dont_write_bytecode = True  # no cache among the sources
from benchmarks.table import table

LEAST_ERROR = 1e-9  # Drawn [m]: rounding has no order that a reader could use.
UNITS = {"_m_s2": "m/s²", "_m_s": "m/s", "_n_m": "N/m", "_hz": "Hz", "_deg": "degrees", "_kg": "kg", "_m": "m", "_s": "s"}

# Cells: light blue, orange, dark red differ in lightness, too. No colour stands twice in a theme: see `both_themes`.
LIGHT = {"page": "#ffffff", "text": "#1d2125", "quiet": "#d9dcdf", "none": "#a9d2ec", "some": "#f3c06b", "all": "#c2410c",
         "on_all": "#fffffe"}
DARK = {"page": "#15181b", "text": "#e3e6e8", "quiet": "#363d44", "none": "#24506f", "some": "#8f6a24", "all": "#d9603b",
        "on_all": "#16181a"}
# Of Okabe and Ito, who chose them for the colour-blind. The first, blue, is that of octagon_sweep alone. Five inks and eight marks for
# the others: no two of 40 curves look alike.
INKS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#8c7a3d")
MARKS = "os^DvP*h"
LAW, LAW_INK = "law of steps", "#858e97"  # has errors, and no cost; quiet on both pages


def content_of(path):
    """The rows of a file and no figures, or the reverse. Lines are read one after the other: a study has more of them than
    memory holds."""
    if str(path).endswith(".jsonl"):
        return lines_of(path), None
    content = json.loads(Path(path).read_text(encoding="utf-8"))
    return (content["rows"], None) if "paperproof_rows" in content else ([], content)


def lines_of(path):
    with open(path, encoding="utf-8") as file:
        next(file, None)  # the header
        yield from map(json.loads, file)


def who_ran(row, varied=()):
    """The contender with its knobs, but those that an axis shows, and its number type where it could be another."""
    knobs = [knob for knob in row.get("knob", "").split() if knob.split("=")[0] not in varied]
    is_float = row.get("scalar") == "float" and "engine" not in row and not row["contender"].startswith("box2d")
    return " ".join([row["contender"], *knobs]) + (" in float" if is_float else "")


def in_words(key):
    """A key of `parameters` as it stands at an axis: `speed_m_s` is "speed [m/s]"."""
    for ending, unit in UNITS.items():
        if key.endswith(ending):
            return f"{key.removesuffix(ending)} [{unit}]"
    return key


class Maps:
    """Counts the rows of one question: `cells[who][x, y]` is [bad cases, cases that ran]."""

    def __init__(self, row):
        swept = row["swept"]
        self.axes, self.bad = (swept["axes"] + [None])[:2], swept.get("bad")
        self.title = swept.get("question") or ("Where do bullets pass?" if self.bad == "tunnels" else
                                               f"Where does {row['scene']} hold?")
        self.bad_words = "get through" if self.bad == "tunnels" else "do not hold"
        self.cells = {}

    def add(self, row):
        """A row without these parameters is left out; what cannot run has a cell, and counts for nothing."""
        try:
            place = tuple(row["parameters"][axis] if axis else 0.0 for axis in self.axes)
        except KeyError:
            return
        cell = self.cells.setdefault(who_ran(row, self.axes), {}).setdefault(place, [0, 0])
        if row["verdict"] == "not_applicable":
            return
        cell[0] += row.get("tunnels", 0) > 0 if self.bad == "tunnels" else row["verdict"] != "holds"
        cell[1] += 1

    def shown(self):
        """The maps of those that ran somewhere."""
        return {who: cells for who, cells in self.cells.items() if any(ran for _, ran in cells.values())}


def state_of(cell):
    """Which of the four looks a cell has: "" where nothing ran, and none, some or all are bad."""
    bad, ran = cell
    return "" if ran == 0 else "none" if bad == 0 else "all" if bad == ran else "some"


def is_border(one, other):
    """Whether a border lies between two cells: both ran, and bad cases are on one side alone."""
    return one[1] > 0 and other[1] > 0 and (one[0] == 0) != (other[0] == 0)


def border_of(cells):
    """The border between none and some, as a line with gaps. Cells are numbered by column and row."""
    line = []
    for (i, j), cell in cells.items():
        for right, up in ((1, 0), (0, 1)):
            if is_border(cell, cells.get((i + right, j + up), (0, 0))):
                line += [(i + (right - up) / 2, j + (up - right) / 2), (i + 0.5, j + 0.5), (math.nan, math.nan)]
    return line


def number(value):
    return f"{value:.0f}" if 100 <= value < 1e6 else f"{value:.3g}"


def draw_map(axes, who, maps, xs, ys, theme):
    """One contender: a colour and a mark for each cell, and the border."""
    cells = {(xs.index(x), ys.index(y)): cell for (x, y), cell in maps.cells[who].items()}
    bad, ran = (sum(cell[k] for cell in cells.values()) for k in (0, 1))
    axes.set_title(f"{who}\n{bad} of {ran} cases {maps.bad_words}", fontsize=9, loc="left")
    for state, mark, ink in (("none", "", "text"), ("some", ".", "text"), ("all", "x", "on_all"), ("", "_", "text")):
        places = [place for place, cell in cells.items() if state_of(cell) == state]
        if not places:
            continue
        if state:
            # One outline for all cells keeps the file small.
            squares = [Outline([(x + a, y + b) for a, b in ((-.48, -.48), (.48, -.48), (.48, .48), (-.48, .48), (0, 0))],
                               closed=True) for x, y in places]
            axes.add_patch(PathPatch(Outline.make_compound_path(*squares), facecolor=theme[state], linewidth=0))
        if mark:
            axes.plot(*zip(*places), mark, color=theme[ink], markersize=5)
    axes.plot(*zip(*border_of(cells) or [(math.nan, math.nan)]), color=theme["text"], linewidth=2)
    stride = -(-max(len(number(x)) for x in xs) // 4)  # labels that would touch are left out
    axes.set(xlim=(-0.5, len(xs) - 0.5), ylim=(-0.5, len(ys) - 0.5), aspect="equal", xlabel=in_words(maps.axes[0]))
    axes.set_xticks(range(0, len(xs), stride), [number(x) for x in xs[::stride]])
    axes.set_yticks(range(len(ys)), [number(y) for y in ys] if maps.axes[1] else [""])
    axes.tick_params(left=False, bottom=False)
    axes.spines[:].set_visible(False)


def draw_maps(maps, theme):
    """The maps of one question side by side, up to the width of a page."""
    shown = maps.shown()
    places = [place for cells in shown.values() for place in cells]
    xs, ys = (sorted({place[k] for place in places}) for k in (0, 1))
    width = max(0.36 * len(xs), 0.075 * max(32, *map(len, shown))) + 0.8  # inches, as all sizes of figures
    columns = min(len(shown), max(1, int(10.6 / width)))
    lines = -(-len(shown) // columns)
    figure = Figure(figsize=(max(width * columns, 6.5), (0.36 * len(ys) + 1) * lines + 0.7), layout="constrained")
    figure.suptitle(maps.title, x=0.01, ha="left", weight="bold")
    all_axes = figure.subplots(lines, columns, squeeze=False).flat
    for axes, who in zip(all_axes, shown):
        draw_map(axes, who, maps, xs, ys, theme)
        axes.set_ylabel(in_words(maps.axes[1] or ""))
    for axes in list(all_axes)[len(shown):]:
        axes.set_axis_off()
    figure.supxlabel(f"no mark: none {maps.bad_words}; point: some; cross: all; dash: nothing ran; the line is the border",
                     x=0.01, ha="left", fontsize=9)
    return figure


def curves_of(rows):
    """Of one motion, by contender: the points of its curve over the length of a step, from coarse to fine, the rows
    that have no place, and the slope in words. Rows with a knob belong to curves over that knob, which a page shows."""
    curves = {}
    for row in rows:
        if row.get("curve", "dt_s") != "dt_s" or "knob" in row:
            continue
        curve = curves.setdefault(who_ran(row), {"points": [], "without": [], "slope": None})
        if "curve" in row:
            if "slope" in row:
                curve["slope"] = f"{round(row['slope'], 2) + 0:.2f} \u00b1 {row['slope_within']:.2f}"
        elif row.get("error_max_m") is None or (row.get("ns_per_step") is None and row["contender"] != LAW):
            curve["without"].append(row)
        else:
            curve["points"].append(row)
    return curves


def falls_short(row, axis):
    """Whether its reason names a fault on an axis: `safety: …; validity: …`."""
    return any(fault.startswith(f"{axis}: ") for fault in row.get("reason", "").split("; "))


def draw_curve(axes, points, ink, mark, theme):
    """The least of the measured times, with a bar to the largest; of an engine by itself the least alone. Points on the front
    are larger. A point whose run goes beyond what the contender documents is hollow, one that passes something or ends inside
    is struck out: neither counts for the front and the slope."""
    dts = [row["parameters"]["dt_s"] for row in points]
    least = [row.get("ns_per_step_bare", row["ns_per_step"]) for row in points]
    most = [time if "ns_per_step_bare" in row else row.get("ns_per_step_max", time) for row, time in zip(points, least)]
    times = [time / dt for time, dt in zip(least, dts)]  # ns per second of motion
    spread = [(high - low) / dt for high, low, dt in zip(most, least, dts)]
    errors = [max(row["error_max_m"], LEAST_ERROR) for row in points]
    axes.errorbar(times, errors, xerr=[[0] * len(times), spread], fmt="none", ecolor=ink, elinewidth=0.8)
    line, = axes.plot(times, errors, mark + "-", color=ink, markersize=4)
    for chosen, how in ((lambda row: row.get("on_front"), {"marker": mark, "color": ink, "markersize": 8}),
                        (lambda row: falls_short(row, "validity"), {"marker": mark, "color": ink, "markersize": 6, "fillstyle": "none"}),
                        (lambda row: falls_short(row, "safety"), {"marker": "x", "color": theme["text"], "markersize": 10})):
        places = [(time, error) for time, error, row in zip(times, errors, points) if chosen(row)]
        if places:
            axes.plot(*zip(*places), linestyle="none", **how)
    return line


def draw_curves(scene, rows, theme):
    """Error against run time. Who has no place at all stands struck out below the others. What steps alone make has no cost:
    a line across for each length of a step."""
    figure = Figure(figsize=(9, 5), layout="constrained")
    axes = figure.subplots()
    axes.set_title(f"{scene}: the error from continuous motion, against run time", loc="left", weight="bold", fontsize=11)
    axes.set(xscale="log", yscale="log", xlabel="run time [ns per second of motion], the least of nine; bars to the largest",
             ylabel="largest error [m]")
    axes.minorticks_off()
    axes.xaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_major_formatter("{x:g}")
    axes.grid(color=theme["quiet"], linewidth=0.6)
    entries = []
    for i, (who, curve) in enumerate(curves_of(rows).items()):
        label = who if curve["slope"] is None else f"{who}, slope {curve['slope']}"
        if who == LAW:
            lines = [axes.axhline(max(row["error_max_m"], LEAST_ERROR), color=LAW_INK, linewidth=0.8, linestyle="--", zorder=1)
                     for row in curve["points"]]
            entries.append((lines[0], label))
        elif curve["points"]:
            ours = who.startswith("octagon_sweep")
            ink = INKS[0] if ours else INKS[1 + i % (len(INKS) - 1)]
            line = draw_curve(axes, curve["points"], ink, MARKS[i % len(MARKS)], theme)
            line.set(linewidth=2.4 if ours else 1.2, zorder=3 if ours else 2)
            line.set_gid(f"curve-{i}")
            entries.append((line, label))
        if curve["without"]:
            struck, = axes.plot([], [], "x", color=theme["text"], markersize=8)
            failed = sum(row["verdict"] == "failed" for row in curve["without"])
            entries.append((struck, f"{who}: {f'{failed} failed' if failed else 'cannot run'}"))
    axes.legend(*zip(*entries), loc="upper left", bbox_to_anchor=(1.01, 1), frameon=False, fontsize=9)
    return figure


FIELD, FIELD_KEYS = "field: ", ("contender", "knob", "scalar", "engine", "verdict", "worst", "badness")


def field_row(row):
    """Of a row of `study field` what a table needs."""
    return {**{key: row[key] for key in FIELD_KEYS if key in row}, "swept": {"question": row["swept"]["question"]}}


def field_cells(rows):
    """By contender and group: the worst row, how many runs do anything wrong, and how many ran."""
    cells = {}
    for row in rows:
        cell = cells.setdefault((who_ran(row), row["swept"]["question"].removeprefix(FIELD)), [None, 0, 0])
        if "badness" in row:
            cell[1] += row["badness"] > 0
            cell[2] += 1
            if cell[0] is None or row["badness"] > cell[0]["badness"]:
                cell[0] = row
    return cells


def draw_field(rows, theme):
    """Contenders by kinds of trouble: the worst that each does, and in how many runs it does anything wrong."""
    cells = field_cells(rows)
    names, groups = (list(dict.fromkeys(place[k] for place in cells)) for k in (0, 1))
    figure = Figure(figsize=(1.12 * len(groups) + 1.3, 0.36 * len(names) + 1.2), layout="constrained")
    figure.suptitle("Movers of many engines before one exact judge: the worst that each does", x=0.01, ha="left", weight="bold")
    axes = figure.subplots()
    for (who, group), (worst, bad, ran) in cells.items():
        x, y = groups.index(group), names.index(who)
        state = "" if worst is None else "none" if worst["badness"] == 0 else "some" if worst["badness"] < 1 else "all"
        if state:
            axes.add_patch(PathPatch(Outline([(x - .49, y - .47), (x + .49, y - .47), (x + .49, y + .47), (x - .49, y + .47), (0, 0)],
                                             closed=True), facecolor=theme[state], linewidth=0))
        words = "cannot run" if worst is None else worst["worst"] + (f"\n{bad} of {ran} runs" if bad else "")
        axes.text(x, y, words, ha="center", va="center", fontsize=7, color=theme["on_all" if state == "all" else "text"])
    axes.set(xlim=(-0.5, len(groups) - 0.5), ylim=(len(names) - 0.5, -0.5))
    axes.set_xticks(range(len(groups)), groups)
    axes.set_yticks(range(len(names)), names)
    axes.tick_params(left=False, bottom=False, top=False, labeltop=True, labelbottom=False)
    axes.spines[:].set_visible(False)
    figure.supxlabel("red: passes a solid, ends inside one by more than its skin, or hangs in the air; orange: anything else",
                     x=0.01, ha="left", fontsize=9)
    return figure


def draw_ratios(figures, theme):
    """How many times Box2D's figure is the controller's, as bars along a logarithmic axis; to the left where Box2D's is the
    smaller one."""
    rows = table(figures)[::-1]
    ratios = [theirs / ours for _, ours, theirs, _ in rows]
    figure = Figure(figsize=(9, 0.3 * len(rows) + 1.3), layout="constrained")
    figure.suptitle("How many times faster or smaller than Box2D 2.4.1", x=0.01, ha="left", weight="bold")
    axes = figure.subplots()
    axes.set_title("one process, the same level, 60 Hz; paperproof, Box2D beside each bar", loc="left", fontsize=9)
    axes.barh([words for words, *_ in rows], [ratio - 1 for ratio in ratios], left=1, height=0.6,
              color=[INKS[0] if ratio >= 1 else INKS[1] for ratio in ratios])
    for i, ((_, ours, theirs, unit), ratio) in enumerate(zip(rows, ratios)):
        words = f"{ratio:.1f} × ({ours:,.0f} {unit}, {theirs:,.0f} {unit})"
        axes.annotate(words, (max(1, ratio), i), (5, 0), textcoords="offset points", va="center", annotation_clip=False)
    axes.set_xscale("log")
    axes.set_xlim(min(1, *ratios) * 0.9, max(1, *ratios) * 1.1)
    ticks = [tick for tick in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100) if axes.get_xlim()[0] < tick < axes.get_xlim()[1]]
    axes.set_xticks(ticks, map(str, ticks))
    axes.minorticks_off()
    axes.grid(axis="x", color=theme["quiet"], linewidth=0.6)
    axes.set_axisbelow(True)
    axes.axvline(1, color=theme["text"], linewidth=1.5)
    axes.tick_params(left=False, bottom=False)
    axes.spines[:].set_visible(False)
    return figure


def pictures_of(paths, keep=None):
    """Pairs of the title and a function that draws the picture in a theme. KEEP gets what the field's picture needs of its rows."""
    questions, motions, figures, field = {}, {}, [], []
    for path in paths:
        rows, own_figures = content_of(path)
        if own_figures:
            figures.append(own_figures)
        for row in rows:
            swept = row.get("swept")
            if row.get("mode") == "work_precision":
                motions.setdefault(row["scene"], []).append(row)
            elif swept and swept["question"].startswith(FIELD):
                field.append(field_row(row))
            elif swept and swept["axes"] and "border" not in row:
                key = (swept.get("question"), row["scene"], *swept["axes"])
                if key not in questions:
                    questions[key] = Maps(row)
                questions[key].add(row)
    for maps in questions.values():
        if maps.shown():
            yield maps.title, lambda theme, maps=maps: draw_maps(maps, theme)
    for scene, rows in motions.items():
        yield scene, lambda theme, scene=scene, rows=rows: draw_curves(scene, rows, theme)
    if keep:
        Path(keep).write_text('{"paperproof_rows": 1, "rows": [\n' + ",\n".join(map(json.dumps, field)) + "\n]}\n", encoding="utf-8")
    if field:
        yield "field", lambda theme: draw_field(field, theme)
    for one in figures:
        yield "table", lambda theme, one=one: draw_ratios(one, theme)


def settings(theme):
    """Words stay words in SVG, and nothing in a file tells when it was written."""
    ink = {key: theme["text"] for key in ("text.color", "axes.edgecolor", "axes.labelcolor", "xtick.color", "ytick.color")}
    return {**ink, "figure.facecolor": theme["page"], "axes.facecolor": theme["page"], "font.sans-serif": ["DejaVu Sans"],
            "font.size": 9, "figure.titlesize": 11, "svg.fonttype": "none", "svg.hashsalt": "paperproof", "savefig.dpi": 150}


def file_name(title, taken):
    """Letters and digits of a title, with one dash for what is between them, and a number where another has this name."""
    words = re.sub("[^A-Za-z0-9_.]+", "-", title).strip("-") or "picture"
    taken.append(words)
    return words if taken.count(words) == 1 else f"{words}-{taken.count(words)}"


def both_themes(svg):
    """A light SVG, dark for those whose page is."""
    rules = "".join(f'[style*="{what}: {colour}"] {{ {what}: {DARK[name]} !important }}\n'
                    for name, colour in LIGHT.items() for what in ("fill", "stroke"))
    return svg.replace("</style>", f"\n@media (prefers-color-scheme: dark) {{\n{rules}}}</style>", 1)


def write(title, draw, stem):
    """One picture in three files. Returns their names."""
    files = [f"{stem}{ending}" for ending in (".svg", ".png", "-dark.png")]
    for theme, png in zip((LIGHT, DARK), files[1:]):
        with matplotlib.rc_context(settings(theme)):
            figure = draw(theme)
            figure.savefig(png, metadata={"Title": title, "Software": None})
            if theme is LIGHT:
                svg = io.StringIO()
                figure.savefig(svg, format="svg", metadata={"Title": title, "Date": None})
                Path(files[0]).write_text(both_themes(svg.getvalue()), encoding="utf-8")
    return files


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rows", nargs="+", metavar="ROWS")
    parser.add_argument("--out", required=True, metavar="DIR")
    parser.add_argument("--keep", metavar="FILE.json")
    options = parser.parse_args()
    try:
        Path(options.out).mkdir(parents=True, exist_ok=True)
        pictures = list(pictures_of(options.rows, options.keep))
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"plots.py: expected files of rows and a folder: {error!r}")
    if not pictures:
        sys.exit("plots.py: expected rows of a sweep, a study or work-precision: others give no picture")
    taken = []
    for title, draw in pictures:
        print(*write(title, draw, Path(options.out) / file_name(title, taken)), sep="\n")


if __name__ == "__main__":
    main()
