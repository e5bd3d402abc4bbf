"""The page for long: random gestures of two windows and a process, and a server that is killed.

``python -m benchmarks.page_gestures --minutes 30 --hull dtc`` serves a hull file in a process of
its own and lets two people in a browser drag, pull, type, undo, look back, fair, vary and bend
lines at random, while a third process commits to the file. Then the browser must have said nothing
on its console, both windows must show the file to the bit, the memory of page and server must not
grow, and in the end `verify` finds nothing and all is undone to the bit.

``--kills 100`` kills the server (SIGKILL) in the middle of gestures and starts it again: what was
told as made must be in the file, and the page must come back by itself. Needs the browser that
`make test-page` needs.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import attrs
import numpy as np
from playwright.sync_api import Browser, Error, Locator, Page, sync_playwright

import assoc_hull as ah
from assoc_hull.model.program.engine import wait_for_engine
from tests.browser.conftest import NAMES, READY, Hand
from tests.cases.dtc import read_dtc_with_report

__all__ = ["main"]

HULLS: dict[str, Callable[[], ah.Hull]] = {
    "series60": ah.examples.series60,
    "carrier": ah.examples.bulk_carrier_207k,
    "dtc": lambda: read_dtc_with_report(Path(os.environ["ASSOC_HULL_DATA"]))[0],
}
SAMPLES = 12
"""So often is the memory looked at on the way."""

STANDING = (
    "p => JSON.stringify([p.store.history, p.store.held, p.store.refusal, p.store.problem,"
    " p.wanted, p.hand.committing, p.hand.inFlight, p.hand.wish, p.hand.gripped, p.pending,"
    " p.marker, p.answered, p.store.connection,"
    " p.panel.askers.map(each => each.words?.textContent)])"
)
"""What a window waits for, where it waits in vain."""

PATIENCE = 600.0
"""An act takes so long (s) at most: a variation of a large hull, on a machine that is busy."""

REST = 8
"""So long is the server left alone before its memory is looked at, s."""

WARM = 0.25
"""Part of the time after which memory is not to grow any more."""

COMMITTER = """
import sys
import assoc_hull as ah
hull = ah.open(sys.argv[1])
hull.author = "carla"
print("ready", flush=True)
for line in sys.stdin:
    name, _, far = line.rstrip("\\n").rpartition("|")
    hull.refresh()
    try:
        hull.apply("elsewhere", [{"op": "pull", "point": name, "d": float(far), "radius": [9, 4]}])
    except ah.errors.AssocHullError:
        pass
    print(len(hull.history), flush=True)
"""


@attrs.define
class Server:
    """A server in a process of its own."""

    path: Path
    run: subprocess.Popen[str]
    address: str

    @classmethod
    def start(cls, path: Path) -> Server:
        """Start one, and wait for its address."""
        run = subprocess.Popen(
            [sys.executable, "-m", "assoc_hull.cli", "page", str(path), "--no-browser", "--json",
             "--stay", "--author", "anna"],
            stdout=subprocess.PIPE, text=True,
            env={**os.environ, "XDG_RUNTIME_DIR": str(path.parent / "run")},
        )  # fmt: skip
        assert run.stdout is not None
        text = ""
        while "}" not in text:
            if not (line := run.stdout.readline()):
                raise RuntimeError(f"the server ended with {run.wait()}")
            text += line
        return cls(path, run, json.loads(text)["address"])

    def end(self, how: signal.Signals = signal.SIGINT) -> None:
        """End it."""
        self.run.send_signal(how)
        self.run.communicate(timeout=60.0)

    @property
    def memory(self) -> float:
        """What it holds of the machine's memory at rest, MB: it gives back what is free in 5 s."""
        least = float("inf")
        for _ in range(REST):
            time.sleep(1.0)
            lines = Path(f"/proc/{self.run.pid}/status").read_text().splitlines()
            (found,) = (line.split()[1] for line in lines if line.startswith("VmRSS"))
            least = min(least, int(found) / 1024.0)
        return least


def press(button: Locator) -> None:
    """Press a button of the panel, also where an answer above it moves it under the hand."""
    button.evaluate("each => each.click()")


@attrs.define(eq=False)
class Window:
    """Somebody at a window of the page, who does things at random."""

    hand: Hand
    author: str
    rng: random.Random
    said: list[str]
    took: dict[str, float] = attrs.field(factory=dict)
    """The longest time of each act, s."""

    @classmethod
    def open(cls, browser: Browser, server: Server, author: str, rng: random.Random) -> Window:
        """Open one."""
        context = browser.new_context(viewport={"width": 1440, "height": 840}, bypass_csp=True)
        page, said = context.new_page(), list[str]()
        page.set_default_timeout(1e3 * PATIENCE)
        page.on("console", lambda message: said.append(message.text))
        page.on("pageerror", lambda error: said.append(str(error)))
        page.goto(server.address)
        page.wait_for_selector(READY)
        found = cls(Hand(page, None), author, rng, said)  # type: ignore[arg-type]
        found.hand.ask("(p, name) => p.sign(name)", author)
        titles = ("History", "Fair", "Vary", "Hydrostatics", "Why")
        for title in titles if author == "anna" else titles[:3]:
            found.hand.ask("(p, title) => p.panel.open(title)", title)
        press(found.box("Vary").get_by_text("List the parameters"))
        found.hand.until("p => p.panel.vary.found.length > 0")
        return found

    @property
    def page(self) -> Page:
        """The page of the browser."""
        return self.hand.page

    def box(self, title: str) -> Locator:
        """Give a part of the panel."""
        return self.page.locator(f"details:has(h2:text-is('{title}'))")

    @property
    def heap(self) -> float:
        """What the page's own objects hold, MB."""
        session = self.page.context.new_cdp_session(self.page)
        session.send("HeapProfiler.collectGarbage")
        used = session.send("Runtime.getHeapUsage")["usedSize"]
        session.detach()
        return float(used) / 1e6

    @property
    def edits(self) -> int:
        """How many edits the page says that the hull has."""
        return int(self.hand.ask("p => p.store.history.edits"))

    @property
    def curves(self) -> dict[int, list[float]]:
        """The places of all curves that the page shows, by their numbers."""
        return dict(self.hand.ask("p => [...p.store.curves].map(([id, c]) => [id, [...c.xyz]])"))

    # ---- acts: each ends when its answer has come

    def quiet(self) -> None:
        """Wait until nothing is in hand and nothing is asked; then take messages away."""
        self.hand.until(
            "p => p.pending === 0 && p.hand.inFlight === 0 && !p.hand.committing"
            " && !p.panel.askers.some(each => each.words?.textContent.trim().endsWith('…'))"
        )
        self.hand.ask(
            "p => { const {store} = p; store.refusal = store.problem = null; p.shaper.stop();"
            " store.inserting = null; p.dropGhost(); p.activeView().upper.focus(); }"
        )
        self.hand.settled()

    def pick(self) -> tuple[str, str]:
        """Give a point and a view that shows it."""
        kind = self.rng.choice(["body", "body", "half", "profile"])
        rows = self.hand.ask("(p, kind) => p.views[kind].rows().length", kind)
        at = self.rng.randrange(rows)
        name: str = self.hand.ask(
            "(p, kind, at) => p.store.net.points.get(p.views[kind].rows()[at]).name", kind, at
        )
        return name, kind

    def take(self, name: str, kind: str) -> tuple[float, float]:
        """Take hold of a point; what cannot be taken hold of is refused by then."""
        self.hand.near(name, kind, self.rng.choice([100.0, 400.0, 2000.0]))
        x, y = self.hand.spot(name, kind)
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(x + 4.0, y)
        self.hand.until("p => p.hand.gripped || p.store.refusal || !p.store.held")
        return x + 4.0, y

    def to(self, x: float, y: float) -> None:
        """Move the hand on, and wait for what follows, if anything is in hand."""
        self.page.mouse.move(x, y)
        self.hand.until(
            "p => p.pending === 0 && (!p.store.held || (p.hand.inFlight === 0 && !p.hand.wish))"
        )

    def drag(self, *, finish: bool = True) -> None:
        """Drag a point, by a pull or alone, and let go or give up."""
        alone = self.rng.random() < 0.3
        if alone:
            self.page.keyboard.down("Control")
        x, y = self.take(*self.pick())
        if alone:
            self.page.keyboard.up("Control")
        for _ in range(self.rng.randrange(1, 8)):
            self.page.mouse.move(x + self.rng.gauss(0.0, 8.0), y + self.rng.gauss(0.0, 8.0))
        self.to(x + self.rng.gauss(0.0, 5.0), y + self.rng.gauss(0.0, 5.0))
        if not finish:
            return
        if self.rng.random() < 0.2:
            self.page.keyboard.press("Escape")
        self.page.mouse.up()
        self.quiet()

    def edit(self) -> int:
        """Drag until an edit is made; one may be refused, or given up. Give how many there are."""
        begin = self.edits
        while (edits := self.edits) <= begin:
            self.drag()
        return edits

    def arrows(self) -> None:
        """Nudge the chosen point by a burst of arrows."""
        self.hand.ask("(p, name) => p.find(name)", self.pick()[0])
        for _ in range(self.rng.randrange(1, 5)):
            key = self.rng.choice(["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight"])
            self.page.keyboard.press(self.rng.choice(["", "", "Alt+", "Shift+"]) + key)
        self.page.keyboard.press("Enter")
        self.quiet()

    def table(self) -> None:
        """Type a coordinate of a point."""
        self.hand.ask("(p, name) => p.find(name)", self.pick()[0])
        self.hand.settled()
        field = self.page.get_by_label("y, m, from the centre plane")
        if field.count() and field.is_editable():
            field.fill(f"{float(field.input_value()) + self.rng.gauss(0.0, 0.01):.4f}")
            field.press("Enter")
            self.wait_for_answer()
        self.quiet()

    def wait_for_answer(self) -> None:
        """Wait until the last request of the page is answered, however."""
        self.hand.ask(
            "p => { p.answered = 0; p.heard ??= (p.panel.askers.push({lost() {}, done() {},"
            " render() {}, dropped() {}, refused: () => false, problem: () => false,"
            " answer: m => { if (m.id === p.marker) p.answered = m.id; }}), true);"
            " p.marker = p.request({t: 'steps'}); }"
        )
        self.hand.until("p => p.answered === p.marker")

    def key(self, keys: str) -> None:
        """Press a key of an action, and wait for its answer."""
        self.hand.ask("p => p.activeView().upper.focus()")
        self.page.keyboard.press(keys)
        self.wait_for_answer()
        self.quiet()

    def undo(self) -> None:
        """Take back one's own last edit, or make it again."""
        self.key(self.rng.choice(["Control+z", "Control+z", "Control+z", "Control+y"]))

    def look_back(self) -> None:
        """Go to another step, compare with one, or give the present state a name."""
        box = self.box("History")
        box.locator("ol.steps li").first.wait_for()
        which = self.rng.random()
        if which < 0.2:
            box.get_by_label("name of the present state").fill(f"s{self.rng.random():.9f}")
            press(box.get_by_text("Keep under this name"))
        else:
            # The nearest ones: a walk over hundreds of steps is another thing.
            words = "compare with it" if which < 0.6 else None
            found = box.locator("ol.steps li:nth-child(-n+8) button")
            some = found.filter(has_text=words) if words else found.filter(has_not_text="compare")
            if count := some.count():
                press(some.nth(self.rng.randrange(count)))
        self.wait_for_answer()
        self.quiet()

    def fair(self) -> None:
        """Look at a window faired; make it now and then."""
        self.hand.ask("(p, name) => p.find(name)", self.pick()[0])
        self.hand.settled()
        box = self.box("Fair")
        box.locator("input[type=range]").fill(str(self.rng.randrange(10, 60)))
        self.hand.until("p => !p.panel.fair.words.textContent.endsWith('…')")
        make = box.get_by_role("button", name="Apply")
        if self.rng.random() < 0.5 and make.is_enabled():
            press(make)
            self.wait_for_answer()
        self.quiet()

    def vary(self) -> None:
        """Look at a variant; make it now and then."""
        box = self.box("Vary")
        name, value = self.rng.choice(
            self.hand.ask("p => p.panel.vary.found.map(each => [each.name, each.value])")
        )
        box.locator("select").select_option(name)
        box.locator("input").fill(f"{value * (1.0 + self.rng.gauss(0.0, 0.004)):.4f}")
        which = "Apply" if self.rng.random() < 0.3 else "Preview"
        press(box.get_by_role("button", name=which))
        self.hand.until("p => !p.panel.vary.words.textContent.endsWith('…')")
        self.wait_for_answer()
        self.quiet()

    def bend(self) -> None:
        """Make a knuckle, or a smooth point, of the chosen line."""
        self.hand.ask("(p, name) => p.find(name)", self.pick()[0])
        self.key(self.rng.choice(["n", "Shift+N", "Shift+T"]))

    def act(self) -> str:
        """Do one thing."""
        acts = {
            self.drag: 10, self.arrows: 3, self.table: 3, self.undo: 9, self.look_back: 3,
            self.fair: 1, self.vary: 1, self.bend: 1,
        }  # fmt: skip
        (what,) = self.rng.choices(list(acts), list(acts.values()))
        begin, name = time.monotonic(), what.__name__
        what()
        self.took[name] = max(self.took.get(name, 0.0), time.monotonic() - begin)
        return name


def shows(window: Window, path: Path) -> bool:
    """Tell whether a window shows what is in the file, to the bit."""
    hull = ah.open(path)
    found = curves_of(hull)
    hull.close()
    return window.curves == found


def curves_of(hull: ah.Hull) -> dict[int, list[float]]:
    """Give the places of all curves by their numbers."""
    shapes = hull.shapes()
    each = zip(shapes.curves.tolist(), shapes.spline.single(), strict=True)
    return {number: spline.xyz.ravel().tolist() for number, spline in each}


@contextmanager
def committer(path: Path) -> Iterator[Callable[[str, float], int]]:
    """Give a process that commits to the file: called, it gives how many edits there are then."""
    run = subprocess.Popen(
        [sys.executable, "-c", COMMITTER, str(path)],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert run.stdin is not None
    assert run.stdout is not None
    sender, answers = run.stdin, run.stdout
    answers.readline()

    def commit(name: str, far: float) -> int:
        sender.write(f"{name}|{far}\n")
        sender.flush()
        return int(answers.readline())

    yield commit
    sender.close()
    run.wait(60.0)


def served(name: str) -> tuple[Server, Path, str]:
    """Serve a hull from a file of its own; give its fingerprint as well."""
    # Else the server takes 150 MB more whenever the compiled arithmetic is ready in its midst.
    wait_for_engine(PATIENCE)
    path, hull = Path(tempfile.mkdtemp(), "ship.hull"), HULLS[name]()
    first = hull.fingerprint
    hull.save(path)
    hull.close()
    return Server.start(path), path, first


@attrs.frozen
class Remains:
    """What is in a file in the end, and whether all is undone to the bit, in so many seconds."""

    steps: int
    edits: int
    findings: tuple[str, ...]
    undone: bool
    seconds: float

    @classmethod
    def of(cls, path: Path, first: str) -> Remains:
        """Look at a file, and undo all that is in it."""
        hull = ah.open(path)
        edits, damages = len(hull.history), hull.document.keeper.damages()  # type: ignore[union-attr]
        steps, findings = len(hull.document.steps), (*map(str, hull.verify()), *map(str, damages))
        begin = time.process_time()
        if edits:
            hull.undo(edits)
        same, took = hull.fingerprint == first, time.process_time() - begin
        hull.close()
        return cls(steps, edits, findings, same, took)


def gestures(browser: Browser, name: str, minutes: float, seed: int, tell: Callable[[str], None]) -> bool:  # fmt: skip  # noqa: E501
    """Do things at random for so long; tell whether all is as it must be."""
    rng, (server, path, first) = random.Random(seed), served(name)
    anna = Window.open(browser, server, "anna", rng)
    bert = Window.open(browser, server, "bert", rng)
    begin, counts, faults = time.monotonic(), Counter[str](), list[str]()
    samples, elsewhere, next_look = list[tuple[float, float, float]](), 0, 0.0
    with committer(path) as commit:
        while (now := time.monotonic() - begin) < 60.0 * minutes:
            if now >= next_look:
                next_look += 60.0 * minutes / SAMPLES
                samples.append((now, anna.heap, server.memory))
                shown = [shows(each, path) for each in (anna, bert)]
                faults += [f"at {now:.0f} s a window shows another hull"] * (not all(shown))
                tell(f"{name}: {now:.0f} s, {sum(counts.values())} acts, {anna.edits} edits, page "
                     f"{samples[-1][1]:.1f} MB, server {samples[-1][2]:.0f} MB")  # fmt: skip
            who = anna if rng.random() < 0.7 else bert
            which = rng.random()
            try:
                if which < 0.05:
                    count = commit(anna.pick()[0], rng.gauss(0.0, 0.01))
                    elsewhere += 1
                    for each in (anna, bert):
                        each.hand.until("(p, n) => p.store.history.edits === n", count)
                    counts["another process"] += 1
                elif which < 0.12:
                    together(anna, bert)
                    counts["both at once"] += 1
                else:
                    counts[who.act()] += 1
                other = anna if who is bert else bert
                other.hand.until("(p, n) => p.store.history.edits === n", who.edits)
            except Error as error:
                acts = [each.name for each in traceback.extract_tb(error.__traceback__)]
                told = (f"{each.author} {each.hand.ask(STANDING)}" for each in (anna, bert))
                faults.append(f"at {now:.0f} s, {who.author} in {' > '.join(acts[1:4])}: "
                              f"{str(error)[:80]}; {'; '.join(told)}")  # fmt: skip
                break
    anna.quiet()
    bert.quiet()
    samples.append((time.monotonic() - begin, anna.heap, server.memory))
    shown = [shows(each, path) for each in (anna, bert)]
    said = anna.said + bert.said
    for each in (anna, bert):
        each.page.context.close()
    server.end()
    longest = {what: max(each.took.get(what, 0.0) for each in (anna, bert)) for what in counts}
    tell(f"{name}: longest acts " + ", ".join(
        f"{what} {took:.1f} s" for what, took in longest.items() if took))  # fmt: skip
    return judge(name, path, first, np.array(samples), counts, faults, shown, said, tell)


def together(anna: Window, bert: Window) -> None:
    """One holds a point; the other tries to take one and to undo, and is told who holds it."""
    anna.drag(finish=False)
    bert.take(*bert.pick())
    bert.page.mouse.up()
    bert.key("Control+z")
    anna.page.mouse.up()
    anna.quiet()
    bert.quiet()


def judge(
    name: str, path: Path, first: str, samples: np.ndarray[Any, Any], counts: Counter[str],
    faults: list[str], shown: list[bool], said: list[str], tell: Callable[[str], None],
) -> bool:  # fmt: skip
    """Look at the file and at the figures; tell them."""
    left = Remains.of(path, first)
    warm = samples[samples[:, 0] >= WARM * samples[-1, 0]][-SAMPLES:]
    # The least of a few looks: what is not yet collected comes and goes.
    half = len(warm) // 2
    grown = [float(warm[half:, i].min() - warm[: half + 1, i].min()) for i in (1, 2)]
    tell(f"{name}: {samples[-1, 0] / 60:.1f} min, load {os.getloadavg()[0]:.1f}, acts "
         + ", ".join(f"{what} {n}" for what, n in counts.most_common()))  # fmt: skip
    tell(f"{name}: {left.steps} steps, {left.edits} edits at the end; both windows show the file: "
         f"{shown}")  # fmt: skip
    tell(f"{name}: page {samples[0, 1]:.1f} MB at first, {warm[0, 1]:.1f} warm, "
         f"{samples[-1, 1]:.1f} at the end, grown {grown[0]:+.2f}; server {samples[0, 2]:.0f}, "
         f"{warm[0, 2]:.0f}, {samples[-1, 2]:.0f}, grown {grown[1]:+.1f} MB")  # fmt: skip
    tell(f"{name}: findings of verify {len(left.findings)}, undone to the bit {left.undone} "
         f"({left.seconds:.1f} s), messages on the console {len(said)}, faults "
         f"{len(faults)}")  # fmt: skip
    for each in (*left.findings[:5], *said[:5], *faults[:5]):
        tell(f"{name}:   {each}")
    return left.undone and all(shown) and not (left.findings or said or faults)


@attrs.define
class Toll:
    """What came of servers that were killed."""

    acts: Counter[str] = attrs.field(factory=Counter)
    faults: list[str] = attrs.field(factory=list)
    back: list[float] = attrs.field(factory=list)
    """How long each page took to be back, s."""
    further: int = 0
    """So often the file was one step further than the page knew."""
    fewest: int = 1 << 30
    """Edits in the file when the server was killed, at least."""

    def kill(self, window: Window, server: Server, number: int) -> Server:
        """Kill a server in the middle of a gesture, after an edit; give the one that follows."""
        known, rng, path = window.edit(), window.rng, server.path
        before = window.curves
        act = rng.choice(["drag", "drag", "commit", "commit", "undo"])
        self.acts[act] += 1
        if act == "undo":
            window.hand.ask("p => p.undo()")
        else:
            window.drag(finish=False)
            if act == "commit":
                window.page.mouse.up()
            else:
                window.page.mouse.move(700.0 + rng.gauss(0.0, 40.0), 300.0)
        # So long an edit is under way, about; what the page knows by then is what was told.
        window.page.wait_for_timeout(rng.uniform(0.0, 120.0))
        told = window.edits
        server.end(signal.SIGKILL)
        window.page.mouse.up()
        there = self._look(path, f"kill {number}, {act}", known, told, before, act)
        window.hand.until("p => p.store.connection === 'lost'")
        server = Server.start(path)
        begin = time.monotonic()
        window.hand.until(
            "(p, n) => p.store.connection === 'open' && p.hand.free"
            " && p.store.history.edits === n", there,
        )  # fmt: skip
        self.back.append(time.monotonic() - begin)
        window.quiet()
        if not shows(window, path):
            self.faults.append(f"kill {number}: the window shows another hull")
        return server

    def _look(
        self, path: Path, where: str, known: int, told: int, before: dict[int, list[float]],
        act: str,
    ) -> int:  # fmt: skip
        """Compare the file with what the page was told; give how many edits there are."""
        hull = ah.open(path)
        there, same = len(hull.history), curves_of(hull) == before
        findings = hull.verify()
        hull.close()
        least = {"undo": known - 1, "commit": known, "drag": known}[act]
        most = {"undo": known, "commit": known + 1, "drag": known}[act]
        self.further += there != told
        self.fewest = min(self.fewest, there)
        if not least <= there <= most or (act == "commit" and there < told):
            self.faults.append(f"{where}: {known} edits known, {told} told, {there} found")
        if there == known and not same:
            self.faults.append(f"{where}: the file holds another hull than was told")
        self.faults += [f"{where}: verify finds {each}" for each in findings]
        return there


def kills(browser: Browser, name: str, count: int, seed: int, tell: Callable[[str], None]) -> bool:
    """Kill the server in the middle of gestures; tell whether nothing is lost."""
    server, path, first = served(name)
    window, toll = Window.open(browser, server, "anna", random.Random(seed)), Toll()
    begin = time.monotonic()
    for number in range(count):
        try:
            server = toll.kill(window, server, number)
        except Error as error:
            standing = window.hand.ask(STANDING)
            toll.faults.append(f"kill {number}: {str(error)[:80]}; {standing}")
            break
        if number % 10 == 9:
            tell(f"{name}: {number + 1} kills, {time.monotonic() - begin:.0f} s, {window.edits} "
                 f"edits, {len(toll.faults)} faults; back after {toll.back[-1]:.2f} s")  # fmt: skip
    # That a socket cannot be opened is said by the browser itself.
    said = [each for each in window.said if "WebSocket connection to" not in each]
    window.page.context.close()
    server.end()
    left, waits, faults = Remains.of(path, first), np.array(toll.back or [np.nan]), toll.faults
    tell(f"{name}: {len(toll.back)} kills ({dict(toll.acts)}), each after an edit that was told as "
         f"made, with {toll.fewest} edits in the file at least and {left.edits} at the end; "
         f"{toll.further} times the file was one step further than the page knew, faults "
         f"{len(faults)}, findings of verify {len(left.findings)}, undone to the bit "
         f"{left.undone}, other messages on the console {len(said)}; the page was back after "
         f"{np.median(waits):.2f} s p50, {waits.max():.2f} s at most; load "
         f"{os.getloadavg()[0]:.1f}")  # fmt: skip
    for each in (*left.findings[:5], *said[:5], *faults[:8]):
        tell(f"{name}:   {each}")
    return left.undone and not (left.findings or said or faults)


def main() -> int:
    """Run from the command line."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.page_gestures", description=__doc__)
    parser.add_argument("--minutes", type=float, default=0.0, help="of gestures, on each hull")
    parser.add_argument("--kills", type=int, default=0, help="of the server, on each hull")
    parser.add_argument("--hull", action="append", choices=sorted(HULLS), help="default: all")
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    # Also where a shell has this run in the background, and so ignore Ctrl+C: servers end by it.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    named = os.environ.get("ASSOC_HULL_BROWSER", "")
    found = named or next(filter(None, map(shutil.which, NAMES)), None)
    fine = True

    def tell(line: str) -> None:
        print(line, flush=True)

    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=found, args=["--no-sandbox"])
        for name in given.hull or HULLS:
            if given.minutes:
                fine &= gestures(browser, name, given.minutes, given.seed, tell)
            if given.kills:
                fine &= kills(browser, name, given.kills, given.seed, tell)
        browser.close()
    return int(not fine)


if __name__ == "__main__":
    sys.exit(main())
