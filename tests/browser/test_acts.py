"""What a designer does with mouse alone, or with keys alone: nothing needs the other hand."""

import pytest
from playwright.sync_api import expect

import assoc_hull as ah
from tests.browser.conftest import Hand, Open
from tests.browser.test_panels import POINT, opened


def keys(hand: Hand, *given: str) -> None:
    """Press keys one after another."""
    for each in given:
        hand.page.keyboard.press(each)


def chosen(hand: Hand) -> list[str | None]:
    """The names of the point and the curve that are chosen."""
    found: list[str | None] = hand.ask(
        "p => { const {row, curve} = p.store.selection, {net} = p.store; return [row === null"
        " ? null : net.points.get(row).name, curve === null ? null : net.curveName(curve)]; }"
    )
    return found


def test_keys_alone_pull_make_a_knuckle_and_take_it_away(open_page: Open, hull: ah.Hull) -> None:
    """A name in any spelling; each act is one signed edit, shown before where it is no number."""
    hand = open_page(hull)
    before = hull.fingerprint
    hand.page.get_by_label("Body plan: drawing").focus()
    keys(hand, "/")
    hand.page.keyboard.type("wl 0,6250 X st016")
    keys(hand, "Enter")
    assert chosen(hand) == [POINT, "ST 16"]
    keys(hand, "g")
    hand.page.keyboard.type("-5")
    keys(hand, "Enter")
    hand.until("p => p.store.history.edits === 1")
    assert hull.history[-1].name == f"pull {POINT} by -5 mm"
    keys(hand, "n")
    hand.page.locator("aside").get_by_text("Enter applies").wait_for()
    keys(hand, "Enter")
    hand.until("p => p.store.history.edits === 2")
    # A new kind moves nothing that a frame would tell: the page is told all of the hull.
    hand.until("p => p.store.net.points.get(p.store.selection.row).kind.includes(2)")
    expect(opened(hand, "Why").page.locator("aside")).to_contain_text(
        "knuckle on ST 16", use_inner_text=True
    )
    hand.page.get_by_label("Body plan: drawing").focus()
    keys(hand, "Shift+N")
    hand.page.locator("aside").get_by_text("Enter applies").wait_for()
    keys(hand, "Enter")
    hand.until("p => !p.store.net.points.get(p.store.selection.row).kind.includes(2)")
    for edits in (2, 1, 0):
        keys(hand, "Control+z")
        hand.until("(p, n) => p.store.history.edits === n", edits)
    assert hull.fingerprint == before


def test_the_mouse_alone_chooses_a_line_nudges_and_varies(open_page: Open, hull: ah.Hull) -> None:
    """Presses of a button are one edit; a knuckle is shown, then made; a value grows by steps."""
    hand = open_page(hull)
    hand.page.get_by_label("the chosen line").select_option(label="BTK 0.2")
    assert chosen(hand) == [None, "BTK 0.2"]
    hand.page.mouse.click(*hand.spot(POINT))
    hand.settled()
    # In one go: on a busy machine three clicks may be as far apart as three edits.
    hand.page.get_by_role("button", name="+1 mm", exact=True).click(click_count=3)
    hand.until("p => p.store.history.edits === 1")
    assert hull.history[-1].name == f"pull {POINT} by 3.0 mm"
    hand.page.get_by_role("button", name="Knuckle", exact=True).click()
    proposal = hand.page.locator("details:has(h2:text-is('Proposal'))")
    proposal.get_by_text("Nothing is changed yet").wait_for()
    assert hand.ask("p => p.store.ghost.curves.size") > 0
    proposal.get_by_role("button", name="Apply").click()
    hand.until("p => p.store.history.edits === 2")
    assert hand.ask("p => document.activeElement === p.activeView().upper")
    box = opened(hand, "Vary")
    box.get_by_text("List the parameters").click()
    box.locator("select").select_option(label="draught, m")
    old = float(box.locator("input[inputmode]").input_value())
    for _ in range(2):
        box.get_by_role("button", name="+0.1 m", exact=True).click()
    assert float(box.locator("input[inputmode]").input_value()) == pytest.approx(
        old + 0.2, abs=1e-9
    )


def test_what_was_typed_stays_until_enter_or_escape(open_page: Open, hull: ah.Hull) -> None:
    """Also when the field is left, and when somebody else edits the hull meanwhile."""
    hand = open_page(hull)
    hand.ask("(p, name) => p.find(name)", POINT)
    field = hand.page.get_by_label("y, m, from the centre plane")
    field.fill("6.9")
    hand.page.get_by_label("radius of a pull along the length, m").focus()
    hand.settled()
    assert field.input_value() == "6.9"
    hull.apply("another", [{"op": "move", "point": "WL 0.5 x ST 7", "by": [0, 1e-3, 0]}])
    hand.until("p => p.store.history.edits === 1")
    hand.settled()
    assert field.input_value() == "6.9"
    field.press("Enter")
    hand.until("p => p.store.history.edits === 2")
    assert "y 6.9" in hull.history[-1].name
    field.fill("7.1")
    field.press("Escape")
    hand.settled()
    assert float(field.input_value()) == pytest.approx(6.9)


def test_enter_once_more_applies_where_a_place_was_typed(open_page: Open, hull: ah.Hull) -> None:
    """A placed point leads its line: the first Enter shows, the second makes."""
    hand = open_page(hull)
    name = hand.ask(
        "p => [...p.store.net.points.values()].find(({sort, free}) => sort && free === 'xz').name"
    )
    hand.ask("(p, name) => p.find(name)", name)
    field = hand.page.get_by_label("z, m, above the base line")
    field.fill(f"{float(field.input_value()) + 0.004:.4f}")
    field.press("Enter")
    hand.page.locator("aside").get_by_text("Enter applies").wait_for()
    assert len(hull.history) == 0
    field.press("Enter")
    hand.until("p => p.store.history.edits === 1")


def test_escape_in_the_panel_leads_back_to_the_drawing(open_page: Open, hull: ah.Hull) -> None:
    """What is chosen stays chosen; in the drawing Esc gives it up."""
    hand = open_page(hull)
    hand.ask("(p, name) => p.find(name)", POINT)
    opened(hand, "History").locator("summary").focus()
    keys(hand, "Escape")
    assert hand.ask("p => document.activeElement === p.activeView().upper")
    assert chosen(hand)[0] == POINT
    keys(hand, "Escape")
    assert chosen(hand) == [None, None]


def test_what_is_said_is_not_wiped_away_by_the_next_frame(open_page: Open, hull: ah.Hull) -> None:
    """A refusal of a typed value stands in the line below until there was time to read it."""
    hand = open_page(hull)
    hand.ask("(p, name) => p.find(name)", POINT)
    hand.page.get_by_label("pull outward, mm").fill("far")
    hand.page.get_by_label("pull outward, mm").press("Enter")
    hand.ask("p => p.store.changed('panel')")
    hand.settled()
    foot = hand.page.locator(".page > footer")
    expect(foot).to_contain_text('"far" is no pull', use_inner_text=True)


def test_showing_what_is_chosen_twice_is_showing_it_once(open_page: Open, hull: ah.Hull) -> None:
    """F does not zoom on and on; a whole line fits the drawing."""
    hand = open_page(hull)
    hand.ask("p => p.find('ST 16')")
    places = []
    for _ in range(2):
        keys(hand, "f")
        hand.settled()
        places.append(hand.ask("p => [p.views.body.axis.s, p.views.body.axis.o, p.views.body.oy]"))
    assert places[0] == pytest.approx(places[1])


def test_the_low_views_take_no_more_room_than_their_hull(open_page: Open, hull: ah.Hull) -> None:
    """The hull fills the width, and the body plan has what is won; compressed, they get it back."""
    hand = open_page(hull)
    high = "p => [p.views.body.height, p.views.profile.height, p.views.half.height]"
    body, profile, half = hand.ask(high)
    assert body > 430
    assert half < profile < 180
    hand.ask("p => p.compress(5)")
    hand.settled()
    assert hand.ask(high)[1] > profile


def test_a_letter_in_the_panel_says_where_letters_act(open_page: Open, hull: ah.Hull) -> None:
    """One Esc leads there from a list, with what it has marked still marked."""
    hand = open_page(hull)
    hand.ask("(p, name) => p.goTo(name, null)", POINT)
    opened(hand, "History").locator("summary").focus()
    keys(hand, "n")
    expect(hand.page.locator(".page > footer")).to_contain_text(
        "Esc leads there", use_inner_text=True
    )
    keys(hand, "Escape")
    assert hand.ask("p => document.activeElement === p.activeView().upper && !!p.store.marked")


def test_no_name_to_sign_with_leaves_the_one_before(open_page: Open, hull: ah.Hull) -> None:
    """The field shows by whom edits are signed, whatever was typed."""
    hand = open_page(hull)
    field = hand.page.get_by_label("name that your edits are signed with")
    for typed, kept in (("  ", "anna"), (" bert ", "bert")):
        field.fill(typed)
        field.press("Enter")
        assert field.input_value() == kept


def test_keys_act_in_the_drawing_after_a_pull_was_typed(open_page: Open, hull: ah.Hull) -> None:
    """The focus leaves the field: Ctrl+Z takes the pull back, and no letter is typed into it."""
    hand = open_page(hull)
    hand.ask("(p, name) => p.find(name)", POINT)
    keys(hand, "g")
    field = hand.page.get_by_label("pull outward, mm")
    expect(field).to_be_focused()
    field.fill("5")
    keys(hand, "Enter")
    hand.until("p => p.store.history.edits === 1")
    keys(hand, "v")
    expect(field).to_have_value("")
    keys(hand, "Control+z")
    hand.until("p => p.store.history.edits === 0")
