"""Drags in a real browser: what is drawn is what the kernel says, and what is left is one step."""

import math
import re

from playwright.sync_api import expect

import assoc_hull as ah
from tests.browser.conftest import Hand, Open
from tests.taken_back import taken_back

POINT = "WL 0.625 x ST 16"


def test_a_soft_pull_leaves_the_page_and_the_hull_alike(open_page: Open, hull: ah.Hull) -> None:
    """200 moves of the hand, one step; every curve and point shown is the published one."""
    hand = open_page(hull)
    hand.near(POINT)
    x, y = hand.press(POINT)
    for step in range(200):
        hand.page.mouse.move(x + 4.0 * math.sin(0.1 * step), y)
    hand.to(x + 6.0, y)
    live = hand.ask(
        "p => [p.store.overlay.frame.curves.size, p.store.held.amount, p.store.overlay.predicted]"
    )
    assert live[0] > 20
    assert not hull.history
    hand.release()
    (made,) = hull.history
    assert made.name == f"pull {POINT} by {1e3 * live[1]:.1f} mm"
    assert made.author == "anna"
    assert hand.shows_what_is_published()


def test_a_live_picture_is_that_of_the_kernel(open_page: Open, hull: ah.Hull) -> None:
    """What is drawn while the hand rests is what a drag of the library gives for that amount."""
    hand = open_page(hull)
    hand.near(POINT)
    x, y = hand.press(POINT)
    hand.to(x + 7.0, y)
    amount, curves = hand.ask(
        "p => [p.store.held.amount, [...p.store.overlay.frame.curves].map(([id, c]) => [id,"
        " [...c.xyz]])]"
    )
    radius = hand.ask("p => p.store.tools.radius")
    hand.page.keyboard.press("Escape")
    hand.page.mouse.up()
    hand.settled()
    with hull.drag(POINT, radius=tuple(radius)) as drag:
        live = drag.to(d=amount)
    shown = dict(curves)
    assert sorted(shown) == live.curves.tolist()
    for number, spline in zip(live.curves.tolist(), live.spline.single(), strict=True):
        assert shown[number] == spline.xyz.ravel().tolist()


def test_a_point_moves_alone_along_its_freedom(open_page: Open, hull: ah.Hull) -> None:
    """With Ctrl, or with the tool; where the hand goes up and down, it stays on its water line."""
    hand = open_page(hull)
    hand.near(POINT)
    start = hull.points[POINT].position
    hand.page.keyboard.down("Control")
    x, y = hand.press(POINT)
    hand.page.keyboard.up("Control")
    hand.to(x + 4.0, y + 9.0)
    hand.release()
    moved = hull.points[POINT].position - start
    assert moved[0] == moved[2] == 0.0
    assert abs(moved[1] - 0.010) < 1e-6
    hand.page.keyboard.press("p")
    hand.pull(POINT, -4.0)
    assert abs(hull.points[POINT].position[1] - start[1]) < 1e-6
    assert [step.name.split()[0] for step in hull.history] == ["move", "move"]
    assert hand.shows_what_is_published()


def test_escape_leaves_the_hull_as_it_was(open_page: Open, hull: ah.Hull) -> None:
    """Whatever was drawn by then; the hand may go on, and let go."""
    hand, before = open_page(hull), hull.fingerprint
    hand.near(POINT)
    x, y = hand.press(POINT)
    hand.to(x + 5.0, y)
    hand.page.keyboard.press("Escape")
    hand.page.mouse.move(x + 20.0, y)
    hand.page.mouse.up()
    hand.settled()
    assert hand.ask("p => p.store.overlay === null && p.store.held === null")
    assert hull.fingerprint == before
    assert hull.history == ()
    hand.pull(POINT, 5.0)
    assert len(hull.history) == 1


def test_a_click_chooses_and_edits_nothing(open_page: Open, hull: ah.Hull) -> None:
    """Also one with two pixels of a shaking hand; the panel names what was chosen."""
    hand = open_page(hull)
    x, y = hand.spot(POINT)
    mouse = hand.page.mouse
    mouse.move(x, y)
    mouse.down()
    mouse.move(x + 2.0, y + 1.0)
    mouse.up()
    hand.settled()
    assert hull.history == ()
    panel = hand.page.locator("aside")
    expect(panel).to_contain_text(POINT, use_inner_text=True)
    expect(panel).to_contain_text("shared", use_inner_text=True)


def test_a_refusal_stands_at_its_place(open_page: Open, hull: ah.Hull) -> None:
    """Curves stay at the last accepted place; one sentence names a fold, and says what to do."""
    hand, before = open_page(hull), hull.fingerprint
    hand.near(POINT, scale=100.0)
    x, y = hand.press(POINT)
    hand.to(x + 1.0, y)
    accepted = hand.ask("p => p.store.overlay.frame.seq")
    hand.page.mouse.move(x + 90.0, y)
    hand.page.wait_for_selector(".view-body .bubble")
    hand.until("p => p.pending === 0 && p.hand.inFlight === 0 && !p.hand.wish")
    amount = hand.ask("p => p.store.held.amount")
    box = hand.page.locator(".bubble").bounding_box()
    assert box is not None
    place = hand.ask(
        "p => { const v = p.views.body, b = v.upper.getBoundingClientRect(), [x, y] ="
        " v.atPlace(p.store.held.place); return [b.left + x, b.top + y]; }"
    )
    assert not (
        box["x"] <= place[0] <= box["x"] + box["width"]
        and box["y"] <= place[1] <= box["y"] + box["height"]
    )
    assert abs(box["y"] - place[1]) < 200.0
    with hull.drag(POINT, radius=tuple(hand.ask("p => p.store.tools.radius"))) as drag:
        refused = drag.to(d=amount).refused
    line, _, rest = refused[0].partition(" folds back on itself at ")
    place = rest.partition(" m ")[0]
    assert len(refused) > 3
    sentence = re.compile(
        rf"^Too far: {re.escape(line)} would fold at {re.escape(place)} m, and \d+ more lines?\. "
        r"Pull less, or widen the radius of the pull\.$"
    )
    expect(hand.page.locator(".bubble")).to_have_text(sentence)
    expect(hand.page.locator("[aria-live=assertive]")).to_have_text(sentence)
    assert hand.ask("p => p.store.held.refused && p.store.overlay.frame.seq") >= accepted
    hand.release()
    assert hand.page.locator(".bubble").is_visible()
    assert hull.fingerprint == before
    hand.page.keyboard.press("Escape")
    hand.settled()
    assert hand.page.locator(".bubble").count() == 0


def test_a_hover_says_what_a_point_is_before_it_is_pressed(open_page: Open, hull: ah.Hull) -> None:
    """Driven, watched, on a flat: who computes it, and what can be done with it."""
    hand = open_page(hull)
    wanted = {
        "driven by": "q => q.role === 1 || q.role === 2", "watched": "q => q.role === 3",
        "on a flat": "q => q.held === 1 && q.free",
    }  # fmt: skip
    for words, fits in wanted.items():
        name = hand.ask(
            f"p => {{ const v = p.views.body, fits = {fits}, at = r =>"
            f" v.atPlace(p.store.places.get(r));"
            " const alone = row => v.rows().every(r => { const [a, b] = at(r), [c, d] = at(row);"
            " return r === row || Math.hypot(a - c, b - d) > 2; });"
            " for (const row of v.rows()) if (fits(p.store.net.points.get(row)) && alone(row))"
            " return p.store.net.points.get(row).name; }"
        )
        hand.near(name, scale=3000.0)
        hand.page.mouse.move(*hand.spot(name))
        hand.page.wait_for_selector(".view-body .tip:not([hidden])")
        tip = hand.page.locator(".view-body .tip").inner_text()
        assert words in tip
        assert "move" in tip or "pull" in tip
        hand.ask("p => p.fit()")
        hand.settled()


def test_a_point_on_a_flat_refuses_a_pull_with_its_address(open_page: Open, hull: ah.Hull) -> None:
    """The sentence names the point as the page does."""
    hand, before = open_page(hull), hull.fingerprint
    name = hand.ask(
        "p => { for (const row of p.views.body.rows()) { const q = p.store.net.points.get(row);"
        " if (q.held === 1 && q.free === 'y') return q.name; } for (const row of"
        " p.views.body.rows()) {"
        " const q = p.store.net.points.get(row); if (q.held === 1 && q.free) return q.name; } }"
    )
    hand.near(name, scale=3000.0)
    x, y = hand.press(name)
    hand.page.mouse.move(x + 12.0, y + 12.0)
    hand.page.wait_for_selector(".bubble")
    expect(hand.page.locator(".bubble")).to_contain_text("on a flat", use_inner_text=True)
    assert ":" not in hand.page.locator(".bubble").inner_text().partition(" is ")[0]
    hand.release()
    assert hull.fingerprint == before


def fine(hand: Hand) -> float:
    """How far 10 pixels go, mm."""
    x, y = hand.press(POINT)
    hand.to(x + 10.0, y)
    amount: float = hand.ask("p => p.store.held.amount")
    hand.page.keyboard.press("Escape")
    hand.page.mouse.up()
    hand.settled()
    return 1e3 * amount


def test_alt_is_ten_times_finer_and_so_is_the_tool(open_page: Open, hull: ah.Hull) -> None:
    """With the tool on, Alt is as coarse as the hand."""
    hand = open_page(hull)
    hand.near(POINT)
    whole = fine(hand)
    hand.page.keyboard.down("Alt")
    part = fine(hand)
    hand.page.keyboard.up("Alt")
    assert abs(part / whole - 0.1) < 0.01
    hand.page.get_by_role("button", name="Fine").click()
    assert abs(fine(hand) / whole - 0.1) < 0.01


def test_shift_locks_an_axis(open_page: Open, hull: ah.Hull) -> None:
    """Of a point with two freedoms: it goes where the hand goes most."""
    hand = open_page(hull)
    name = hand.ask(
        "p => { for (const q of p.store.net.points.values()) if (q.free === 'yz' && q.sort === 2"
        " && p.views.body.rows().includes(q.row)) return q.name; return null; }"
    )
    hand.near(name, scale=2000.0)
    start = hull.points[name].position
    hand.page.get_by_role("button", name="Move").first.click()
    hand.page.keyboard.down("Shift")
    x, y = hand.press(name)
    hand.to(x + 3.0, y - 8.0)
    place = hand.ask("p => p.store.held.place")
    hand.page.keyboard.press("Escape")
    hand.page.keyboard.up("Shift")
    hand.page.mouse.up()
    assert place[1] == start[1]
    assert abs(place[2] - start[2]) > 1e-3


def test_the_wheel_widens_the_pull_in_hand(open_page: Open, hull: ah.Hull) -> None:
    """More curves follow, and the edit is made with what was seen."""
    hand = open_page(hull)
    hand.near(POINT)
    x, y = hand.press(POINT)
    hand.to(x + 4.0, y)
    few = hand.ask("p => [p.store.overlay.frame.curves.size, p.store.tools.radius[0]]")
    for _ in range(4):
        hand.page.mouse.wheel(0, -120)
    hand.until("(p, wide) => p.store.tools.radius[0] > 1.8 * wide", few[1])
    hand.to(x + 5.0, y)
    more = hand.ask("p => [p.store.overlay.frame.curves.size, p.store.tools.radius[0]]")
    assert more[0] >= few[0]
    hand.release()
    assert len(hull.history) == 1
    assert len(hull.history[0].relofted) >= few[0]


def test_a_burst_of_arrows_is_one_step(open_page: Open, hull: ah.Hull) -> None:
    """1 mm each, 10 with Shift, 0.1 with Alt; Enter ends it at once."""
    hand = open_page(hull)
    x, y = hand.spot(POINT)
    hand.page.mouse.click(x, y)
    hand.settled()
    keys = hand.page.keyboard
    for key in ("ArrowUp", "ArrowRight", "Shift+ArrowUp", "Alt+ArrowDown"):
        keys.press(key)
    hand.until("p => p.hand.inFlight === 0 && !p.hand.wish && p.store.overlay")
    keys.press("Enter")
    hand.settled()
    (step,) = hull.history
    assert step.name == f"pull {POINT} by 11.9 mm"
    keys.press("ArrowDown")
    hand.until("p => p.store.held === null && !p.hand.committing && p.store.history.edits === 2")
    assert hull.history[-1].name == f"pull {POINT} by -1.0 mm"


def test_undo_takes_back_and_redo_makes_again(open_page: Open, hull: ah.Hull) -> None:
    """By button and by key; the page shows what is published each time."""
    hand, before = open_page(hull), hull.fingerprint
    hand.near(POINT)
    hand.pull(POINT, 4.0)
    hand.pull(POINT, 3.0)
    after = hull.fingerprint
    hand.page.get_by_role("button", name="Undo").click()
    hand.until("p => p.store.history.edits === 1")
    hand.page.keyboard.press("Control+z")
    hand.until("p => p.store.history.edits === 0")
    assert hull.fingerprint == before
    assert hand.shows_what_is_published()
    expect(hand.page.get_by_role("button", name="Undo")).to_be_disabled()  # drawn a frame later
    hand.page.keyboard.press("Control+y")
    hand.until("p => p.store.history.edits === 1")
    hand.page.keyboard.press("Control+Shift+Z")
    hand.until("p => p.store.history.edits === 2")
    assert hull.fingerprint == after
    assert hand.shows_what_is_published()


def test_what_is_typed_is_one_step_and_nonsense_is_none(open_page: Open, hull: ah.Hull) -> None:
    """A field for each free coordinate; the others can be read only."""
    hand = open_page(hull)
    x, y = hand.spot(POINT)
    hand.page.mouse.click(x, y)
    field = hand.page.get_by_label("y, m, from the centre plane")
    assert not hand.page.get_by_label("x, m, forward of AP").is_editable()
    field.fill("6,893")
    field.press("Enter")
    hand.until("p => p.store.history.edits === 1")
    assert hull.points[POINT].position[1] == 6.893
    assert hand.shows_what_is_published()
    field.fill("wide")
    field.press("Enter")
    expect(hand.page.locator("footer")).to_contain_text("y is no number", use_inner_text=True)
    field.fill("600")
    field.press("Enter")
    hand.page.wait_for_selector(".bubble")
    assert len(hull.history) == 1


def test_a_ship_with_a_bulb_is_pulled_as_well(open_page: Open, bulk_carrier: ah.Hull) -> None:
    """Another hull, with stations of other names; it is taken back in the end."""
    hand, name = open_page(bulk_carrier), "WL 11 x ST 19"
    with taken_back(bulk_carrier):
        hand.near(name)
        hand.pull(name, 12.0)
        assert len(bulk_carrier.history) == 1
        assert hand.shows_what_is_published()


COVERED = """(p, kind) => { const v = p.views[kind], d = devicePixelRatio,
  c = new OffscreenCanvas(v.upper.width, v.upper.height),
  g = c.getContext('2d', {willReadFrequently: true});
  g.drawImage(v.upper, 0, 0);
  return v.written.slice(1).filter(({box: [l, t, r, b]}) => g.getImageData(Math.ceil(l * d),
    Math.ceil(t * d), Math.floor((r - l) * d) - 1, Math.floor((b - t) * d) - 1).data
    .some((each, i) => i % 4 === 3 && each > 0)).map(({text}) => text); }"""
"""Names over which something is drawn."""


def test_nothing_that_moves_lies_over_a_name(open_page: Open, hull: ah.Hull) -> None:
    """Neither spikes nor combs, while a point is dragged: they are drawn beside it."""
    hand = open_page(hull)
    x, y = hand.press(POINT)
    hand.page.keyboard.down("Alt")
    hand.to(x + 8.0, y)
    hand.settled()
    assert hand.ask("p => p.store.overlay.frame.curves.size") > 20
    assert hand.ask(COVERED, "profile") == []
    foot = hand.page.locator(".page > footer")
    pixel = hand.ask("p => 100 / p.views.body.axis.s")
    expect(foot, "of the hand as it is, with Alt").to_contain_text(f"1 px is {pixel:.1f} mm")
    hand.page.keyboard.up("Alt")
    hand.page.keyboard.press("Escape")
    hand.page.mouse.up()
    hand.ask("p => p.compress(5)")
    hand.settled()
    x, y = hand.press(POINT, "half")
    hand.page.mouse.move(x, y - 3.0)
    hand.settled()
    pixel = hand.ask("p => 1000 / (5 * p.views.half.axis.s)")
    expect(foot).to_contain_text(f"1 px is {pixel:.0f} mm")
    hand.page.keyboard.press("Escape")
    hand.page.mouse.up()


def test_a_refused_pull_tells_no_figures_and_hides_not_how_far_it_is(
    open_page: Open, hull: ah.Hull
) -> None:
    """Nothing follows it; the number at the point is not under the reason."""
    hand = open_page(hull)
    x, y = hand.press(POINT)
    hand.page.mouse.move(x + 90.0, y)
    hand.page.wait_for_selector(".view-body .bubble")
    edit = hand.page.locator("details:has(h2:text-is('Edit'))")
    expect(edit).to_contain_text("refused", use_inner_text=True)
    expect(edit).not_to_contain_text("m³", use_inner_text=True)
    box = hand.page.locator(".bubble").bounding_box()
    assert box is not None
    at = hand.ask("p => p.views.body.atPlace(p.store.held.place)[1]")
    top = hand.page.locator(".view-body").bounding_box()
    assert top is not None
    low, high = top["y"] + at - 21.0, top["y"] + at - 7.0
    assert box["y"] + box["height"] <= low or box["y"] >= high
    hand.page.mouse.up()
    hand.settled()
    assert hand.page.locator(".bubble").is_visible()
    ops = [{"op": "pull", "point": POINT, "d": 0.005, "radius": [15.0, 5.0]}]
    hand.ask("(p, ops) => p.panel.proposal.show('less', ops)", ops)
    hand.until("p => p.panel.proposal.ready")
    assert hand.page.locator(".bubble").count() == 0, "another question is looked at now"


def test_a_point_is_taken_hold_of_right_after_an_undo(open_page: Open, hull: ah.Hull) -> None:
    """The hull comes anew while the point is pressed: it follows, and nobody else is kept out."""
    name = "WL 0.35 x ST 17"
    pull = {"op": "pull", "point": name, "d": 0.01, "radius": [15.2, 6.1]}
    hand = open_page(hull)
    hand.ask("(p, ops) => p.apply('a pull that adopts', ops)", [pull])
    hand.until("p => p.store.history.edits === 1 && p.applying === 0")
    hand.near(name)
    x, y = hand.spot(name)
    hand.page.mouse.move(x, y)
    hand.ask("p => { window.taken = p.hand.gesture; p.undo(); }")
    hand.page.mouse.down()
    hand.page.mouse.move(x + 5.0, y)
    hand.page.mouse.move(x + 9.0, y)
    hand.until("p => p.store.history.edits === 0 && p.hand.gripped && !!p.store.held?.amount")
    hand.release()
    assert len(hull.history) == 1


def figures(hand: Hand, part: str) -> dict[str, str]:
    """What a part of the panel tells, by what it is of."""
    box = hand.page.locator("aside details", has=hand.page.locator("h2", has_text=part)).first
    names = box.locator("dt").all_inner_texts()
    return dict(zip(names, box.locator("dd").all_inner_texts(), strict=True))


WRITTEN = (
    "window.said = []; { const whole = CanvasRenderingContext2D.prototype.fillText;"
    " CanvasRenderingContext2D.prototype.fillText = function (words, ...at) {"
    " if (words.includes(' mm')) window.said.push(words); return whole.call(this, words, ...at);"
    " }; }"
)
"""Keep what is written in millimetres on a drawing."""


def test_a_drag_tells_one_figure_of_each_thing_and_of_what_it_is(
    open_page: Open, hull: ah.Hull
) -> None:
    """At the hand the hull, as in the panel; there the point and the line too, each once."""
    hand = open_page(hull, before=WRITTEN)
    hand.near(POINT)
    x, y = hand.press(POINT)
    hand.to(x + 9.0, y)
    hand.settled()
    amount = 1e3 * hand.ask("p => p.store.held.amount")
    assert hand.page.evaluate("window.said.at(-1)") == f"hull +{amount:.1f} mm"
    told = figures(hand, "Edit")
    assert told["hull moves"] == f"{amount:.1f} mm along its normal at most"
    panel = hand.page.locator("aside").inner_text()
    assert len(re.findall(r"[\d.]+ mm\b", panel.replace("1 mm", ""))) == 3
    hand.page.keyboard.press("Escape")
    hand.page.mouse.up()
    hand.settled()
    hand.ask("p => p.use('move')")
    x, y = hand.press(POINT)
    hand.to(x + 9.0, y)
    hand.settled()
    amount = 1e3 * hand.ask("p => p.store.held.amount")
    assert hand.page.evaluate("window.said.at(-1)") == f"point +{amount:.1f} mm"
    assert figures(hand, "Point")["point moved"] == f"{amount:.1f} mm"


def test_what_was_let_go_tells_how_far_point_and_line_have_moved(
    open_page: Open, hull: ah.Hull
) -> None:
    """As the hand saw it; once it is taken back nothing has moved."""
    hand = open_page(hull)
    hand.near(POINT)
    x, y = hand.press(POINT)
    hand.to(x + 9.0, y)
    hand.settled()
    point, line = figures(hand, "Point")["point moved"], figures(hand, "Curve")["line moved"]
    assert re.fullmatch(r"[\d.]+ mm", point)
    hand.release()
    expect(hand.page.locator("aside .moved")).to_have_text(f"{point}, last edit")
    assert figures(hand, "Curve")["line moved"] == f"{line}, last edit"
    hand.ask("p => p.undo()")
    expect(hand.page.locator("aside .moved")).to_have_text("not moved")
    assert figures(hand, "Curve")["line moved"] == "not moved"


def test_a_refused_pull_says_the_same_after_it_was_let_go(open_page: Open, hull: ah.Hull) -> None:
    """A pull is made less or wider, also where the hand has left it."""
    hand = open_page(hull)
    x, y = hand.press(POINT)
    hand.page.mouse.move(x + 60.0, y)
    hand.until("p => p.hand.inFlight === 0 && p.store.refusal")
    said = hand.page.locator(".bubble").inner_text()
    assert "Pull less" in said
    hand.release()
    hand.until("p => p.store.held === null && p.store.refusal")
    expect(hand.page.locator(".bubble")).to_have_text(said)


def test_dots_of_watched_crossings_ride_with_their_curves(
    open_page: Open, bulk_carrier: ah.Hull
) -> None:
    """While the hand drags they lie where the edit leaves them, and it leaves them elsewhere."""
    hand = open_page(bulk_carrier.snapshot())
    name = "WL 11 x ST 19.4"
    hand.near(name, scale=60.0)
    x, y = hand.press(name)
    hand.to(x + 2.0, y)
    hand.settled()
    places = (
        "p => [...p.store.net.points.values()].filter(q => q.sort === 0 && q.role === 3)"
        ".map(({row}) => [row, ...p.store.placeOf(row)])"
    )
    before = hand.ask(places.replace("p.store.placeOf(row)", "p.store.places.get(row)"))
    seen = hand.ask(places)
    hand.release()
    assert len(hand.hull.history) == 1
    after = hand.ask(places)
    assert sum(one != other for one, other in zip(before, after, strict=True)) > 3
    assert seen == after
