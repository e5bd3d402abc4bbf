"""What a person who fairs a hull in one sitting relies on: nothing is lost, every figure is one."""

import re

import assoc_hull as ah
from tests.browser.conftest import Hand, Open

POINT = "WL 0.625 x ST 16"


def panel(hand: Hand, title: str) -> str:
    """Read a panel."""
    return hand.page.locator(f"details:has(h2:text-is('{title}'))").inner_text()


def proposed(hand: Hand, key: str) -> str:
    """Press a key that shows an answer before it is made; read it."""
    hand.page.keyboard.press(key)
    hand.until("p => p.panel.proposal.ready")
    hand.settled()
    return panel(hand, "Proposal")


def test_an_edit_tells_the_movement_that_its_preview_told(open_page: Open, hull: ah.Hull) -> None:
    """Of the points, and of the lines between them where that is more: under the same words."""
    hand, figures = open_page(hull), r"[\d.]+ mm off the hull(?:, [\d.]+ mm between points)?"
    hand.ask("(p, name) => p.find(name)", POINT)
    before = re.findall(figures, proposed(hand, "n"))
    assert "between points" in before[0]
    hand.page.keyboard.press("Enter")
    hand.until("p => p.store.history.edits === 1 && p.store.last")
    hand.settled()
    assert re.findall(figures, panel(hand, "Edit")) == before


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
    hand.page.get_by_text("The ghost is taken away; nothing was made of it").first.wait_for()
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
    assert "the hull is as it came" in told
    assert "off the hull" not in told
    hand.page.get_by_role("button", name="Redo").click()
    hand.page.locator("footer").get_by_text("Made again: fuller.").wait_for()
    assert "taken back" not in panel(hand, "Edit")


def test_no_step_is_lost_while_an_edit_is_being_made(open_page: Open, hull: ah.Hull) -> None:
    """Five presses are five millimetres, whenever they fall: of a button, and of an arrow."""
    hand = open_page(hull)
    hand.ask("(p, name) => p.find(name)", POINT)
    more = hand.page.get_by_role("button", name="+1 mm", exact=True)

    def pulled() -> float:
        steps = [re.search(r" by (-?[\d.]+) mm$", each.name) for each in hull.history]
        return sum(float(each[1]) for each in steps if each)

    for press in (more.click, lambda: hand.page.keyboard.press("ArrowUp")):
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
