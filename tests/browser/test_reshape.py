"""Re-shaping a stretch of a line by places that are clicked: shown, shown fairly, then made."""

import pytest

import assoc_hull as ah
from tests.browser.conftest import Hand, Open
from tests.browser.test_panels import POINT


def begun(hand: Hand) -> tuple[float, float]:
    """Choose ST 16, begin to re-shape it, and give one place 20 mm outside it."""
    hand.ask("p => p.find('ST 16')")
    hand.near(POINT)
    x, y = hand.spot(POINT)
    hand.page.keyboard.press("r")
    hand.page.mouse.click(x + 8.0, y)
    box = hand.page.locator("details:has(h2:text-is('Proposal'))")
    box.get_by_text("click more places").wait_for()
    return x + 8.0, y


@pytest.mark.parametrize("fair", [True, False], ids=["fair", "plain"])
def test_a_line_is_reshaped_through_places_that_are_clicked(
    open_page: Open, hull: ah.Hull, *, fair: bool
) -> None:
    """Nothing is made before the answer was seen; Enter makes one step, which passes the place."""
    hand = open_page(hull)
    if not fair:
        hand.ask("p => p.toggleTool('fairShapes')")
    before = hull.fingerprint
    x, y = begun(hand)
    assert hand.ask("p => p.store.ghost.curves.size") > 0
    hand.page.mouse.move(x, y)
    hand.page.mouse.down()
    hand.page.mouse.move(x + 6.0, y)
    hand.page.mouse.up()
    places = hand.ask("p => p.store.shaping.places")
    assert len(places) == 1  # it was dragged, not doubled
    hand.page.keyboard.press("Enter")
    box = hand.page.locator("details:has(h2:text-is('Proposal'))")
    box.get_by_text("Enter applies").wait_for()
    assert hull.fingerprint == before
    hand.page.keyboard.press("Enter")
    hand.until("p => p.store.history.edits === 1")
    assert hull.history[-1].author == "anna"
    assert "re-shape ST 16 through 1 place" in hull.history[-1].name
    (place,) = places
    assert abs(hull.half_breadth(place[0], place[2]) - place[1]) < 2e-3
    hand.page.keyboard.press("Control+z")
    hand.until("p => p.store.history.edits === 0")
    assert hull.fingerprint == before


def test_a_reshape_is_given_up_by_escape_and_its_last_place_by_backspace(
    open_page: Open, hull: ah.Hull
) -> None:
    """The ghost goes with it, and the hull stays."""
    hand = open_page(hull)
    before = hull.fingerprint
    x, y = begun(hand)
    hand.page.mouse.click(x, y - 120.0)
    assert hand.ask("p => p.store.shaping.places.length") == 2
    hand.page.keyboard.press("Backspace")
    assert hand.ask("p => p.store.shaping.places.length") == 1
    hand.page.keyboard.press("Escape")
    assert hand.ask("p => p.store.shaping === null && p.store.ghost === null")
    assert hull.fingerprint == before


def test_a_place_beside_a_crossing_is_taken_as_on_it(open_page: Open, hull: ah.Hull) -> None:
    """A click on a point of the line gives no second point a hair from it; the answer is taken."""
    hand = open_page(hull)
    begun(hand)
    (place,) = hand.ask("p => p.store.shaping.places")
    assert place[2] == hand.ask("(p, n) => p.store.places.get(p.store.net.find(n))[2]", POINT)


def test_arrows_shape_a_line_without_a_mouse(open_page: Open, hull: ah.Hull) -> None:
    """The chosen point is the first place; no edit is made, and Ctrl+Z takes back the place."""
    hand = open_page(hull)
    hand.ask("(p, name) => p.find(name)", POINT)
    keyboard = hand.page.keyboard
    keyboard.press("r")
    for _ in range(3):
        keyboard.press("Shift+ArrowLeft")
    hand.page.locator("aside").get_by_text("click more places").wait_for()
    places = hand.ask("p => p.store.shaping.places")
    y = hand.ask("(p, n) => p.store.places.get(p.store.net.find(n))[1]", POINT)
    assert places[0][1] == pytest.approx(y - 0.03)
    keyboard.press("Control+z")
    assert hand.ask("p => p.store.shaping.places.length") == 0
    keyboard.press("Escape")
    assert hand.ask("p => p.store.shaping") is None
    assert hull.history == ()
