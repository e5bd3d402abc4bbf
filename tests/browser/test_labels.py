"""Names on the drawings: where those of the grid stand, and where leaders run."""

import itertools
from typing import Any

import pytest
from playwright.sync_api import expect

import assoc_hull as ah
from tests.browser.conftest import Hand, Open
from tests.browser.test_looks import NAMED

LEADERS = (
    "window.leaders = []; { const g = CanvasRenderingContext2D.prototype; let way = [];"
    " for (const name of ['moveTo', 'lineTo', 'beginPath', 'stroke']) { const whole = g[name];"
    " g[name] = function (...at) { if (name === 'beginPath') way = [];"
    " else if (name === 'stroke') {"
    " if (Math.hypot(this.lineWidth - 0.7, this.globalAlpha - 0.75) < 1e-3)"
    " window.leaders.push([this.canvas.parentElement.className, way]); } else way.push(at);"
    " return whole.call(this, ...at); }; } }"
)
"""Keep what is stroked as leaders are: the view, and its corners."""

NEAR = {
    "fitted": "p => { for (const v of Object.values(p.views)) v.touch(); }",
    "body plan": "p => p.views.body.zoom(200, 200, 4)",
    "bow": "p => p.views.profile.centre([p.store.net.particulars.length, 0, 5], 12)",
    "stern": "p => p.views.half.centre([0.08 * p.store.net.particulars.length, 4, 5], 15)",
    "bilge": "p => { const {breadth} = p.store.net.particulars;"
    " p.views.body.centre([20, 0.3 * breadth, 3], 200); }",
}


def look(hand: Hand, where: str) -> None:
    """Look at a part of the hull from near."""
    hand.page.evaluate("window.leaders = []")
    hand.ask(NEAR[where])
    hand.ask("p => p.store.changed('hull', 'overlay')")
    hand.settled()


@pytest.mark.parametrize("where", [name for name in NEAR if name != "fitted"])
@pytest.mark.parametrize("name", ["series60_70", "bulk_carrier"])
def test_names_of_the_grid_have_a_row_and_a_column_at_the_edge_of_a_zoomed_view(
    open_page: Open, name: str, where: str, request: pytest.FixtureRequest
) -> None:
    """Stations in one row, heights in one column, both clear of lines and of all other names."""
    ship = request.getfixturevalue(name)
    hand = open_page(ship.snapshot())
    look(hand, where)
    kind = {"bow": "profile", "stern": "half"}.get(where, "body")
    frame, height = hand.ask("(p, kind) => [p.views[kind].frame, p.views[kind].height]", kind)
    assert frame
    across, upright = {"body": ("BTK ", "WL "), "profile": ("ST ", "WL "),
                       "half": ("ST ", "BTK ")}[kind]  # fmt: skip
    own = {"body": "ST ", "profile": "BTK ", "half": "WL "}[kind]
    foot = min([t for _, t, *_ in frame if t > 0.0], default=height)
    side = max([right for left, _, right, _ in frame if left < 0.0 and right < 100.0], default=0.0)
    written = hand.ask(NAMED, kind)
    names = {family: {each.removeprefix(family) for each in ship.lines if each.startswith(family)}
             for family in (across, upright, own)}  # fmt: skip
    row = [each for each in written if each[2] > foot and each[0] in names[across]]
    column = [each for each in written if each[3] < side and each[0] in names[upright]]
    if foot < height:
        assert len(row) > 1
        assert len({round(top, 3) for _, _, top, *_ in row}) == 1
    if side:
        assert len(column) > 1
        assert len({round(right, 3) for _, _, _, right, _ in column}) == 1
    # Names of the view's own lines stand in the drawing.
    for text, left, _, right, low in written:
        if text.startswith(own) or text in names[own] - names[across] - names[upright]:
            assert low < foot
            assert left > side or right - left < 11.0  # upright ones stand above it


@pytest.mark.parametrize("where", NEAR)
@pytest.mark.parametrize("name", ["series60_70", "bulk_carrier"])
def test_no_leader_runs_under_a_name(
    open_page: Open, name: str, where: str, request: pytest.FixtureRequest
) -> None:
    """Whoever follows one with the eye comes to its own name."""
    hand = open_page(request.getfixturevalue(name).snapshot(), before=LEADERS)
    look(hand, where)
    drawn = hand.page.evaluate("window.leaders")
    assert len(drawn) > (40 if where == "fitted" else 0)
    under = list[Any]()
    for kind in ("body", "profile", "half"):
        written = hand.ask(NAMED, kind)
        for way in [way for view, way in drawn if f"view-{kind}" in view]:
            for (x, y), (u, v) in itertools.pairwise(way):
                steps = [(x + (u - x) * k / 40, y + (v - y) * k / 40) for k in range(41)]
                under += [(text, way) for text, left, top, right, low in written
                          if any(left < p < right and top + 1 < q < low - 1
                                 for p, q in steps)]  # fmt: skip
    assert under == []


def test_a_flat_that_is_seen_from_its_edge_has_no_name(
    open_page: Open, bulk_carrier: ah.Hull
) -> None:
    """In the body plan that of the side is one straight line, on stations, from near too."""
    hand = open_page(bulk_carrier.snapshot())
    for scale in (20.0, 60.0, 200.0):
        hand.near("WL 8 x ST 17", scale=scale)
        assert "flat of side" not in {text for text, *_ in hand.ask(NAMED, "body")}
    assert "flat of side" in {text for text, *_ in hand.ask(NAMED, "profile")}


def test_buttocks_are_named_next_to_the_stem(open_page: Open, bulk_carrier: ah.Hull) -> None:
    """Lines a pixel apart there have a name fore too, all but three for which there is no room."""
    hand = open_page(bulk_carrier.snapshot())
    for kind, family, all_but in (("profile", "BTK ", {"0.5"}), ("half", "WL ", {"4", "15"})):
        middle = hand.ask("(p, kind) => p.views[kind].at(150, 0, 0, 1)[0]", kind)
        foot = hand.ask("(p, kind) => p.views[kind].at(0, 0, 0, 1)[1]", kind)
        fore = {text.removeprefix(family) for text, left, _, _, low in hand.ask(NAMED, kind)
                if left > middle and low < foot}  # fmt: skip
        names = {each.removeprefix(family) for each in bulk_carrier.lines
                 if each.startswith(family)}  # fmt: skip
        assert names - fore <= all_but


SEEN = (
    "(p, kind, name) => { const v = p.views[kind], c = p.store.curves.get("
    "p.store.net.findCurve(name)); let n = 0; for (let i = 0; i < c.n; i++) {"
    " const [x, y] = v.atPlace(c.xyz.subarray(3 * i, 3 * i + 3));"
    " if (x > 0 && y > 0 && x < v.width && y < v.height && !v.framed(x, y)) n++; }"
    " return [n, c.n]; }"
)
"""How many knots of a line a view shows, and how many there are."""


def test_a_line_that_is_chosen_is_brought_into_view(open_page: Open, bulk_carrier: ah.Hull) -> None:
    """From the list its nearest part, by its name all of it, in the view that draws it."""
    hand = open_page(bulk_carrier.snapshot())
    hand.near("WL 8 x ST 17", scale=60.0)
    hand.ask("p => p.views.half.centre([290, 5, 10], 40)")
    for name, kind in (("ST 1", "body"), ("BTK 21", "profile"), ("WL 0.5", "half")):
        hand.ask("(p, kind) => { p.active = kind; }", "body")
        if kind == "half":
            hand.ask("p => p.views.half.centre([290, 24, 10], 60)")
        assert hand.ask(SEEN, kind, name)[0] == 0
        hand.page.get_by_label("the chosen line").select_option(label=name)
        hand.until(f"p => ({SEEN})(p, '{kind}', '{name}')[0] > 0")
    hand.ask("p => p.find('WL 4')")
    hand.settled()
    shown, whole = hand.ask(SEEN, "half", "WL 4")
    assert shown == whole


def test_a_line_that_is_chosen_on_a_narrow_screen_scrolls_to_its_drawing(
    open_page: Open, hull: ah.Hull
) -> None:
    """The list stands below the drawing."""
    hand = open_page(hull, viewport={"width": 390, "height": 500})
    hand.page.get_by_label("the chosen line").scroll_into_view_if_needed()
    hand.page.evaluate("scrollTo(0, 600)")
    expect(hand.page.locator(".view-body")).not_to_be_in_viewport()
    hand.page.get_by_label("the chosen line").select_option(label="ST 4")
    expect(hand.page.locator(".view-body")).to_be_in_viewport(ratio=0.9)
