"""The palette: what can be done is found by its words."""

from playwright.sync_api import expect

import assoc_hull as ah
from tests.browser.conftest import Open


def test_actions_and_names_are_found_by_a_few_letters(open_page: Open, hull: ah.Hull) -> None:
    """Enter does the first that fits; Esc closes it; what nothing is called is said."""
    hand = open_page(hull)
    keys = hand.page.keyboard
    hand.ask("p => p.views.body.upper.focus()")
    keys.press("Control+k")
    box = hand.page.get_by_role("dialog", name="What to do")
    keys.type("hydrost")
    expect(box.get_by_role("option").first).to_contain_text("Hydrostatics", use_inner_text=True)
    keys.press("Enter")
    hand.page.locator("details:has(h2:text-is('Hydrostatics')) table").wait_for()
    assert box.count() == 0
    keys.press("Control+k")
    keys.type("wl 0.625 x st 16")
    keys.press("Enter")
    name = "p => p.store.net.points.get(p.store.selection.row)?.name"
    assert hand.ask(name) == "WL 0.625 x ST 16"
    keys.press(":")
    keys.type("zzz")
    box.get_by_text("Nothing is called so").wait_for()
    keys.press("Escape")
    box.wait_for(state="detached")
    assert hull.history == ()
