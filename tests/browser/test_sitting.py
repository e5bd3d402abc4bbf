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
