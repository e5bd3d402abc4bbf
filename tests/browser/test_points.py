"""What is done to one point by a key: it is inserted, bends its line, is pinned, and goes."""

import assoc_hull as ah
from tests.browser.conftest import Hand, Open

CROSSING = "WL 0.75 x ST 16"


def act(hand: Hand, name: str, key: str, edits: int) -> None:
    """Choose a point, press a key in the drawing, make what is shown, and wait for the edit."""
    hand.ask("(p, name) => { p.find(name); p.activeView().upper.focus(); }", name)
    hand.page.keyboard.press(key)
    if key != "Shift+L":  # to pin a point moves nothing
        hand.page.locator("aside").get_by_text("Enter applies").wait_for()
        hand.page.keyboard.press("Enter")
    hand.until("(p, n) => p.store.history.edits === n && p.hand.free", edits)
    hand.settled()
    assert hand.shows_what_is_published()


def inserted(hand: Hand, hull: ah.Hull) -> str:
    """Insert a pinned point into ST 16 by a click on it; gives its name."""
    hand.ask("p => { p.toggleTool('pinned'); p.find('ST 16'); }")
    hand.near(CROSSING)
    hand.page.keyboard.press("i")
    x, _, z = hull.points[CROSSING].position
    z -= 0.3  # a place of the line that no other line passes
    at = hand.ask(
        "(p, place) => { const v = p.views.body, b = v.upper.getBoundingClientRect(), [x, y] ="
        " v.atPlace(place); return [b.left + x, b.top + y]; }",
        [x, hull.half_breadth(x, z), z],
    )
    hand.page.mouse.click(*at)
    hand.page.get_by_role("button", name="Apply").first.click()
    hand.until("p => p.store.history.edits === 1 && p.hand.free")
    hand.settled()
    name: str = hand.ask("p => [...p.store.net.points.values()].find(q => q.sort === 1).name")
    return name


def test_a_point_is_inserted_pinned_and_deleted(open_page: Open, hull: ah.Hull) -> None:
    """One step each, signed; undone, all of them leave the hull as it came, to the bit."""
    hand, before = open_page(hull), hull.fingerprint
    name = inserted(hand, hull)
    assert hull.points[name].sort == "placed"
    act(hand, name, "Shift+L", 2)
    chosen = "p => p.store.net.points.get(p.store.selection.row).name"
    assert hull.points[hand.ask(chosen)].sort == "adopted"  # it has another name, and stays chosen
    act(hand, hand.ask(chosen), "Shift+L", 3)
    assert hand.ask(chosen) == name
    act(hand, name, "Delete", 4)
    assert [q for q in hull.lines["ST 16"].curves[0].points if q.sort == "placed"] == []
    assert {step.author for step in hull.history} == {"anna"}
    for edits in (3, 2, 1, 0):
        hand.page.keyboard.press("Control+z")
        hand.until("(p, n) => p.store.history.edits === n && p.hand.free", edits)
    assert hull.fingerprint == before


def test_a_line_bends_at_a_point_and_is_smooth_again(open_page: Open, hull: ah.Hull) -> None:
    """On the chosen line alone; the panel says how it passes, and what cannot be is refused."""
    hand, before = open_page(hull), hull.fingerprint
    act(hand, CROSSING, "n", 1)
    panel = hand.page.locator("details:has(h2:text-is('Point'))")
    panel.get_by_text("knuckle on ST 16").wait_for()
    assert "WL 0.75" not in panel.get_by_text("knuckle on").inner_text().partition("knuckle")[0]
    act(hand, CROSSING, "Shift+N", 2)
    panel.get_by_text("smooth", exact=True).wait_for()
    assert hull.fingerprint == before
    act(hand, CROSSING, "Shift+T", 3)
    panel.get_by_text("tangent on ST 16").wait_for()
    hand.ask("(p, name) => p.find(name)", CROSSING)
    assert panel.get_by_role("button", name="Delete").is_disabled()  # it goes with its line only


def test_a_role_is_changed_and_given_back_to_the_rule(open_page: Open, hull: ah.Hull) -> None:
    """By the panel of the point; what defines a line is redrawn at once."""
    hand = open_page(hull)
    hand.ask("(p, name) => p.find(name)", CROSSING)
    choice = hand.page.get_by_label("role of the point")
    choice.select_option("4")
    hand.until("p => p.store.history.edits === 1")
    assert hull.points[CROSSING].crossing_role == "watched"
    assert hand.shows_what_is_published()
    hand.page.get_by_label("role of the point").select_option("0")
    hand.until("p => p.store.history.edits === 2")
    assert hull.points[CROSSING].crossing_role == "shared"
    assert hand.shows_what_is_published()
