"""A browser, a server, and a hand that moves a mouse over the page; every test ends quietly."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import attrs
import numpy as np
import pytest
from playwright.sync_api import Browser, BrowserContext, Page, expect, sync_playwright

import assoc_hull as ah
from assoc_hull.page import PageServer

AXE = Path(__file__).resolve().parents[2] / "build/npm/node_modules/axe-core/axe.min.js"
# It comes by npm, which `make test-page` runs where it is installed.
collect_ignore = [] if AXE.is_file() else ["test_accessibility.py"]
collect_ignore += [] if shutil.which("node") else ["test_modules.py"]

SLOW = 120_000
"""ms: nothing on the page takes as long, also where other programs take the processors."""

expect.set_options(timeout=SLOW)

READY = ".page[data-ready=yes]"
NAMES = ("chromium", "chromium-browser", "google-chrome")


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    """The browser of this machine: ASSOC_HULL_BROWSER names it, or it is found."""
    named = os.environ.get("ASSOC_HULL_BROWSER", "")
    found = named if Path(named).is_file() else next(filter(None, map(shutil.which, NAMES)), None)
    if found is None:
        pytest.fail(f"none of {', '.join(NAMES)} is installed: apt-get install chromium")
    with sync_playwright() as driver:
        # It runs as root on the machine that tests; nothing foreign is opened.
        yield driver.chromium.launch(executable_path=found, args=["--no-sandbox"])


@attrs.define(eq=False)
class Hand:
    """Who looks at a page and moves what is on it."""

    page: Page
    server: PageServer

    @property
    def hull(self) -> ah.Hull:
        """The hull behind the page."""
        return self.server.hull

    def ask(self, script: str, *given: object) -> Any:
        """Run a function of the page: it gets the page's own object, and what is given."""
        call = f"given => ({script})(document.querySelector('.page').fairing, ...given)"
        return self.page.evaluate(call, list(given))

    def until(self, script: str, *given: object) -> None:
        """Wait until a function of the page gives true."""
        call = f"given => ({script})(document.querySelector('.page').fairing, ...given)"
        self.page.wait_for_function(call, arg=list(given))

    def settled(self) -> None:
        """Wait until nothing is to be drawn, and no answer is waited for."""
        self.until("p => p.pending === 0 && p.hand.inFlight === 0 && !p.hand.committing")

    def spot(self, name: str, kind: str = "body") -> tuple[float, float]:
        """Where a point is on the screen."""
        found: list[float] = self.ask(
            "(p, kind, name) => { const v = p.views[kind], b = v.upper.getBoundingClientRect();"
            " const [x, y] = v.atPlace(p.store.placeOf(p.store.net.find(name)));"
            " return [b.left + x, b.top + y]; }", kind, name,
        )  # fmt: skip
        return found[0], found[1]

    def near(self, name: str, kind: str = "body", scale: float = 400.0) -> None:
        """Zoom in on a point, until 1 m has so many pixels."""
        self.ask(
            "(p, kind, name, scale) => { const v = p.views[kind];"
            " const at = p.store.places.get(p.store.net.find(name));"
            " v.zoom(...v.atPlace(at), scale / v.axis.s); const [x, y] = v.atPlace(at);"
            " v.pan(v.width / 2 - x, v.height / 2 - y); p.store.changed('overlay'); }",
            kind, name, scale,
        )  # fmt: skip
        self.settled()

    def press(self, name: str, kind: str = "body") -> tuple[float, float]:
        """Take hold of a point, and begin to move it; gives where the hand is then."""
        x, y = self.spot(name, kind)
        mouse = self.page.mouse
        mouse.move(x, y)
        mouse.down()
        # The first pixels only tell that it is a drag.
        mouse.move(x + 4.0, y)
        self.until("p => p.hand.gripped || p.store.refusal")
        return x + 4.0, y

    def to(self, x: float, y: float) -> None:
        """Move the hand, and wait until what follows is drawn as it is true."""
        self.page.mouse.move(x, y)
        self.until(
            "p => p.pending === 0 && p.hand.inFlight === 0 && !p.hand.wish && p.store.held"
            " && p.store.held.amount !== null"
        )

    def release(self) -> None:
        """Let go, and wait for what becomes of it."""
        self.page.mouse.up()
        self.settled()

    def pull(self, name: str, pixels: float, kind: str = "body") -> None:
        """Drag a point across, and let go."""
        x, y = self.press(name, kind)
        self.to(x + pixels, y)
        self.release()

    def shows_what_is_published(self) -> bool:
        """Tell whether every curve and point of the page is that of the hull, to the bit."""
        shapes, state = self.hull.shapes(), self.hull.state
        shown = self.ask(
            "p => [p.store.state, [...p.store.curves].map(([id, c]) => [id, [...c.xyz],"
            " [...c.leave], [...c.arrive]]), [...p.store.places].map(([row, at]) => [row, ...at])]"
        )
        curves, single = {each[0]: each[1:] for each in shown[1]}, shapes.spline.single()
        same = shown[0] == self.hull.state_number and sorted(curves) == shapes.curves.tolist()
        for number, spline in zip(shapes.curves.tolist(), single, strict=True):
            xyz, leave, arrive = (np.array(each) for each in curves[number])
            same &= np.array_equal(xyz, spline.xyz.ravel())
            same &= np.array_equal(leave, spline.leave.ravel().astype(np.float32))
            same &= np.array_equal(arrive, spline.arrive.ravel().astype(np.float32))
        places = np.array(sorted(shown[2]))
        rows = state.live("rows")
        return bool(
            same
            and np.array_equal(places[:, 0], rows)
            and np.array_equal(places[:, 1:], state.rows.xyz[rows])
        )


Open = Callable[..., Hand]


@pytest.fixture
def open_page(browser: Browser) -> Iterator[Open]:
    """Open pages of hulls; at the end none has said a word on its console, nor asked elsewhere."""
    ends = list[Callable[[], None]]()
    said = list[str]()

    def look(context: BrowserContext, server: PageServer, at: str, before: str) -> Page:
        page = context.new_page()
        page.add_init_script(before)
        page.set_default_timeout(SLOW)
        page.on("console", lambda message: said.append(message.text))
        page.on("pageerror", lambda error: said.append(str(error)))
        page.on(
            "request",
            lambda asked: said.append(asked.url) if not asked.url.startswith(at) else None,
        )
        page.goto(server.address)
        page.wait_for_selector(READY)
        return page

    def give(
        hull: ah.Hull | None = None, *, server: PageServer | None = None, author: str = "anna",
        strict: bool = False, before: str = "", **looks: Any,
    ) -> Hand:  # fmt: skip
        if server is None:
            assert hull is not None
            server = PageServer(hull, author=author).__enter__()
            ends.append(lambda: server.__exit__(None, None, None))
        usual = {"viewport": {"width": 1440, "height": 840}, "bypass_csp": not strict}
        context = browser.new_context(**{**usual, **looks})
        ends.append(context.close)
        hand = Hand(look(context, server, server.address.partition("#")[0], before), server)
        if not strict:
            hand.settled()
        return hand

    yield give
    for end in reversed(ends):
        end()
    assert said == []


@pytest.fixture
def hull(fresh_series60_70: ah.Hull) -> ah.Hull:
    """Series 60, to be edited at will."""
    return fresh_series60_70
