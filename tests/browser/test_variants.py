"""Named parameters on the page: a variant is looked at first, then made as one edit."""

import time
from typing import Any

import pytest
from playwright.sync_api import Locator, expect

import assoc_hull as ah
from assoc_hull.edit.document import STOPPED
from assoc_hull.variation.plan_choice import choose_plan
from tests.browser.conftest import Hand, Open

VARY = "details:has(h2:text-is('Vary'))"


def test_a_variant_is_a_ghost_until_it_is_applied(open_page: Open, hull: ah.Hull) -> None:
    """Esc removes it; applied, it is one signed step; a refusal stands at the field."""
    page = open_page(hull).page
    box, before = page.locator(VARY), hull.fingerprint
    box.locator("summary").click()
    box.get_by_text("List the parameters").click()
    box.locator("select").select_option("breadth")
    field, words = box.locator("input[inputmode]"), box.locator("[role=status]")
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
    words.get_by_text("The hull is varied: one edit.").wait_for()
    assert abs(hull.particulars.breadth - wanted) < 1e-6
    assert [step.author for step in hull.history] == ["anna"]
    for number, flat in ghost:  # what was shown is what was made, to the bit
        assert flat == hull.state.spline(number).xyz.ravel().tolist()
    expect(page.locator(".dims")).to_contain_text(f"B {wanted:.2f}", use_inner_text=True)


def listed(hand: Hand, parameter: str) -> Locator:
    """Open the panel, and choose a parameter; its limits are told."""
    box = hand.page.locator(VARY)
    box.locator("summary").click()
    box.get_by_text("List the parameters").click()
    box.locator("select").select_option(parameter)
    hand.until("p => /possible/.test(p.panel.vary.about.textContent)")
    return box


def test_enter_once_more_makes_the_variant_that_is_shown(open_page: Open, hull: ah.Hull) -> None:
    """As of all that is shown before it is made; with another value it is shown anew."""
    hand = open_page(hull)
    field = (box := listed(hand, "breadth")).locator("input[inputmode]")
    for more in (0.1, 0.2):
        field.fill(f"{17.417 + more:.3f}")
        field.press("Enter")
        box.get_by_text("Enter or Apply makes it").wait_for()
        assert not hull.history
    field.press("Enter")
    hand.until("p => p.store.history.edits === 1")
    assert abs(hull.particulars.breadth - 17.617) < 1e-6


def test_values_beyond_what_is_fair_are_asked_on_purpose(open_page: Open, hull: ah.Hull) -> None:
    """Both limits are told; a refusal names the box to tick, and with it the hull is shown."""
    hand = open_page(hull)
    box = listed(hand, "breadth")
    fair, _, possible = box.locator("p").first.inner_text().partition("; possible")
    assert "fair from" in fair
    assert " m" in possible
    field, words = box.locator("input[inputmode]"), box.locator("[role=status]")
    field.fill("90")
    field.press("Enter")
    words.get_by_text("by “also unfair”").wait_for()
    expect(words).not_to_contain_text("accept", use_inner_text=True)
    box.get_by_label("also unfair").check()
    field.press("Enter")
    words.get_by_text("Nothing is changed yet").wait_for()


def test_a_variant_that_is_being_made_is_stopped(
    open_page: Open, hull: ah.Hull, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By a button beside what is said; the hull is as it was, and the next one is made."""
    before = hull.fingerprint

    def slow(*given: Any) -> Any:
        deadline = time.monotonic() + 20.0
        while not STOPPED.get()() and time.monotonic() < deadline:
            time.sleep(0.001)
        return choose_plan(*given)

    hand = open_page(hull)
    box = listed(hand, "breadth")
    box.locator("input[inputmode]").fill("17.6")
    monkeypatch.setattr("assoc_hull.variation.vary.choose_plan", slow)
    box.get_by_role("button", name="Apply").click()
    box.get_by_role("button", name="Stop").click()
    box.get_by_text("it was stopped; nothing is changed").wait_for()
    assert hull.fingerprint == before
    monkeypatch.undo()
    box.get_by_role("button", name="Apply").click()
    hand.until("p => p.store.history.edits === 1 && p.applying === 0")
