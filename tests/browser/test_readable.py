"""What lies over what on a drawing, what stays where it is, and what is offered where it acts."""

import re
from collections import Counter

import pytest
from playwright.sync_api import expect

import assoc_hull as ah
from tests.browser.conftest import Hand, Open
from tests.browser.test_looks import NAMED

POINT = "WL 0.625 x ST 16"
COPY = (
    "window.copy = canvas => { const other = document.createElement('canvas');"
    " [other.width, other.height] = [canvas.width, canvas.height];"
    " const g = other.getContext('2d', {willReadFrequently: true}); g.drawImage(canvas, 0, 0);"
    " return g; }; "
)
"""Read a drawing without making the browser draw it in another way from then on."""


def test_marks_of_inflection_are_seen_around_the_points_under_them(
    open_page: Open, bulk_carrier: ah.Hull
) -> None:
    """All four corners, in the colour of marks, with all points drawn and one chosen."""
    hand = open_page(bulk_carrier.snapshot(), before=COPY)
    hand.near("WL 13.5 x ST 19.4", scale=40.0)
    hand.ask("(p, name) => p.find(name)", "WL 11 x ST 19.4")
    hand.settled()
    seen = hand.ask(
        "async p => { const {inflections, evaluate} = await import('/hermite.js');"
        " const v = p.views.body, c = p.store.curves.get(p.store.selection.curve),"
        " g = copy(v.upper), at = new Float64Array(9), d = devicePixelRatio;"
        " return inflections(c, 1, 2).map(({segment, u}) => { evaluate(c, segment, u, at);"
        " const [x, y] = v.atPlace(at); return [x, y]; }).filter(([x, y]) => x > 60 && y > 40"
        " && x < v.width - 20 && y < v.height - 60).map(([x, y]) => [[-8, 0], [8, 0], [0, -8],"
        " [0, 8]].map(([dx, dy]) => { const near = g.getImageData((x + dx - 1) * d, (y + dy - 1)"
        " * d, 3, 3).data; return Array.from({length: 9}, (_, i) => near.slice(4 * i, 4 * i + 4))"
        ".some(([r, q, b, a]) => r > 150 && q < 60 && b < 90 && a > 150); })); }"
    )
    assert seen
    assert all(all(each) for each in seen)


def test_combs_end_above_the_names_at_the_foot(open_page: Open, bulk_carrier: ah.Hull) -> None:
    """Of a waterline that meets the centre plane steeply; no ink of combs is below it."""
    hand = open_page(bulk_carrier.snapshot(), before=COPY)
    hand.ask("(p, name) => p.find(name)", "WL 8")
    hand.settled()
    found = hand.ask(
        "p => { const v = p.views.half, d = devicePixelRatio, foot = v.at(0, 0, 0, 1)[1] + 6,"
        " g = copy(v.upper), count = (y, h) => { const {data} = g.getImageData(0,"
        " y * d, v.width * d, h * d); let n = 0; for (let i = 0; i < data.length; i += 4)"
        " n += data[i + 3] > 0 && data[i + 2] > data[i + 1] + 40; return n; };"
        " return [count(0, foot), count(foot, v.height - foot)]; }"
    )
    assert found[0] > 100
    assert found[1] == 0


@pytest.mark.parametrize("kind", ["body", "profile", "half"])
def test_what_is_told_under_the_pointer_is_seen_whole(
    open_page: Open, bulk_carrier: ah.Hull, kind: str
) -> None:
    """Within its view, at all points of it that lie at an edge."""
    hand = open_page(bulk_carrier.snapshot())
    names = hand.ask(
        "(p, kind) => { const v = p.views[kind], all = v.rows().map(row => [row,"
        " ...v.atPlace(p.store.places.get(row))]).filter(([, x, y]) => !v.framed(x, y)), by ="
        " (f) => [...all].sort((a, b) => f(a) - f(b))[0][0]; return [([, x]) => x, ([, x]) => -x,"
        " ([, , y]) => y, ([, , y]) => -y, ([, x, y]) => Math.abs(x - 0.7 * v.width)"
        " + Math.abs(y - 0.45 * v.height)].map(by).map(row => p.store.net.points.get(row).name); }",
        kind,
    )
    for name in names:
        hand.page.mouse.move(*hand.spot(name, kind))
        tip = hand.page.locator(f".view-{kind} .tip")
        expect(tip).to_be_visible()
        inside = hand.ask(
            "(p, kind) => { const a = p.views[kind].tip.getBoundingClientRect(),"
            " b = p.views[kind].element.getBoundingClientRect(); return a.left >= b.left"
            " && a.right <= b.right && a.top >= b.top && a.bottom <= b.bottom; }", kind,
        )  # fmt: skip
        assert inside, name


def leapt(before: list[list[float]], after: list[list[float]]) -> list[str]:
    """Names that have left their place by more than a hand's breadth of letters."""
    at = [(each[0], (each[1] + each[3]) / 2, (each[2] + each[4]) / 2) for each in after]
    return [
        str(text) for text, left, top, right, foot in before
        if not any(text == other and abs((left + right) / 2 - x) + abs((top + foot) / 2 - y) < 13.0
                   for other, x, y in at)
    ]  # fmt: skip


@pytest.mark.parametrize("name", ["WL 11 x ST 19.4", "WL 12 x ST 2"])
def test_names_stay_where_they_are_when_a_point_is_chosen_and_let_go(
    open_page: Open, bulk_carrier: ah.Hull, name: str
) -> None:
    """All but two, which lie under points that are drawn now."""
    hand = open_page(bulk_carrier.snapshot())
    views = ("body", "profile", "half")
    before = {kind: hand.ask(NAMED, kind) for kind in views}
    hand.ask(
        "(p, name) => { const {net} = p.store, row = net.find(name);"
        " p.store.select(row, net.points.get(row).b); }", name,
    )  # fmt: skip
    hand.settled()
    chosen = {kind: hand.ask(NAMED, kind) for kind in views}
    assert sum(len(leapt(before[kind], chosen[kind])) for kind in views) <= 2
    hand.ask("(p, name) => p.apply('a', [{op: 'pull', point: name, d: 0.05}])", name)
    hand.until("p => p.store.history.edits === 1")
    hand.settled()
    assert sum(len(leapt(chosen[kind], hand.ask(NAMED, kind))) for kind in views) <= 1


def in_metres(hull: ah.Hull) -> ah.Hull:
    """A hull whose stations are named by their distance from AP, as one of a surface is."""
    found = hull.snapshot()
    with found.edit("names") as edit:
        for name, line in list(found.lines.items()):
            if name.startswith("ST ") and line.plane is not None:
                edit.rename(name, f"ST {line.plane.offset:.2f}")
    return found


def test_stations_named_by_metres_are_told_to_be_metres(open_page: Open, hull: ah.Hull) -> None:
    """Above the body plan and at the row of the profile; stations that are numbers keep ST."""
    hand = open_page(hull)
    for kind in ("body", "profile", "half"):
        assert "x, m" not in {text for text, *_ in hand.ask(NAMED, kind)}
    hand = open_page(in_metres(hull))
    for kind in ("body", "profile", "half"):
        words = {text for text, *_ in hand.ask(NAMED, kind)}
        assert "x, m" in words
        assert "ST" not in words


def test_stations_stand_in_two_rows_where_lengths_are_compressed(
    open_page: Open, hull: ah.Hull
) -> None:
    """Names of metres are long: one row has a name for every third station only."""
    hand = open_page(in_metres(hull))
    hand.ask("p => p.compress(5)")
    hand.settled()
    for kind in ("profile", "half"):
        foot = hand.ask("(p, kind) => p.views[kind].at(0, 0, p.views[kind].box().z0, 1)[1]", kind)
        rows = Counter(round(top) for text, _, top, *_ in hand.ask(NAMED, kind)
                       if top > foot and re.fullmatch(r"-?[\d.]+", text))  # fmt: skip
        assert len(rows) == 2
        assert min(rows.values()) > 0.6 * max(rows.values())


def test_what_does_nothing_is_neither_lit_nor_offered(open_page: Open, hull: ah.Hull) -> None:
    """Compression where no lengths are seen; fair re-shapes where no line is chosen."""
    hand = open_page(hull)
    compress = hand.page.locator("[data-action=compress]")
    fair = hand.page.locator("[data-action=fair-shape]")
    plain = hand.page.locator("[data-action=reshape]")
    ground = "each => getComputedStyle(each).backgroundColor"
    expect(fair).to_be_disabled()
    assert fair.evaluate(ground) == plain.evaluate(ground)
    hand.ask("p => p.compress(5)")
    expect(compress).to_have_text("Compressed × 5")
    hand.ask("p => p.maximise('body')")
    expect(compress).to_be_disabled()
    expect(compress).to_have_text("Compress")
    expect(compress).to_have_attribute("aria-pressed", "false")
    hand.ask("p => p.maximise('body')")
    expect(compress).to_be_enabled()
    expect(compress).to_have_attribute("aria-pressed", "true")
    hand.ask("(p, name) => p.find(name)", POINT)
    expect(fair).to_be_enabled()
    assert fair.evaluate(ground) != plain.evaluate(ground)


def pressed(hand: Hand, key: str) -> None:
    """Press a key where the focus is."""
    hand.page.keyboard.press(key)
    hand.settled()


def test_letters_act_while_a_button_of_the_bar_has_the_focus(
    open_page: Open, hull: ah.Hull
) -> None:
    """As in the drawing; the field there is for words, and the space bar presses the button."""
    hand = open_page(hull)
    combs = hand.page.locator("[data-action=combs]")
    combs.click()
    assert not hand.ask("p => p.store.show.combs")
    pressed(hand, "d")
    assert hand.ask("p => p.store.show.points")
    pressed(hand, "3")
    assert hand.ask("p => p.store.maximised") == "half"
    pressed(hand, "Space")
    assert hand.ask("p => p.store.show.combs")
    hand.page.locator(".bar input").focus()
    pressed(hand, "d")
    assert hand.ask("p => p.store.show.points")
