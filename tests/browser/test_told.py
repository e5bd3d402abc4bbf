"""What panels tell of an edit, while it is made, taken back and made again."""

import re

import pytest
from playwright.sync_api import Locator, expect

import assoc_hull as ah
from tests.browser.conftest import Hand, Open

POINT = "WL 0.625 x ST 16"
PULL = [{"op": "pull", "point": POINT, "d": 0.01, "radius": [15.2, 6.1]}]


def part(hand: Hand, title: str) -> Locator:
    """A part of the panel, opened."""
    hand.ask("(p, title) => p.panel.open(title)", title)
    return hand.page.locator(f"aside details:has(h2:text-is('{title}'))")


def edit(hand: Hand, name: str = "fuller") -> None:
    """Make an edit, and wait until it is told."""
    hand.ask("(p, name, ops) => p.apply(name, ops)", name, PULL)
    hand.until("p => p.store.history.edits === 1")
    hand.settled()


def test_history_tells_an_undo_that_is_made_while_something_is_pressed(
    open_page: Open, hull: ah.Hull
) -> None:
    """A button that is never let go holds nothing back, nor do a list, a menu or a scroll bar."""
    hand = open_page(hull)
    box = part(hand, "History")
    edit(hand)
    expect(box.locator("li[aria-current] .now")).to_have_text("fuller")
    box.get_by_text("Keep under this name").hover()
    hand.page.mouse.down()
    hand.ask("p => p.activeView().upper.focus()")
    hand.page.keyboard.press("Control+z")
    expect(box.locator("li[aria-current] .now")).to_have_text("the hull as it came")
    # Earlier tests of this hull may have left steps of that name on branches: the last is first.
    expect(box.locator("li", has_text="fuller").first).to_contain_text("taken back")
    hand.page.mouse.up()
    for press in ({"button": "right"}, {}):
        # The browser may keep for itself that these are let go.
        at = box.get_by_text("Keep under this name") if press else box.locator("ol")
        at.dispatch_event("pointerdown", {"button": 2 if press else 0, "buttons": 1})
        hand.ask("p => p.history ? 0 : p.redo()" if press else "p => p.undo()")
        wanted = "fuller" if press else "the hull as it came"
        expect(box.locator("li[aria-current] .now")).to_have_text(wanted)


def test_what_fair_tells_of_its_edit_follows_undo_and_redo(open_page: Open, hull: ah.Hull) -> None:
    """One edit; taken back; one edit again; nothing once another edit has followed."""
    hand = open_page(hull)
    hand.ask("(p, name) => p.find(name)", POINT)
    box = part(hand, "Fair")
    words = box.locator("[role=status]")
    box.get_by_role("button", name="Preview").click()
    hand.until("p => p.panel.fair.ready")
    box.get_by_role("button", name="Apply").click()
    expect(words).to_contain_text("one edit")
    hand.ask("p => p.undo()")
    expect(words).to_have_text(re.compile("^Taken back: fair around .*Redo makes it again"))
    hand.ask("p => p.redo()")
    expect(words).to_contain_text("one edit")
    hand.ask("(p, ops) => p.apply('another', ops)", PULL)
    expect(words).to_have_text("")


@pytest.mark.parametrize("noise", ["2.0 mm", "20.0 mm"])
def test_a_fair_preview_tells_the_movement_that_its_edit_tells(
    open_page: Open, hull: ah.Hull, noise: str
) -> None:
    """One figure, one rounding: along its normal, and of lines in their planes."""
    hand = open_page(hull)
    hand.ask("(p, name) => p.find(name)", "WL 0.35 x ST 17")
    box = part(hand, "Fair")
    slider = box.locator("input[type=range]")
    slider.focus()
    hand.page.keyboard.press("Home")
    while slider.get_attribute("aria-valuetext") != noise:
        before = slider.get_attribute("aria-valuetext")
        hand.page.keyboard.press("ArrowRight")
        expect(slider).not_to_have_attribute("aria-valuetext", before or "")
    box.get_by_role("button", name="Preview").click()
    hand.until("p => p.panel.fair.ready")
    shown = re.search(r"hull moves (.*?), volume", box.locator("[role=status]").inner_text())
    assert shown is not None
    assert shown[1].endswith("in their planes")
    box.get_by_role("button", name="Apply").click()
    expect(part(hand, "Edit").locator("dd", has_text="along its normal")).to_have_text(shown[1])


def test_values_under_vary_are_those_of_the_hull_also_after_an_undo(
    open_page: Open, hull: ah.Hull
) -> None:
    """What is now is told anew; what was typed meanwhile stays."""
    hand = open_page(hull)
    box = part(hand, "Vary")
    box.get_by_text("List the parameters").click()
    box.locator("select").select_option("breadth")
    field, about = box.locator("input[inputmode]"), box.locator("p", has_text=" now; ")
    expect(about).to_contain_text("17.417 m now")
    field.fill("17.6")
    box.get_by_role("button", name="Apply").click()
    expect(about).to_contain_text("17.600 m now")
    hand.ask("p => p.undo()")
    expect(about).to_contain_text("17.417 m now")
    expect(field).to_have_value("17.417")
    expect(box.locator("[role=status]")).to_contain_text("Taken back")
    field.fill("17.5")
    hand.ask("p => p.redo()")
    expect(about).to_contain_text("17.600 m now")
    expect(field).to_have_value("17.5")


def test_a_point_of_the_given_lines_is_named_as_a_person_says_it(
    open_page: Open, hull: ah.Hull
) -> None:
    """In the panel, in what is told of an edit, in its undo; and it is found by that name."""
    hand = open_page(hull)
    name = next(each.name for each in hull.points.values() if " @ adopted " in each.name)
    line, _, number = name.partition(" @ adopted ")
    said = f"given point {number} of {line}"
    hand.ask("(p, said) => p.find(said)", said)
    assert hand.ask("p => p.store.net.points.get(p.store.selection.row).name") == name
    expect(part(hand, "Point").locator("dd").first).to_have_text(said)
    expect(hand.page.locator("footer")).to_contain_text(said)
    edit(hand, f"pull {name} by 10.0 mm")
    expect(part(hand, "Edit").locator("dd").first).to_have_text(f"pull {said} by 10.0 mm")
    expect(part(hand, "History").locator(".now")).to_have_text(f"pull {said} by 10.0 mm")
    hand.ask("p => p.undo()")
    expect(part(hand, "Edit")).to_contain_text(f"pull {said}")
    assert " @ " not in hand.page.locator("aside").inner_text()


@pytest.mark.parametrize("after", ["Enter", "Tab"])
def test_a_point_that_cannot_be_moved_says_why_however_fast_the_key_is_let_go(
    open_page: Open, hull: ah.Hull, after: str
) -> None:
    """It names what drives the point, and what can be done here; no call of the library."""
    hand = open_page(hull)
    hand.ask("p => { p.find('ST 0 x profile'); p.use('move'); }")
    hand.page.keyboard.press("ArrowUp")
    hand.page.keyboard.press(after)
    bubble = hand.page.locator(".bubble")
    expect(bubble).to_contain_text("computed from profile")
    expect(bubble).to_contain_text("choose the role “shared”")
    expect(bubble).not_to_contain_text("edit.")
    words = hand.ask(
        "p => p.store.net.wayWords(p.store.net.points.get(p.store.net.find('ST 0 x profile')))"
    )
    assert words == "computed, on the profile: move a point of profile"


def test_a_typed_pull_that_goes_too_far_tells_that_a_wider_radius_helps(
    open_page: Open, hull: ah.Hull
) -> None:
    """As the one of the hand does; and while it is made, that it is being made."""
    hand = open_page(hull)
    hand.ask("(p, name) => { p.find(name); p.panel.acts.focus(); }", POINT)
    hand.page.keyboard.type("900")
    hand.page.keyboard.press("Enter")
    expect(hand.page.locator(".bubble")).to_contain_text("Pull less, or widen the radius")
    expect(hand.page.locator("footer")).not_to_contain_text("being made")
    assert not hull.history


def test_escape_takes_a_refused_drag_and_its_reason_away(open_page: Open, hull: ah.Hull) -> None:
    """Once is enough; what was refused is not asked any more."""
    hand = open_page(hull)
    x, y = hand.press(POINT)
    hand.page.mouse.move(x + 60.0, y)
    bubble = hand.page.locator(".bubble")
    expect(bubble).to_be_visible()
    expect(bubble).not_to_contain_text("50 mm is 0.05")
    hand.until("p => p.hand.inFlight === 0")
    hand.page.keyboard.press("Escape")
    expect(bubble).to_have_count(0)
    hand.page.mouse.up()
    hand.settled()
    assert not hull.history


def test_a_screen_that_is_touched_tells_of_fingers(open_page: Open, hull: ah.Hull) -> None:
    """There is no wheel and no key on it."""
    hand = open_page(hull, viewport={"width": 390, "height": 844}, has_touch=True, is_mobile=True)
    foot = hand.page.locator("footer")
    expect(foot).to_contain_text("two fingers zoom")
    hand.ask("(p, name) => p.store.select(p.store.net.find(name), null)", POINT)
    expect(foot).to_contain_text("press −1 mm and +1 mm")
    expect(foot).not_to_contain_text("arrows")


def test_combs_without_a_line_say_what_they_stand_on(open_page: Open, hull: ah.Hull) -> None:
    """The key does nothing that can be seen as long as no line is chosen."""
    hand = open_page(hull)
    for _ in range(2):  # off, and on again
        hand.page.keyboard.press("k")
    expect(hand.page.locator("footer")).to_contain_text("Combs stand on the chosen line")
