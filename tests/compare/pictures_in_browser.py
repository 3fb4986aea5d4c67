#!/usr/bin/env python3
"""Opens pages in a headless Chromium: pictures show what the rows say, and replays what happened, whoever looks and how.

usage: pictures_in_browser.py COMMAND FOLDER_TO_WORK_IN    (exit status 77: skipped, with the reason)
"""
import json
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path
from urllib.parse import quote

from judging import CHECKER, call, read, write

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
CONTENDERS = "mask,penetration_resolution,octagon_sweep"

COMPLAINTS = ("Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Log.entryAdded")

# Runs in the page once it is loaded; `seen` is what it saw last.
PROBE = """
const seen = {};
const text = (selector) => [...document.querySelectorAll(selector)].map((one) => one.textContent);
function pixels(canvas, columns, rows) {
  const image = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height), ratio = canvas.width / canvas.clientWidth, width = (canvas.clientWidth - 58) / columns;
  const at = (x, y) => {
    const from = 4 * (Math.round(y * ratio) * canvas.width + Math.round(x * ratio));
    return [...image.data.slice(from, from + 4)].join();
  };
  return Array.from({length: rows}, (_, row) =>
    Array.from({length: columns}, (_, column) => at(54 + (column + 0.5) * width, 4 + (rows - 1 - row) * 24 + 4)));
}
function look() {
  seen.error = document.documentElement.dataset.error || '';
  seen.drawn = document.documentElement.dataset.drawn;
  seen.strip = document.documentElement.dataset.strip;
  seen.overflow = document.documentElement.scrollWidth - document.documentElement.clientWidth;
  seen.background = getComputedStyle(document.body).backgroundColor;
  seen.ink = getComputedStyle(document.body).color;
  seen.above = [...document.querySelectorAll('.strip, .costs, .chart canvas')].map((one) => one.getBoundingClientRect().top);
  seen.height = innerHeight;
  seen.tiles = text('.tile');
  seen.points = [...document.querySelectorAll('.chart canvas')].map((one) => one.dataset.points);
  seen.numbers = document.querySelectorAll('.picture tbody tr').length;
  seen.maps = [...document.querySelectorAll('.map')].map((map) => map.querySelector('figcaption').textContent);
  seen.pixels = [...document.querySelectorAll('.map canvas')].map((canvas) => pixels(canvas, 4, 3));
  seen.text = document.body.innerText;
  seen.labels = [...document.querySelectorAll('[aria-label]')].map((one) => one.getAttribute('aria-label'));
  seen.colours = Number(document.documentElement.dataset.colours || 0);
  seen.view = (document.documentElement.dataset.seen || '').split(' ').map(Number);
  seen.cells = [...document.querySelectorAll('.matrix td a')].map((a) => [a.getAttribute('aria-label'), a.textContent]);
}
const drawn = () => document.documentElement.dataset.drawn || '';
async function until(so) {
  for (let k = 0; k < 1000 && !so(); ++k) await new Promise((again) => setTimeout(again, 20));
  look();
}
const changed = () => until(() => drawn() !== seen.drawn);
"""


def run(*arguments):
    subprocess.run(arguments, check=True, stdout=subprocess.DEVNULL)


class Browser:
    """One Chromium, told over pipes what to show; it brings back what a probe saw."""

    def __init__(self, program):
        (its_in, ours), (back, its_out) = os.pipe(), os.pipe()
        self.process = subprocess.Popen(
            ["sh", "-c", f'exec "$@" 3<&{its_in} 4>&{its_out}', "sh", program, "--headless", "--no-sandbox", "--disable-gpu",
             "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
             "--disable-extensions", "--disable-dev-shm-usage", "--user-data-dir=" + os.path.abspath("profile"),
             "--hide-scrollbars", "--remote-debugging-pipe"], pass_fds=(its_in, its_out), stderr=subprocess.DEVNULL)
        os.close(its_in), os.close(its_out)
        self.to, self.back = os.fdopen(ours, "wb"), os.fdopen(back, "rb")
        self.rest, self.number, self.complaints, self.session = b"", 0, [], {}
        target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        self.session = {"sessionId": self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]}
        for domain in ("Page", "Runtime", "Log"):
            self.ask(domain + ".enable")

    def read_until(self, so):
        while True:
            *messages, self.rest = self.rest.split(b"\0", 1)
            if not messages:
                more = self.back.read1(1 << 20)
                assert more, "the browser has ended"
                self.rest += more
                continue
            message = json.loads(messages[0])
            # The probe reads canvases more than once, which the browser remarks on.
            if message.get("method") in COMPLAINTS and "willReadFrequently" not in str(message):
                self.complaints.append(message["params"])
            if so(message):
                return message

    def ask(self, method, **parameters):
        self.number += 1
        question = {"id": self.number, "method": method, "params": parameters, **self.session}
        self.to.write(json.dumps(question).encode() + b"\0")
        self.to.flush()
        answer = self.read_until(lambda message: message.get("id") == self.number)
        assert "result" in answer, answer
        return answer["result"]

    def look(self, page, act="", size=(1280, 800), dark=False, address=""):
        self.ask("Emulation.setDeviceMetricsOverride", width=size[0], height=size[1], deviceScaleFactor=1, mobile=False)
        self.ask("Emulation.setEmulatedMedia",
                 features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.ask("Page.navigate", url=f"file://{os.path.abspath(page)}?{self.number}{address}")  # not only to another place in it
        self.read_until(lambda message: message.get("method") == "Page.loadEventFired")
        probe = f"(async () => {{ {PROBE} await until(drawn); {act}; return seen; }})()"
        found = self.ask("Runtime.evaluate", expression=probe, awaitPromise=True, returnByValue=True)
        assert "exceptionDetails" not in found, found["exceptionDetails"]
        assert not self.complaints, f"the console has errors: {self.complaints}"
        seen = found["result"]["value"]
        assert seen["error"] == "", seen["error"]
        return seen


def check_pictures(seen, swept, precise):
    """Charts and heat maps against the rows."""
    curves = [row for row in precise if "curve" in row]
    points = [row for row in precise if "curve" not in row and "error_max_m" in row]
    counts = [int(count) for count in seen["points"][0].split()]
    assert sum(counts) == len(points) == seen["numbers"], (counts, len(points), seen["numbers"])
    assert len(counts) <= len(curves)
    for map_title, pixels in zip(seen["maps"], seen["pixels"]):
        who = map_title.split(":")[0]
        mine = [row for row in swept if row["contender"] == who]
        bad = sum(row["verdict"] != "holds" for row in mine)
        assert map_title == f"{who}: {bad} of {len(mine)} cases do not hold", map_title
        cells = {}
        for row in mine:
            place = (row["parameters"]["thickness_m"], row["parameters"]["speed_m_s"])
            cells.setdefault(place, []).append(row["verdict"] != "holds")
        ys, xs = (sorted({place[k] for place in cells}) for k in (0, 1))
        assert (len(xs), len(ys)) == (4, 3)
        looks = {}
        for (y, x), through in cells.items():
            kind = "all" if all(through) else "some" if any(through) else "none"
            looks.setdefault(kind if kind != "some" else ("some", sum(through)), set()).add(pixels[ys.index(y)][xs.index(x)])
        assert all(len(colours) == 1 for colours in looks.values()), (who, looks)
        assert len(set().union(*looks.values())) == len(looks), (who, looks)
    assert len(seen["maps"]) == 3


# Clicks the cell of a map, by its title, and looks at the replay.
CLICK = """const map = [...document.querySelectorAll('.map')].find((one) => one.textContent.startsWith('%s:'));
    const canvas = map.querySelector('canvas'), box = canvas.getBoundingClientRect(), width = (box.width - 58) / 4;
    canvas.dispatchEvent(new MouseEvent('click', {bubbles: true, clientX: box.left + 54 + (%d + 0.5) * width,
                                                  clientY: box.top + 4 + (2 - %d + 0.5) * 24}));
    await changed();"""
REPLAY = """seen.title = text('h2')[0]; seen.words = text('.sentence')[0];
    seen.facts = text('dl.pairs > *'); seen.code = text('code').at(-1); seen.hash = location.hash;
    seen.shown = text('.legend button'); seen.state = text('.readout td');"""


def check_replays_of_cells(browser, swept):
    """A click on a cell, or Enter, replays the case that the rows say, and leads back."""
    def first_of(who, speed, thickness):
        mine = [row for row in swept if row["contender"] == who and
                (row["parameters"]["speed_m_s"], row["parameters"]["thickness_m"]) == (speed, thickness)]
        return next((row for row in mine if row["verdict"] != "holds"), mine[0])

    def check(seen, who, row):
        assert seen["drawn"].startswith("cell step "), seen["drawn"]
        assert seen["shown"] == [who] and seen["title"].startswith(who + " at speed [m/s] = "), seen
        facts = dict(zip(seen["facts"][::2], seen["facts"][1::2]))
        for name, key in (("speed [m/s]", "speed_m_s"), ("thickness [m]", "thickness_m"), ("phase", "phase")):
            assert float(facts[name]) == row["parameters"][key], (facts, row["parameters"])
        assert seen["code"] == row["command"], seen["code"]
        assert row.get("reason", "") in seen["words"], seen["words"]
        _, bottom, _, top = seen["view"]
        assert bottom < 0 < top and top - bottom < 6, seen["view"]  # the paper is at 0, and seen from near
        assert seen["overflow"] <= 0, seen["overflow"]
        if row["tunnels"] > 0:
            assert seen["drawn"].startswith(f"cell step {row['first_tunnel']['step']} "), (seen["drawn"], row["first_tunnel"])
            assert any("tunnel: passes" in words for words in seen["state"]), seen["state"]

    passed, held = first_of("mask", 2000, 0.1), first_of("octagon_sweep", 2000, 0.01)
    assert passed["tunnels"] > 0 and held["tunnels"] == 0
    for dark in (False, True):
        seen = browser.look("all.html", CLICK % ("mask", 3, 1) + REPLAY, dark=dark)
        check(seen, "mask", passed)
    check(browser.look("all.html", CLICK % ("octagon_sweep", 3, 0) + REPLAY), "octagon_sweep", held)
    address = seen["hash"]
    check(browser.look("all.html", REPLAY, address=address, size=(390, 844)), "mask", passed)

    # Enter opens it; Escape, the link and the browser's own way back lead back to the cell.
    enter = """const map = document.querySelector('.map canvas'), press = (to, key) => to.dispatchEvent(
            new KeyboardEvent('keydown', {key, bubbles: true}));
        for (const key of ['ArrowRight', 'ArrowRight', 'ArrowRight', 'ArrowRight', 'ArrowUp', 'Enter'])
          press(map, key);
        await changed(); seen.from = drawn(); %s; await until(() => drawn() === 'summary');
        const box = document.activeElement.getBoundingClientRect();
        seen.told = text('.told')[0]; seen.hash = location.hash; seen.at = [box.top, box.bottom];
        seen.told_at = document.querySelector('.told').getBoundingClientRect().top;"""
    for act in ("press(document.body, 'Escape')", "document.querySelector('main a').click()", "history.back()"):
        seen = browser.look("all.html", enter % act, size=(1000, 500))
        assert seen["from"].startswith("cell step ") and seen["drawn"] == "summary", (act, seen["from"], seen["drawn"])
        assert "mask at speed [m/s] = 2000, thickness [m] = 0.1" in seen["told"], seen["told"]
        assert "at=3%2C1" in seen["hash"], seen["hash"]
        assert 0 <= seen["at"][0] and seen["at"][1] <= seen["height"] and 0 <= seen["told_at"] < seen["height"], seen
    # An address of no replay is the summary.
    assert browser.look("all.html", address=address.replace("cell=3%2C1", "cell=30%2C1"))["drawn"] == "summary"


def write_replays(command):
    """A page with events of every kind, steps of different lengths, and texts that try to break out of it."""
    run(command, "convert", "closing_ceiling", "hostile.json")
    hostile = json.loads(Path("hostile.json").read_text(encoding="utf-8"))
    hostile["name"] = hostile["movers"][0]["id"] = HOSTILE
    slow = {"paperproof_scene": 1, "name": "slow", "gravity": [0, 0], "dt": 1, "dt_list": [1 / 64, 100], "steps": 2,
            "character": {"position": [0, 1], "velocity": [0.01, 0]}, "scenery": [{"chain": [[-4, 0], [4, 0]]}]}
    write("hostile.json", [hostile])
    write("slow.json", [slow])
    some = ("--quiet", "--no-timing", "--contender", "mask,octagon_sweep,box2d")
    run(command, "compare", "article_bullet", "sensor_gate", "characters_head_on", "one_way_drop", "slow.json",
        "hostile.json", *some, "--report", "several.html", "--trace", "whole")
    run(command, "compare", "one_square", "--quiet", "--no-timing", "--contender", "grid", "--report", "grid.html")
    run(command, "compare", "lift_up", "turning_arm", "--steps", "1500", *some[:-1], "octagon_sweep", "--report", "long.html")
    run(command, "report", "replays.html", "several.html", "grid.html", "long.html")


HOSTILE = "</script><script>throw 1</script><!-- & \" ' ]]>"
TABLE = json.loads(Path(__file__).with_name("tables").joinpath("replays_in_browser.json").read_text(encoding="utf-8"))


def check_replays(browser):
    """Every kind of step is drawn where its address says, and told in words."""
    def check(seen, address, drawn, words, height=None, most=None):
        assert re.fullmatch(drawn, seen["drawn"]), (address, drawn, seen["drawn"])
        # Background, solids, outlines and at least one contender, each with its anti-aliased shades.
        assert drawn == "summary" or seen["colours"] >= 8, (address, seen["colours"])
        if height is not None:
            _, bottom, _, top = seen["view"]
            assert bottom < height < top and top - bottom <= most, (address, seen["view"])
        for part in words:
            assert part in seen["text"], (address, part)

    for row in TABLE["replays"]:
        address = row["address"].replace("{hostile_in_address}", quote(HOSTILE))
        words = [part.replace("{hostile}", HOSTILE) for part in row["words"]]
        seen = browser.look("replays.html", address=f"#{address}&check=1" if address else "")
        check(seen, address, row["drawn"], words, row.get("shows"), row.get("high"))
    # After half a second of playing it is long through with the first step, and nowhere near the end of the second. How
    # often a headless browser draws on its own after that is its affair.
    played = browser.look("replays.html", address="#scene=slow&step=0&t=0&play=0.5&check=1")
    check(played, "played", r"scene 4 step 1 t (0\.0|[0-9.]*e-).*", [])
    assert "Pause" in played["labels"], played["labels"]
    # Jumps move the view, too: from all of the ways to what is touched first, by Box2D with its gap of 5 mm.
    act = "[...document.querySelectorAll('button')].find((one) => one.textContent === 'first contact').click();"
    jumped = browser.look("replays.html", act + "await changed();", address="#scene=article_bullet&step=9&view=fit&check=1")
    check(jumped, "first contact", r"scene 0 step 0 t 0\.596[78]\d*", [], 0, 1)


def check_saved_traces(browser, command):
    """What is saved of a replay is the trace that the command writes, or its beginning, and can be judged."""
    os.makedirs("saved")
    browser.ask("Browser.setDownloadBehavior", behavior="allow", downloadPath=os.path.abspath("saved"))
    for row in TABLE["saved"]:
        scene, who, button, steps = (row[key] for key in ("scene", "who", "button", "steps"))
        act = f"""const save = [...document.querySelectorAll('[aria-label="Save the trace of"] button')]
                .find((one) => /^{button}$/.test(one.textContent));
            seen.saved = save.textContent; save.click();"""
        seen, saved = browser.look("replays.html", act, address=f"#scene={scene}"), Path("saved", f"{scene}.{who}.jsonl")
        for _ in range(500):
            if saved.exists():
                break
            time.sleep(0.02)
        text, kept = saved.read_text(encoding="utf-8"), re.fullmatch(button, seen["saved"]).groups()
        if not kept:
            assert text == Path(f"whole.{saved.name}").read_text(encoding="utf-8"), (scene, who)
        header, *records = read(saved)
        assert len(records) == int(kept[0] if kept else steps) * header.get("characters", 1), (scene, len(records))
        assert not kept or 300 <= len(records) < steps and "steps" not in header, (scene, len(records))
        for checker in ((command, "judge"), CHECKER):
            status, said, errors = call(*checker, saved)
            assert (status, errors) == (0, ""), (scene, who, said, errors)


def main():
    command, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
    program = next((name for name in BROWSERS if shutil.which(name)), None)
    if program is None:
        print("skipped: no chromium is installed (Debian: apt install chromium)")
        return 77
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    os.chdir(folder)
    some = ("--quiet", "--contender", CONTENDERS)
    run(command, "compare", "article_bullet", "thin_platform", *some, "--rows", "m.jsonl", "--report", "m.html")
    run(command, "sweep", "paper", "--vary", "speed=5,50,200,2000", "--vary", "thickness=0.01,0.1,0.4", "--vary",
        "phase=0,0.2,0.5", *some, "--rows", "s.jsonl")
    run(command, "work-precision", "bullet", *some, "--rows", "w.jsonl")
    run(command, "report", "all.html", "m.html", "s.jsonl", "w.jsonl")
    compared, swept, precise = (read(name)[1:] for name in ("m.jsonl", "s.jsonl", "w.jsonl"))
    write_replays(command)
    browser = Browser(program)
    try:
        check_replays(browser)
        check_saved_traces(browser, command)
        check_summary(browser, compared, swept, precise)
        check_replays_of_cells(browser, swept)
    finally:
        browser.process.terminate()
        browser.process.wait()
    print("the pictures show what the rows say")
    return 0


def check_summary(browser, compared, swept, precise):
    seen = browser.look("all.html")
    assert seen["drawn"] == "summary" and seen["strip"] == "step 0 t 1", seen
    assert all(0 <= top < seen["height"] - 200 for top in seen["above"]) and len(seen["above"]) == 3, seen["above"]
    assert len(seen["tiles"]) == len([row for row in compared if row["scene"] == "article_bullet"])
    assert [("through" in tile) for tile in seen["tiles"]] == [
        row["tunnels"] > 0 for row in compared if row["scene"] == "article_bullet"], seen["tiles"]
    check_pictures(seen, swept, precise)
    marks = {"holds": "\u2713", "tunnels": "\u2715"}
    verdicts = {(row["scene"], row["contender"]): row["verdict"] for row in compared}
    assert len(seen["cells"]) == len(compared)
    for about, mark in seen["cells"]:
        scene, who = re.match(r"(\w+), (\w+)", about).groups()
        assert mark == marks.get(verdicts[scene, who], mark), (about, mark)

    dark = browser.look("all.html", dark=True)
    assert dark["background"] != seen["background"] and dark["ink"] != seen["ink"], dark
    check_pictures(dark, swept, precise)
    for page in ("", "#scene=article_bullet&contender=mask"):
        phone = browser.look("all.html", size=(390, 844), address=page)
        assert phone["overflow"] <= 0, f"the page is {phone['overflow']} px wider than a phone at {page or 'the summary'}"

    # A cell leads to the replay of this case alone.
    clicked = browser.look("all.html", """document.querySelector('.matrix a[aria-label^="thin_platform, mask"]').click();
        await changed(); seen.shown = text('.legend button[aria-pressed="true"]');""")
    assert clicked["drawn"].startswith("scene 1 "), clicked["drawn"]
    assert clicked["shown"] == ["mask"], clicked["shown"]
    # Without a mouse: the fraction of the step, a cell of a map, a curve of the chart.
    keyed = browser.look("all.html", """const slider = document.querySelector('.fraction input');
        slider.value = 0.5; slider.dispatchEvent(new Event('input'));
        const map = document.querySelector('.map canvas');
        for (const key of ['ArrowRight', 'ArrowRight', 'ArrowUp'])
          map.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));
        const curve = document.querySelector('.curves button');
        curve.click();
        look(); seen.told = text('.told')[0]; seen.pressed = curve.getAttribute('aria-pressed');
        seen.reachable = [slider, map, curve, document.querySelector('.tile[href]'), document.querySelector('.matrix a')]
            .every((one) => one.tabIndex === 0);""")
    assert keyed["strip"] == "step 0 t 0.5", keyed["strip"]
    assert "speed [m/s] = 50, thickness [m] = 0.1" in keyed["told"], keyed["told"]
    assert keyed["told"].endswith("Click or Enter: its replay."), keyed["told"]
    assert keyed["pressed"] == "false" and keyed["reachable"], keyed


if __name__ == "__main__":
    sys.exit(main())
