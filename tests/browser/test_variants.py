"""Named parameters on the page: a variant is looked at first, then made as one edit."""

import assoc_hull as ah
from tests.browser.conftest import Open

VARY = "details:has(h2:text-is('Vary'))"


def test_a_variant_is_a_ghost_until_it_is_applied(open_page: Open, hull: ah.Hull) -> None:
    """Esc removes it; applied, it is one signed step; a refusal stands at the field."""
    page = open_page(hull).page
    box, before = page.locator(VARY), hull.fingerprint
    box.locator("summary").click()
    box.get_by_text("List the parameters").click()
    box.locator("select").select_option("breadth")
    field, words = box.locator("input"), box.locator("[role=status]")
    field.fill(f"{hull.particulars.breadth + 0.2:.3f}")
    field.press("Enter")
    words.get_by_text("Nothing is changed yet").wait_for()
    ghost = page.evaluate(
        "[...document.querySelector('.page').fairing.store.ghost.curves].map(([id, c]) => [id,"
        " [...c.xyz]])"
    )
    assert len(ghost) > 20
    assert hull.fingerprint == before
    page.evaluate("document.querySelector('.page').fairing.views.body.upper.focus()")
    page.keyboard.press("Escape")
    assert page.evaluate("document.querySelector('.page').fairing.store.ghost === null")
    field.fill("-3")
    box.get_by_text("Apply").click()
    words.get_by_text("breadth").wait_for()
    assert hull.fingerprint == before
    wanted = round(hull.particulars.breadth + 0.2, 3)
    field.fill(f"{wanted:.3f}")
    box.get_by_text("Apply").click()
    words.get_by_text("can be varied").wait_for()
    assert abs(hull.particulars.breadth - wanted) < 1e-6
    assert [step.author for step in hull.history] == ["anna"]
    for number, flat in ghost:  # what was shown is what was made, to the bit
        assert flat == hull.state.spline(number).xyz.ravel().tolist()
    assert f"B {wanted:.2f}" in page.locator(".dims").inner_text()
