"""What a person who fairs a hull in one sitting relies on: nothing is lost, every figure is one."""

import re
from collections.abc import Callable

from playwright.sync_api import Locator, expect

import assoc_hull as ah
from tests.browser.conftest import Hand, Open

POINT = "WL 0.625 x ST 16"


def panel(hand: Hand, title: str) -> Locator:
    """Give a panel."""
    return hand.page.locator(f"details:has(h2:text-is('{title}'))")


def proposed(hand: Hand, key: str) -> str:
    """Press a key that shows an answer before it is made; read it."""
    hand.page.keyboard.press(key)
    hand.until("p => p.panel.proposal.ready")
    hand.settled()
    return panel(hand, "Proposal").inner_text()


def test_an_edit_tells_the_movement_that_its_preview_told(open_page: Open, hull: ah.Hull) -> None:
    """Along the normal, and of lines in their planes where that is more: in one wording."""
    hand = open_page(hull)
    figures = r"[\d.]+ mm along its normal at most(?:, lines up to [\d.]+ mm in their planes)?"
    hand.ask("(p, name) => p.find(name)", POINT)
    before = re.findall(figures, proposed(hand, "n"))
    assert "in their planes" in before[0]
    hand.page.keyboard.press("Enter")
    hand.until("p => p.store.history.edits === 1 && p.store.last")
    expect(panel(hand, "Edit")).to_contain_text(before[0], use_inner_text=True)
    assert re.findall(figures, panel(hand, "Edit").inner_text()) == before


def test_undo_takes_away_what_is_only_shown_before_an_edit(open_page: Open, hull: ah.Hull) -> None:
    """The edit made before a ghost stays, and it is said; the next undo takes that back."""
    hand, keys = open_page(hull), "Control+z"
    hand.ask("(p, name) => p.find(name)", POINT)
    proposed(hand, "n")
    hand.page.keyboard.press("Enter")
    hand.until("p => p.store.history.edits === 1")
    hand.settled()
    made = hull.fingerprint
    proposed(hand, "Shift+n")
    hand.page.keyboard.press(keys)
    hand.until("p => p.store.ghost === null")
    hand.page.get_by_text("The ghost is gone; nothing was made").first.wait_for()
    assert hull.fingerprint == made
    hand.page.keyboard.press(keys)
    hand.until("p => p.store.history.edits === 0")


def test_an_edit_that_is_taken_back_is_no_longer_told(open_page: Open, hull: ah.Hull) -> None:
    """Neither in its panel nor in the line below, which say what was taken back or made again."""
    hand = open_page(hull)
    hand.ask("(p, name) => p.apply('fuller', [{op: 'pull', point: name, d: 0.01}])", POINT)
    hand.until("p => p.store.history.edits === 1 && p.store.last")
    hand.page.get_by_role("button", name="Undo").click()
    hand.page.locator("footer").get_by_text("Taken back: fuller.").wait_for()
    told = panel(hand, "Edit")
    expect(told).to_contain_text("the hull is as it came", use_inner_text=True)
    expect(told).not_to_contain_text("along its normal", use_inner_text=True)
    hand.page.get_by_role("button", name="Redo").click()
    hand.page.locator("footer").get_by_text("Made again: fuller.").wait_for()
    expect(told).not_to_contain_text("taken back", use_inner_text=True)
    expect(told).to_contain_text("fuller", use_inner_text=True)


def test_no_step_is_lost_while_an_edit_is_being_made(open_page: Open, hull: ah.Hull) -> None:
    """Five presses are five millimetres, whenever they fall: of a button, and of an arrow."""
    hand = open_page(hull)
    hand.ask("(p, name) => p.find(name)", POINT)
    more = hand.page.get_by_role("button", name="+1 mm", exact=True)

    def pulled() -> float:
        steps = [re.search(r" by (-?[\d.]+) mm$", each.name) for each in hull.history]
        return sum(float(each[1]) for each in steps if each)

    presses: list[Callable[[], None]] = [more.click, lambda: hand.page.keyboard.press("ArrowUp")]
    for press in presses:
        hand.page.locator(".view-body canvas").last.focus()
        for _ in range(5):
            press()
            hand.ask("p => p.keys.finish()")  # as a pause does: the edit is on its way
        hand.until("p => !p.making && !p.keys.burst && !p.keys.queue.length")
        hand.settled()
        assert round(pulled(), 6) == 5.0
        while hull.history:
            hull.undo(author="anna")
        hand.until("p => p.store.history.edits === 0")


def test_undo_right_after_an_arrow_takes_the_arrow_back(open_page: Open, hull: ah.Hull) -> None:
    """Also while its edit is still open, or being made."""
    hand, before = open_page(hull), hull.fingerprint
    hand.ask("(p, name) => p.find(name)", POINT)
    hand.page.keyboard.press("ArrowUp")
    hand.page.keyboard.press("Control+z")
    hand.page.locator("footer").get_by_text("Taken back: pull").wait_for()
    assert hull.fingerprint == before


def test_keys_act_on_a_page_that_nobody_has_clicked(open_page: Open, hull: ah.Hull) -> None:
    """The first letter acts, and the drawing has the focus then."""
    hand = open_page(hull)
    hand.page.keyboard.press("k")
    assert not hand.ask("p => p.store.show.combs")
    assert hand.ask("p => document.activeElement === p.activeView().upper")


def test_a_line_that_is_found_is_seen_from_end_to_end(open_page: Open, hull: ah.Hull) -> None:
    """Also where the picture showed a part of the hull; stepping on to a line in sight does not."""
    hand = open_page(hull)
    hand.ask("p => p.maximise('half')")
    hand.near(POINT, "half", 60.0)
    hand.page.keyboard.press("Control+k")
    hand.page.keyboard.type("WL 0.5")
    hand.page.keyboard.press("Enter")
    hand.settled()
    seen = hand.ask(
        "p => { const v = p.views.half, c = p.store.curves.get(p.store.selection.curve), seen = [];"
        " for (let i = 0; i < 3 * c.n; i += 3) seen.push(v.atPlace(c.xyz.subarray(i, i + 3)));"
        " return seen.every(([x, y]) => x > 0 && y > 0 && x < v.width && y < v.height); }"
    )
    assert seen
    hand.near(POINT, "half", 60.0)
    before = hand.ask("p => p.views.half.axis")
    hand.page.keyboard.press("}")
    hand.settled()
    assert hand.ask("p => p.views.half.axis") == before


def test_the_answer_to_why_is_short_and_in_sight(open_page: Open, hull: ah.Hull) -> None:
    """Of a buttock that an edit hardly reached: the largest causes, and how many are left."""
    hand = open_page(hull)
    hand.ask(
        "(p, name) => p.apply('fuller', [{op: 'pull', point: name, d: 0.02, radius: [15, 5]}])",
        POINT,
    )  # fmt: skip
    hand.until("p => p.store.history.edits === 1")
    hand.ask("p => p.find('BTK 0.06')")
    hand.page.keyboard.press("w")
    box = hand.page.locator("details:has(h2:text-is('Why'))")
    box.get_by_text("Last moved by step").wait_for()
    hand.settled()
    assert 2 <= box.locator("li button").count() <= 25
    assert box.get_by_text(" more").count() > 0
    first, frame = box.locator("li button").first.bounding_box(), hand.page.viewport_size
    assert first is not None
    assert frame is not None
    assert 0 < first["y"] < frame["height"] - 60


def test_apply_of_a_variation_is_in_sight(open_page: Open, hull: ah.Hull) -> None:
    """Where the list of parameters has come, and where the figures of the ghost have."""
    hand = open_page(hull, viewport={"width": 1200, "height": 640})
    hand.page.keyboard.press("v")
    box = hand.page.locator("details:has(h2:text-is('Vary'))")
    box.get_by_role("button", name="List the parameters").press("Enter")
    box.get_by_text("can be varied").wait_for()
    box.get_by_text("m now; fair from").wait_for()  # its limits come after it
    hand.settled()
    apply = box.get_by_role("button", name="Apply").bounding_box()
    assert apply is not None
    assert apply["y"] + apply["height"] < 614


def test_what_is_said_is_seen_on_a_narrow_screen(open_page: Open, hull: ah.Hull) -> None:
    """The line below the page stays in the picture, wherever the page is scrolled to."""
    hand = open_page(hull, viewport={"width": 390, "height": 844})
    for top in (0, 500):
        hand.page.evaluate("top => scrollTo(0, top)", top)
        box = hand.page.locator("footer").bounding_box()
        assert box is not None
        assert box["y"] > 700
        assert box["y"] + box["height"] <= 844.5


def test_no_factor_of_movement_is_told_where_none_is_drawn(open_page: Open, hull: ah.Hull) -> None:
    """Of an edit that one view cannot show."""
    hand = open_page(hull)
    hand.ask(
        "p => { const wanted = p.store.curves, none = new Map([...wanted].slice(0, 3));"
        " p.store.ghost = {curves: none, places: new Map()}; p.store.changed('overlay'); }"
    )
    hand.settled()
    for kind in ("body", "profile", "half"):
        expect(hand.page.locator(f".view-{kind} .note")).to_have_text("")
