"""Fairing on the page: waviest lines, a window by a slider, fair answers, lines that are led."""

import threading
import time
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Browser, Locator, expect

import assoc_hull as ah
from assoc_hull.page import PageServer
from tests.browser.conftest import READY, Hand, Open
from tests.browser.test_panels import POINT, opened

CALLED = "WL 1.08 x ST 19.75"


def choose(hand: Hand, name: str) -> None:
    """Choose a point by its name."""
    hand.ask("(p, name) => p.find(name)", name)


def test_a_window_is_faired_as_its_ghost_showed(open_page: Open, hull: ah.Hull) -> None:
    """A line of the list is gone to; the slider shows, Esc gives up, Apply is one signed step."""
    hand = open_page(hull)
    before, box = hull.fingerprint, opened(hand, "Fair")
    box.get_by_text("List the waviest lines").click()
    box.get_by_role("button", name=CALLED).first.click()
    assert hand.ask("p => p.store.net.points.get(p.store.selection.row).name") == CALLED
    choose(hand, POINT)
    box.locator("input[type=range]").fill("17")
    expect(box).to_contain_text("waviness of 5.0 mm", use_inner_text=True)  # a round figure
    box.get_by_text("Nothing is changed yet").wait_for()
    shown = hand.ask("p => [...p.store.ghost.curves.keys()]")
    expect(box).to_contain_text(POINT, use_inner_text=True)
    assert hull.fingerprint == before
    hand.page.keyboard.press("Escape")
    assert hand.ask("p => p.store.ghost === null")
    expect(box.get_by_role("button", name="Apply")).to_be_disabled()  # drawn a frame later
    box.get_by_role("button", name="Preview").click()
    box.get_by_text("Nothing is changed yet").wait_for()
    places = hand.ask("p => [...p.store.ghost.curves].map(([id, c]) => [id, ...c.xyz])")
    box.get_by_role("button", name="Apply").click()
    box.get_by_text("The window is faired").wait_for()
    assert [step.author for step in hull.history] == ["anna"]
    assert sorted(each[0] for each in places) == sorted(shown)
    for number, *flat in places:  # to first order, as a hand at a slider sees it
        now = hull.state.spline(number).xyz
        if len(flat) == now.size:
            assert np.abs(np.reshape(flat, (-1, 3)) - now).max() < 0.05


def test_a_pull_that_is_answered_fairly_is_shown_before_it_is_made(
    open_page: Open, hull: ah.Hull
) -> None:
    """Letting go shows the ghost and its cost; Enter makes it, as the library would."""
    hand = open_page(hull)
    hand.ask("p => p.toggleTool('fair')")
    before = hull.fingerprint
    hand.near(POINT)
    hand.pull(POINT, 8.0)
    box = hand.page.locator("details:has(h2:text-is('Proposal'))")
    box.get_by_text("Nothing is changed yet").wait_for()
    assert hull.fingerprint == before
    expect(box).to_contain_text("m³", use_inner_text=True)
    hand.page.keyboard.press("Enter")
    hand.until("p => p.store.history.edits === 1")
    assert "answered fairly" in hull.history[-1].name
    assert hand.shows_what_is_published()
    hand.page.keyboard.press("Control+z")
    hand.until("p => p.store.history.edits === 0")
    assert hull.fingerprint == before


def place_beside(hand: Hand, off: float) -> None:
    """Insert a point beside ST 16, so many metres outward, by a click."""
    choose(hand, "ST 16")
    hand.near(POINT)
    x, y = hand.spot(POINT)
    hand.page.get_by_role("button", name="Insert a point").click()
    hand.page.mouse.click(x + 400.0 * off, y + 150.0)


@pytest.mark.parametrize("pinned", [False, True], ids=["led", "pinned"])
def test_a_point_inserted_off_its_line_leads_it(
    open_page: Open, hull: ah.Hull, *, pinned: bool
) -> None:
    """Led, the hull around follows; pinned, the line bends alone; both are shown first."""
    hand = open_page(hull)
    if pinned:
        hand.ask("p => p.toggleTool('pinned')")
    before = hull.fingerprint
    place_beside(hand, 0.02)
    box = hand.page.locator("details:has(h2:text-is('Proposal'))")
    box.get_by_text("Nothing is changed yet").wait_for()
    assert hull.fingerprint == before
    assert hand.ask("p => p.store.ghost.curves.size") > 0
    box.get_by_role("button", name="Apply").click()
    hand.until("p => p.store.history.edits === 1")
    assert bool(hull.history[-1].led) != pinned
    assert hull.history[-1].author == "anna"


def test_a_placed_point_that_is_dragged_leads_its_line(open_page: Open, hull: ah.Hull) -> None:
    """While the pointer is down it is pinned; let go, the lead is a ghost; Esc gives it up."""
    with hull.edit("place") as edit:
        y = hull.half_breadth(97.536, 3.9)
        point = edit.insert("ST 16", (97.536, y, 3.9), lead=False)
    name = point.name
    hand = open_page(hull)
    before = hull.fingerprint
    hand.ask("p => p.use('move')")
    hand.near(name)
    hand.pull(name, 8.0)
    box = hand.page.locator("details:has(h2:text-is('Proposal'))")
    box.get_by_text("Nothing is changed yet").wait_for()
    assert hull.fingerprint == before
    hand.page.keyboard.press("Escape")
    box.wait_for(state="hidden")
    assert hull.fingerprint == before
    hand.pull(name, 8.0)
    box.get_by_text("Nothing is changed yet").wait_for()
    hand.page.keyboard.press("Enter")
    hand.until("p => p.store.history.edits === 2")
    assert hull.history[-1].led


def test_a_wavy_line_is_listed_with_what_its_batten_does_where_it_leads(
    open_page: Open, hull: ah.Hull
) -> None:
    """The figure of a row is that of its place; a list of before an edit is old."""
    hand = open_page(hull)
    box = hand.page.locator("details:has(h2:text-is('Fair'))")
    box.locator("summary").click()
    box.get_by_role("button", name="List the waviest lines").click()
    row = box.locator("tbody tr").first
    row.wait_for()
    found = hull.fairness()
    place = found.unfair[0]
    springs = f"{1e3 * place.residual:+.1f}".replace("-", "−")
    expect(row.locator("th, td").nth(0)).to_have_text(place.line)
    expect(row.locator("th, td").nth(1)).to_have_text(springs)
    away = place.residual - place.expected
    words = f"a {'hollow' if away > 0.0 else 'hump'} of {1e3 * abs(away):.1f} mm"
    heads = hand.page.evaluate(
        "() => [...document.querySelectorAll('aside th')].slice(1)"
        ".map(each => parseFloat(getComputedStyle(each).paddingLeft))"
    )
    assert min(heads) >= 4.0, "heads of narrow columns do not run together"
    lines = box.locator("tbody td:first-child")
    assert all(each["height"] < 30.0 for each in map(Locator.bounding_box, lines.all()) if each)
    assert box.locator("table").evaluate(
        "each => each.scrollWidth <= each.parentElement.clientWidth"
    )
    expect(box.get_by_text(f"{place.point} on {place.line}").first).to_contain_text(
        words, use_inner_text=True
    )
    row.get_by_role("button").click()
    assert hand.ask("p => p.store.net.points.get(p.store.selection.row).name") == place.point
    expect(box).not_to_contain_text("list again", use_inner_text=True)
    hand.ask("(p, name) => p.apply('fuller', [{op: 'pull', point: name, d: 0.005}])", place.point)
    box.get_by_text("before the last edit: list again").wait_for()


def test_a_list_that_takes_long_is_stopped_and_the_server_leaves_at_once(
    browser: Browser, hull: ah.Hull, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A button ends it in the server; what is computed then keeps nobody who wants to leave."""
    begun = list[float]()

    def endless(*_: Any) -> Any:
        begun.append(time.monotonic())
        while True:
            time.sleep(0.001)

    monkeypatch.setattr("assoc_hull.page.session.describe_fairness", endless)
    with PageServer(hull, author="anna") as server:
        context = browser.new_context(viewport={"width": 1440, "height": 840}, bypass_csp=True)
        page = context.new_page()
        page.goto(server.address)
        page.wait_for_selector(READY)
        hand = Hand(page, server)
        hand.ask("p => p.panel.open('Fair')")
        box = page.locator("details:has(h2:text-is('Fair'))")
        box.get_by_role("button", name="List the waviest lines").click()
        box.get_by_role("button", name="Stop").click()
        box.get_by_text("Stopped. Nothing is changed.").wait_for()
        assert box.get_by_role("button", name="Stop").count() == 0
        hand.ask("p => p.panel.open('Hydrostatics')")
        page.locator("details:has(h2:text-is('Hydrostatics')) table").wait_for()
        box.get_by_role("button", name="List the waviest lines").click()
        box.get_by_role("button", name="Stop").wait_for()
        assert len(begun) == 2
        begin = time.monotonic()
    assert time.monotonic() - begin < 5.0
    context.close()


def test_a_ghost_that_is_given_up_is_computed_no_longer(
    open_page: Open, hull: ah.Hull, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Esc ends the fair answer in the server, too."""
    ended = threading.Event()

    def endless(*_: Any) -> Any:
        try:
            while True:
                time.sleep(0.001)
        finally:
            ended.set()

    monkeypatch.setattr("assoc_hull.page.session.ghost_of_edits", endless)
    hand = open_page(hull)
    hand.ask("(p, name) => p.panel.proposal.show('pull', [{op: 'pull', point: name, d: 0.01}])",
             POINT)  # fmt: skip
    hand.ask("p => p.activeView().upper.focus()")
    hand.page.locator("aside").get_by_role("button", name="Stop").wait_for()
    hand.page.keyboard.press("Escape")
    assert ended.wait(5.0)
    assert hand.page.locator("aside").get_by_role("button", name="Stop").count() == 0
