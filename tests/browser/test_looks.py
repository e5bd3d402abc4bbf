"""What is seen: views, combs, sizes of the screen, names, and that nothing runs when idle."""

import re
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import expect

import assoc_hull as ah
from assoc_hull.geometry.fairness.inflections import inflections
from tests.browser.conftest import READY, Hand, Open

POINT = "WL 0.625 x ST 16"
NO_WEBGL = (
    "for (const kind of [HTMLCanvasElement, OffscreenCanvas]) { const whole ="
    " kind.prototype.getContext; kind.prototype.getContext = function (name, ...more) {"
    " return name.includes('webgl') || name === 'webgpu' ? null : whole.call(this, name, ...more);"
    " }; } delete window.WebGLRenderingContext; delete window.WebGL2RenderingContext;"
    " delete Navigator.prototype.gpu;"
)
VIEWS = ("body", "profile", "half", "wire")
INK = (
    "(p, kind, which) => { const c = p.views[kind][which], t = new OffscreenCanvas(c.width,"
    " c.height);"
    " const g = t.getContext('2d', {willReadFrequently: true}); g.drawImage(c, 0, 0);"
    " const d = g.getImageData(0, 0, c.width, c.height).data; let n = 0;"
    " for (let i = 3; i < d.length; i += 4) if (d[i] > 40) n++; return n; }"
)
"""How many pixels of a canvas are drawn."""


def test_the_first_picture_has_all_of_the_hull_in_four_views(
    open_page: Open, hull: ah.Hull
) -> None:
    """Drawn without a hand; the whole of the hull lies within each view."""
    hand = open_page(hull)
    assert hand.page.title() == "Series 60 CB 0.70 – fairing page"
    expect(hand.page.locator(".dims")).to_contain_text("77 lines", use_inner_text=True)
    for kind in VIEWS:
        assert hand.ask(INK, kind, "lower") > 3000
        out = hand.ask(
            "(p, kind) => { const v = p.views[kind]; let n = 0; for (const c of"
            " p.store.curves.values())"
            " for (let i = 0; i < 3 * c.n; i += 3) for (const s of kind === 'wire' ? [1, -1] :"
            " [v.side(c.xyz[i])]) {"
            " const [x, y] = v.at(c.xyz[i], c.xyz[i+1], c.xyz[i+2], s);"
            " if (x < 0 || y < 0 || x > v.width || y > v.height) n++; } return n; }",
            kind,
        )
        assert out == 0
    assert hand.shows_what_is_published()


def test_the_page_runs_under_its_own_policy(open_page: Open, hull: ah.Hull) -> None:
    """Nothing inline, nothing from elsewhere is needed; the token leaves the address."""
    hand = open_page(hull, strict=True)
    assert hand.page.locator(READY).count() == 1
    assert "#" not in hand.page.url
    hand.page.reload()
    hand.page.wait_for_selector(READY)


def test_profile_and_half_breadth_plan_share_the_length(open_page: Open, hull: ah.Hull) -> None:
    """Zoom and pan of one are those of the other."""
    hand = open_page(hull)
    x, y = hand.spot(POINT, "half")
    hand.page.mouse.move(x, y)
    hand.page.mouse.wheel(0, -300)
    hand.settled()
    other = hand.spot(POINT, "profile")
    zoomed = hand.spot(POINT, "half")[0]
    assert abs(zoomed - x) < 1.0  # the wheel comes at whole pixels
    assert abs(other[0] - zoomed) < 0.01
    box = hand.page.locator(".view-half").bounding_box()
    assert box is not None
    foot = box["y"] + box["height"] - 6.0
    hand.page.mouse.move(400.0, foot)
    hand.page.mouse.down()
    hand.page.mouse.move(404.0, foot)  # from here on it is a drag
    hand.page.mouse.move(454.0, foot)
    hand.page.mouse.up()
    hand.settled()
    assert abs(hand.spot(POINT, "profile")[0] - zoomed - 50.0) < 0.01
    hand.page.keyboard.press("0")
    hand.settled()
    assert hand.ask("p => p.views.half.fitted && p.views.profile.fitted")


def test_a_comb_keeps_its_scale_while_it_is_dragged(open_page: Open, hull: ah.Hull) -> None:
    """Only + and - change it; it is switched off by its key."""
    hand = open_page(hull)
    hand.near(POINT)
    x, y = hand.press(POINT)
    scales = "p => [...p.views.body.scales.values()]"
    hand.to(x + 2.0, y)
    before = hand.ask(scales)
    hand.to(x + 8.0, y)
    assert hand.ask(scales) == before
    assert before
    with_comb = hand.ask(INK, "body", "upper")
    hand.page.keyboard.press("Escape")
    hand.page.mouse.up()
    hand.settled()
    hand.page.keyboard.press("+")
    assert hand.ask("p => p.store.gain") == 1.25
    hand.page.keyboard.press("k")
    hand.settled()
    assert hand.ask(INK, "body", "upper") < with_comb


@pytest.mark.parametrize("name", ["series60_70", "bulk_carrier"])
def test_marks_of_inflection_are_those_of_the_library(
    open_page: Open, name: str, request: pytest.FixtureRequest
) -> None:
    """On every plane curve of a hull, by the same rule."""
    ship: ah.Hull = request.getfixturevalue(name)
    hand, shapes, state = open_page(ship), ship.shapes(), ship.state
    normals = np.full((shapes.spline.count, 3), np.nan)
    axes = {"sections": (0, [1, 2]), "waterlines": (2, [0, 1]), "buttocks": (1, [0, 2])}
    wanted = dict[int, list[int]]()
    for at, curve in enumerate(shapes.curves.tolist()):
        line = state.curves.line[curve]
        family = state.groups.family[int(state.lines.group[line])]
        if family in axes and state.lines.planar[line]:
            axis, plane = axes[family]
            normals[at] = np.eye(3)[axis]
            wanted[curve] = plane
    counts = dict(
        zip(shapes.curves.tolist(), inflections(shapes.spline, normals)[0].tolist(), strict=True)
    )
    found = hand.ask(
        "async (p, wanted) => { const {inflections} = await import('/hermite.js');"
        " return wanted.map(([id, a, b]) => inflections(p.store.curves.get(id), a, b).length); }",
        [[curve, *plane] for curve, plane in wanted.items()],
    )
    assert found == [counts[curve] for curve in wanted]


def test_lengths_are_compressed_and_a_view_stands_alone(open_page: Open, hull: ah.Hull) -> None:
    """How much taller heights are is said; Esc brings all views back."""
    hand = open_page(hull)
    hand.page.locator(".view-body canvas").last.click(position={"x": 20, "y": 200})
    hand.page.keyboard.press("3")
    hand.settled()
    assert hand.page.locator(".view-body").is_hidden()
    for factor in (2, 5, 10):
        hand.page.keyboard.press("c")
        hand.settled()
        tall = hand.ask("p => p.views.half.sy / p.views.half.axis.s")
        assert abs(tall - factor) < 1e-9, "also where the height of the view has no room to grow"
        for told in (".view-half .note", "[data-action=compress]"):
            words = re.compile(rf"^compressed × {factor}$", re.IGNORECASE)
            expect(hand.page.locator(told)).to_have_text(words)
    hand.page.keyboard.press("Escape")
    hand.page.keyboard.press("Escape")
    hand.settled()
    assert hand.page.locator(".view-body").is_visible()
    hand.page.keyboard.press("k")
    assert not hand.ask("p => p.store.show.combs"), "keys act on, whatever was hidden"


def test_nothing_is_drawn_while_nothing_happens(open_page: Open, hull: ah.Hull) -> None:
    """Not one frame in two seconds, with a point chosen."""
    hand = open_page(hull)
    hand.page.mouse.click(*hand.spot(POINT))
    hand.settled()
    hand.page.mouse.move(5.0, 5.0)
    hand.settled()
    before = hand.ask("p => p.stats.frames")
    hand.page.wait_for_timeout(2000)
    assert hand.ask("p => p.stats.frames") == before


def test_no_name_is_taken_for_markup(open_page: Open, hull: ah.Hull) -> None:
    """Of ship, line, step, author: they are text, wherever they are shown."""
    bad = "<img src=x onerror=alert(1)>"
    twin = hull.snapshot()
    with twin.edit(bad) as edit:
        edit.rename("ST 16", bad)
    hand = open_page(twin, author=bad)
    name = POINT.replace("ST 16", bad)
    hand.page.mouse.click(*hand.spot(name))
    hand.settled()
    hand.page.keyboard.press("ArrowUp")
    hand.until("p => p.store.history.edits === 2")
    hand.page.mouse.move(*hand.spot(name))
    hand.page.wait_for_selector(".tip:not([hidden])")
    expect(hand.page.locator("aside")).to_contain_text(bad, use_inner_text=True)
    expect(hand.page.locator(".view-body .tip")).to_contain_text(bad, use_inner_text=True)
    assert hand.page.locator("img").count() == 0


@pytest.mark.parametrize(("width", "height"), [(320, 640), (390, 844), (720, 420), (1440, 840)])
def test_the_page_fits_the_screen(open_page: Open, hull: ah.Hull, width: int, height: int) -> None:
    """No scrolling sideways, also at 200 % zoom of a small screen; every view is reached."""
    hand = open_page(hull, viewport={"width": width, "height": height})
    assert hand.page.evaluate("document.documentElement.scrollWidth") <= width
    for kind in VIEWS:
        if width <= 900:
            hand.page.locator(f".tabs [data-tab={kind}]").click()
        hand.settled()
        assert hand.page.locator(f".view-{kind}").is_visible()
        assert hand.ask(INK, kind, "lower") > 500


def test_dark_is_dark_and_stays(open_page: Open, hull: ah.Hull) -> None:
    """As the system has it, and as it was chosen, also after a reload."""
    hand = open_page(hull, color_scheme="dark")
    ground = "p => getComputedStyle(p.views.body.element).backgroundColor"
    assert hand.ask(ground) == "rgb(20, 24, 29)"
    theme = hand.page.locator("[data-action=theme]")
    theme.click()
    hand.settled()
    assert hand.ask(ground) == "rgb(253, 252, 249)"
    hand.page.reload()
    hand.page.wait_for_selector(READY)
    assert hand.ask(ground) == "rgb(253, 252, 249)"


def test_what_is_printed_is_the_drawing_on_light_ground(open_page: Open, hull: ah.Hull) -> None:
    """Also from a dark screen, with nothing to press on it; afterwards the screen is as it was."""
    hand = open_page(hull, color_scheme="dark")
    hand.page.emulate_media(media="print", color_scheme="dark")
    hand.page.evaluate("dispatchEvent(new Event('beforeprint'))")
    ground = "p => getComputedStyle(p.views.body.element).backgroundColor"
    assert hand.ask(ground) == "rgb(253, 252, 249)"
    assert hand.page.locator("button:visible, input:visible, aside:visible").count() == 0
    assert hand.page.get_by_role("heading", name="Series 60").is_visible()
    for kind in VIEWS:
        assert hand.page.locator(f".view-{kind}").is_visible()
        assert hand.ask(INK, kind, "lower") > 500
    assert hand.page.pdf().startswith(b"%PDF")
    hand.page.emulate_media(media="screen", color_scheme="dark")
    hand.page.evaluate("dispatchEvent(new Event('afterprint'))")
    assert hand.ask(ground) == "rgb(20, 24, 29)"
    hand.ask("p => p.activeView().upper.focus()")
    with hand.page.expect_download() as download:
        hand.page.keyboard.press("Shift+X")
    assert download.value.suggested_filename.endswith(".pdf")


def test_no_graphics_card_is_needed(open_page: Open, hull: ah.Hull) -> None:
    """Where WebGL and WebGPU are missing all is drawn, and a point is pulled as anywhere."""
    hand = open_page(hull, before=NO_WEBGL)
    assert hand.page.evaluate(
        "['webgl', 'webgl2'].every(k => document.createElement('canvas').getContext(k) === null)"
    )
    for kind in VIEWS:
        assert hand.ask(INK, kind, "lower") > 3000
    hand.near(POINT)
    hand.pull(POINT, 4.0)
    assert len(hull.history) == 1
    assert hand.shows_what_is_published()


def test_every_button_has_a_name_and_every_key_one_effect(open_page: Open, hull: ah.Hull) -> None:
    """The sheet lists all of them; what the browser owns is left to it."""
    hand = open_page(hull)
    actions = hand.ask(
        "async () => (await import('/actions.js')).ACTIONS.map(({id, words, keys}) => [id,"
        " words, keys])"
    )
    keys = [key for _, _, some in actions for key in some]
    assert len(keys) == len(set(keys))
    assert not {
        "Ctrl+t",
        "Ctrl+w",
        "Ctrl+n",
        "Ctrl+l",
        "Ctrl+r",
        *(f"Ctrl+{n}" for n in range(10)),
    } & set(keys)
    assert all(words for _, words, _ in actions)
    hand.page.get_by_role("button", name="Keys").click()
    sheet = hand.page.get_by_role("dialog").inner_text()
    assert [words for _, words, _ in actions if words not in sheet] == []
    hand.page.get_by_role("button", name="Close").click()
    for button in hand.page.locator("button:visible").all():
        assert button.inner_text().strip()
        box = button.bounding_box()
        assert box is not None
        assert min(box["width"], box["height"]) >= 24.0


def test_the_keyboard_alone_finds_pulls_checks_takes_back_and_exports(
    open_page: Open, hull: ah.Hull
) -> None:
    """By name, five millimetres, undone; each step is said, and no pointer is needed."""
    hand, before = open_page(hull), hull.fingerprint
    keys = hand.page.keyboard
    keys.press("/")
    keys.type(POINT.lower())
    keys.press("Enter")
    hand.settled()
    said = hand.page.locator("[aria-live=polite]")
    assert POINT in (said.text_content() or "")
    for _ in range(5):
        keys.press("ArrowUp")
    keys.press("Enter")
    hand.until("p => p.store.history.edits === 1")
    hand.settled()
    assert "curves followed" in (said.text_content() or "")
    keys.press("Shift+P")
    hand.page.get_by_text("Nothing is wrong.").first.wait_for()
    hand.until("p => document.activeElement.textContent.startsWith('Problems')")
    keys.press("/")
    keys.type(POINT)
    keys.press("Enter")
    hand.settled()
    keys.press("]")
    hand.settled()
    assert hand.ask("(p, name) => p.store.selection.row !== p.store.net.find(name)", POINT)
    keys.press("Control+z")
    hand.until("p => p.store.history.edits === 0")
    assert hull.fingerprint == before
    keys.press("x")
    hand.until("p => document.activeElement.textContent === 'Export'")
    keys.press("Tab")  # the choice of the form
    keys.type("Table of offsets, CSV")
    hand.until("p => document.activeElement.value === 'csv'")
    keys.press("Tab")
    with hand.page.expect_download() as download:
        keys.press("Enter")
    assert download.value.suggested_filename == "Series-60-CB-0.70.csv"


def test_fingers_pull_and_zoom(open_page: Open, hull: ah.Hull) -> None:
    """One finger drags a point, two zoom; nothing is edited by the two."""
    hand = open_page(hull, has_touch=True)
    hand.near(POINT)
    x, y = hand.spot(POINT)
    session = hand.page.context.new_cdp_session(hand.page)

    def touch(kind: str, *places: tuple[float, float]) -> None:
        points = [{"x": u, "y": v, "id": i} for i, (u, v) in enumerate(places)]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})

    touch("touchStart", (x, y))
    touch("touchMove", (x + 5, y))
    hand.until("p => p.hand.gripped")
    touch("touchMove", (x + 9, y))
    hand.until("p => p.store.overlay !== null")
    touch("touchEnd")
    hand.settled()
    assert len(hull.history) == 1
    scale = hand.ask("p => p.views.body.axis.s")
    touch("touchStart", (x - 40, y - 60))
    touch("touchStart", (x - 40, y - 60), (x + 40, y - 60))
    touch("touchMove", (x - 80, y - 60), (x + 80, y - 60))
    touch("touchEnd")
    hand.settled()
    assert hand.ask("p => p.views.body.axis.s") > 1.5 * scale
    assert len(hull.history) == 1


def test_a_pen_pulls_and_the_palm_that_follows_does_nothing(open_page: Open, hull: ah.Hull) -> None:
    """A pen says what it is above, drags as a mouse does; touches just after it are of the hand."""
    hand = open_page(hull, has_touch=True)
    hand.near(POINT)
    x, y = hand.spot(POINT)
    session = hand.page.context.new_cdp_session(hand.page)

    def pen(kind: str, u: float, buttons: int) -> None:
        session.send("Input.dispatchMouseEvent", {
            "type": kind, "x": u, "y": y, "buttons": buttons, "pointerType": "pen",
            "button": "left" if kind != "mouseMoved" or buttons else "none", "clickCount": 1,
        })  # fmt: skip

    pen("mouseMoved", x, 0)
    hand.page.wait_for_selector(".view-body .tip:not([hidden])")
    pen("mousePressed", x, 1)
    pen("mouseMoved", x + 5.0, 1)
    hand.until("p => p.hand.gripped")
    pen("mouseMoved", x + 9.0, 1)
    hand.until("p => p.store.overlay !== null")
    pen("mouseReleased", x + 9.0, 0)
    hand.until("p => p.store.history.edits === 1")
    scale = hand.ask("p => p.views.body.axis.s")
    # The clock of the events is that of the browser: the last one of the pen is sent just before.
    pen("mouseMoved", x + 10.0, 0)
    for kind, places in (("touchStart", [(x, y)]), ("touchMove", [(x + 30.0, y)]),
                         ("touchEnd", [])):  # fmt: skip
        points = [{"x": u, "y": v, "id": i} for i, (u, v) in enumerate(places)]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    hand.settled()
    assert hand.ask("p => [p.views.body.axis.s, p.store.held]") == [scale, None]
    assert len(hull.history) == 1


def test_two_hundred_edits_leave_no_heap_behind(open_page: Open, hull: ah.Hull) -> None:
    """What is drawn once is forgotten; the page is as it was, and so is the hull."""
    hand = open_page(hull)
    session = hand.page.context.new_cdp_session(hand.page)

    def heap() -> float:
        session.send("HeapProfiler.collectGarbage")
        return float(session.send("Runtime.getHeapUsage")["usedSize"])

    def edit(count: int) -> None:
        for number in range(count):
            hand.ask("(p, y, name) => p.apply('x', [{op: 'move', point: name, y}])",
                     7.0 + 1e-4 * (number % 2) - 0.11, POINT)  # fmt: skip
        hand.until("(p, n) => p.store.history.edits === n", done[0] + count)
        done[0] += count

    done = [0]
    edit(10)
    before = heap()
    edit(190)
    assert heap() - before < 5e6


@pytest.fixture
def two(open_page: Open, hull: ah.Hull) -> tuple[Hand, Hand]:
    """Two pages of one hull, of two people."""
    first = open_page(hull)
    return first, open_page(server=first.server)


def test_a_second_page_sees_what_the_first_has_made(two: tuple[Hand, Hand]) -> None:
    """As soon as it is published; while one holds a point, the other is told who."""
    first, second = two
    first.near(POINT)
    first.pull(POINT, 4.0)
    second.until("p => p.store.history.edits === 1")
    assert second.shows_what_is_published()
    second.ask("p => p.sign('bert')")
    x, y = first.press(POINT)
    first.to(x + 3.0, y)
    second.until("p => p.store.theirs && p.store.theirs.frame")
    second.settled()
    assert second.ask("p => [p.store.theirs.author, p.store.theirs.frame.curves.size > 10]") == [
        "anna", True,
    ]  # fmt: skip
    held = first.ask("p => [...p.hand.predictor.truth.frame.places.get(p.store.held.row)]")
    assert second.ask("p => [...p.store.theirs.frame.places.get(p.store.theirs.row)]") == held
    expect(second.page.locator("footer")).to_contain_text(
        "anna holds WL 0.625 x ST 16", use_inner_text=True
    )
    second.near(POINT)
    u, v = second.spot(POINT)
    second.page.mouse.move(u, v)
    second.page.mouse.down()
    second.page.wait_for_selector(".bubble")
    expect(second.page.locator(".bubble")).to_contain_text("anna holds", use_inner_text=True)
    second.page.mouse.up()
    first.release()
    second.until("p => p.store.history.edits === 2")
    second.until("p => p.store.theirs === null")
    second.settled()
    assert "anna's" in (second.page.get_by_role("button", name="Undo").get_attribute("title") or "")
    second.page.keyboard.press("Control+z")
    second.page.wait_for_selector(".banner:not([hidden])")
    expect(second.page.locator(".banner")).to_contain_text("bert", use_inner_text=True)
    assert len(first.hull.history) == 2


def test_the_points_of_a_line_stand_in_a_table(open_page: Open, hull: ah.Hull) -> None:
    """In their order along it, each chosen from there; it follows what is committed."""
    hand = open_page(hull)
    hand.page.mouse.click(*hand.spot(POINT))
    hand.page.keyboard.press("a")
    rows = hand.page.locator("aside table tbody tr")
    hand.page.wait_for_selector("aside table")
    shown = rows.all_inner_texts()
    assert len(shown) == len(hull.lines["ST 16"].curves[0].points)
    heights = [float(text.split()[-1]) for text in shown]
    assert heights == sorted(heights) or heights == sorted(heights, reverse=True)
    hand.page.locator("aside table button", has_text="WL 0.5").first.click()
    hand.settled()
    assert hand.ask("p => p.store.net.points.get(p.store.selection.row).name") == "WL 0.5 x ST 16"
    before = rows.all_inner_texts()
    hand.ask("p => p.activeView().upper.focus()")
    hand.page.keyboard.press("Shift+ArrowUp")
    hand.page.keyboard.press("Enter")
    hand.until("p => p.store.history.edits === 1")
    hand.settled()
    assert rows.all_inner_texts() != before


def test_what_is_wrong_is_listed_and_found(open_page: Open, hull: ah.Hull) -> None:
    """Nothing here; what was found is told to be old after an edit."""
    hand = open_page(hull)
    hand.page.mouse.click(*hand.spot(POINT))
    hand.page.keyboard.press("Shift+P")
    hand.until("p => p.panel.problems.found !== null")
    expect(hand.page.locator("aside")).to_contain_text("Nothing is wrong.", use_inner_text=True)
    hand.ask("p => p.activeView().upper.focus()")
    hand.page.keyboard.press("ArrowUp")
    hand.page.keyboard.press("Enter")
    hand.until("p => p.store.history.edits === 1")
    hand.settled()
    expect(hand.page.locator("aside")).to_contain_text("before the last edit", use_inner_text=True)


NAMED = "(p, kind) => p.views[kind].written.slice(1).map(({text, box}) => [text, ...box])"
"""The names on a drawing, and the room that each takes: left, top, right, bottom."""


def test_names_in_the_body_plan_belong_to_one_line(open_page: Open, bulk_carrier: ah.Hull) -> None:
    """Each family is named; none stands over the centre plane, where aft and fore body meet."""
    hand = open_page(bulk_carrier.snapshot())
    written = hand.ask(NAMED, "body")
    assert {"ST", "WL", "BTK", "DWL", "BL"} <= {text for text, *_ in written}
    middle, deck = hand.ask(
        "p => { const v = p.views.body, b = v.box(); return v.at(0, 0, b.z1, 1); }"
    )
    low = hand.ask("p => p.views.body.at(0, 0, 0, 1)[1]")
    over = [text for text, left, top, right, _ in written
            if deck < top < low and left < middle < right]  # fmt: skip
    assert over == []
    # It has a bulb and a stem above it: its name is at the deck.
    assert any(text == "20.04" and foot < deck for text, *_, foot in written)


@pytest.mark.parametrize("looks", [{}, {"viewport": {"width": 1100, "height": 700}}])
@pytest.mark.parametrize("name", ["series60_70", "bulk_carrier"])
def test_every_line_is_named_in_its_own_view(
    open_page: Open, name: str, looks: dict[str, Any], request: pytest.FixtureRequest
) -> None:
    """Also where lines lie three pixels apart; names lie on no other name and within the view."""
    ship = request.getfixturevalue(name).snapshot()
    hand = open_page(ship, **looks)
    for kind, family in (("body", "ST"), ("profile", "BTK"), ("half", "WL")):
        wanted = {each.removeprefix(f"{family} ") for each in ship.lines if each.startswith(family)}
        written = hand.ask(NAMED, kind)
        width, height = hand.ask("(p, kind) => [p.views[kind].width, p.views[kind].height]", kind)
        foot = hand.ask("(p, kind) => p.views[kind].at(0, 0, p.views[kind].box().z0, 1)[1]", kind)
        lines = [each for each in written if each[4] < foot + 1.0]
        assert wanted - {text.removeprefix(f"{family} ") for text, *_ in lines} == set()
        boxes = np.array([each[1:] for each in written])
        assert boxes.min() >= 0.0
        assert (boxes[:, 2:] <= [width, height]).all()
        # Those that share more than an edge.
        low, high = boxes[:, None, :2] + 0.1, boxes[:, None, 2:] - 0.1
        both = ((low < boxes[None, :, 2:]) & (high > boxes[None, :, :2])).all(axis=-1)
        assert both.sum() == len(written)


@pytest.mark.parametrize("factor", [5, 10])
def test_every_line_is_named_where_lengths_are_compressed(
    open_page: Open, bulk_carrier: ah.Hull, factor: int
) -> None:
    """The ship fills her view; buttocks stand above their ends, in the order of the ship."""
    hand = open_page(bulk_carrier.snapshot(), viewport={"width": 1440, "height": 900})
    hand.ask("(p, factor) => p.compress(factor)", factor)
    hand.settled()
    for kind, family in (("profile", "BTK"), ("half", "WL")):
        wide, high = hand.ask(
            "(p, kind) => { const v = p.views[kind], [l, t, r, b] = v.margins, [u0, u1, v0, v1] ="
            " v.extent(); return [v.axis.s * (u1 - u0) / (v.width - l - r),"
            " v.sy * (v1 - v0) / (v.height - t - b)]; }", kind,
        )  # fmt: skip
        assert max(wide, high) > 0.7, "else most of the view is empty"
        written = hand.ask(NAMED, kind)
        foot = hand.ask("(p, kind) => p.views[kind].at(0, 0, 0, 1)[1]", kind)
        names = [each.split()[1] for each in bulk_carrier.lines if each.startswith(family)]
        above = [each for each in written if each[0] in names and each[4] < foot and each[1] > 46.0]
        assert len({text for text, *_ in above}) > 0.9 * len(names)
    middle = hand.ask("p => p.views.profile.at(p.views.profile.midship, 0, 0, 1)[0]")
    deck = hand.ask("p => p.views.profile.at(0, 0, p.views.profile.box().z1, 1)[1]")
    upright = sorted((left, float(text)) for text, left, _, right, foot in
                     hand.ask(NAMED, "profile") if foot < deck and right - left < 11.0)  # fmt: skip
    aft, fore = ([y for x, y in upright if (x < middle) == side] for side in (True, False))
    assert len(aft) > 8
    assert len(fore) > 8
    assert aft == sorted(aft)
    assert fore == sorted(fore, reverse=True)


@pytest.mark.parametrize("factor", [1, 2, 5, 10])
@pytest.mark.parametrize("name", ["series60_70", "bulk_carrier"])
def test_waterlines_stand_above_the_half_breadth_plan_in_their_order(
    open_page: Open, name: str, factor: int, request: pytest.FixtureRequest
) -> None:
    """From the highest to the lowest aft, and back to the highest fore, however compressed."""
    hand = open_page(request.getfixturevalue(name).snapshot())
    hand.ask("(p, factor) => p.compress(factor)", factor)
    hand.settled()
    top = hand.ask(
        "p => { const v = p.views.half, b = v.box(); return v.at(b.x1, b.y1, b.z1, 1)[1]; }"
    )
    heights = {text.removeprefix("WL "): float(text.removeprefix("WL "))
               for text in hand.ask("p => p.store.net.lines.filter(l => l.family === 'waterlines')"
                                    ".map(l => l.name)")}  # fmt: skip
    row = sorted((left + right, heights[text]) for text, left, _, right, foot in
                 hand.ask(NAMED, "half") if text in heights and foot < top - 2.0)  # fmt: skip
    found = [height for _, height in row]
    lowest = found.index(min(found))
    assert len(found) > 15
    assert found[: lowest + 1] == sorted(found[: lowest + 1], reverse=True)
    assert found[lowest:] == sorted(found[lowest:])


def test_names_of_waterlines_stand_clear_of_the_leaders_of_buttocks(
    open_page: Open, bulk_carrier: ah.Hull
) -> None:
    """Where lengths are compressed these come out at the transom, and the names stand fore."""
    hand = open_page(bulk_carrier.snapshot())
    for factor in (5, 10):
        hand.ask("(p, factor) => p.compress(factor)", factor)
        hand.settled()
        fore, width = hand.ask(
            "p => { const v = p.views.profile; return [v.at(v.box().x1, 0, 0, 1)[0], v.width]; }"
        )
        column = [each for each in hand.ask(NAMED, "profile") if each[0] in {"WL", "DWL", "BL"}]
        assert len(column) == 3
        assert all(left > fore and right < width for _, left, _, right, _ in column)


def test_borders_and_families_are_named(open_page: Open, bulk_carrier: ah.Hull) -> None:
    """Deck edge, transom and both flats, where each is seen; from near a name has its family."""
    hand = open_page(bulk_carrier.snapshot())
    written = {kind: {text for text, *_ in hand.ask(NAMED, kind)}
               for kind in ("body", "profile", "half")}  # fmt: skip
    assert {"deck edge", "transom", "ST", "WL", "BTK"} <= written["body"]
    assert {"deck edge", "flat of side", "WL", "BTK"} <= written["profile"]
    assert {"deck edge", "flat of bottom", "WL", "BTK"} <= written["half"]
    hand.ask("p => { p.views.profile.centre([295, 2, 10], 20); p.store.changed('hull'); }")
    hand.settled()
    assert any(text.startswith("BTK ") for text, *_ in hand.ask(NAMED, "profile"))
    assert any(text.startswith("WL ") for text, *_ in hand.ask(NAMED, "half"))


@pytest.mark.parametrize("scale", [8.0, 20.0, 40.0])
@pytest.mark.parametrize("name", ["series60_70", "bulk_carrier"])
def test_every_buttock_is_named_where_the_bow_is_seen_from_near(
    open_page: Open, name: str, scale: float, request: pytest.FixtureRequest
) -> None:
    """Steep lines, lines with all their points drawn, and bundles too."""
    hand = open_page(request.getfixturevalue(name).snapshot())
    hand.ask(
        "(p, scale) => { const {length, draught} = p.store.net.particulars;"
        " p.views.profile.centre([length, 0, 0.6 * draught], scale);"
        " p.store.changed('hull', 'overlay'); }", scale,
    )  # fmt: skip
    hand.settled()
    seen = hand.ask(
        "async p => { const {pathsOf} = await import('/view.js'), v = p.views.profile, long = {};"
        " for (const {id, path} of pathsOf(v)) { const {name, family} = p.store.net.lineOf(id);"
        " if (family !== 'buttocks') continue; for (let i = 0; i + 3 < path.length; i += 2) {"
        " const [a, b, c, d] = path.slice(i, i + 4); if (a > 44 && a < v.width && b > 0"
        " && b < v.height - 34) long[name] = (long[name] ?? 0) + Math.hypot(c - a, d - b); } }"
        " return long; }"
    )
    named = {text.removeprefix("BTK ") for text, *_ in hand.ask(NAMED, "profile")}
    assert len(seen) > 5
    assert [each for each, far in seen.items() if far > 60.0 and each[4:] not in named] == []


def test_names_with_leaders_stand_in_the_order_of_their_lines(
    open_page: Open, hull: ah.Hull
) -> None:
    """Also where a chosen section has taken the room of one of them."""
    pull = {"op": "pull", "point": "WL 0.35 x ST 17", "d": 0.1123, "radius": [15.2, 6.1]}
    hull.apply("pull", [pull])
    hand = open_page(hull, viewport={"width": 1440, "height": 900})
    point, line = "p.store.net.find('WL 0.35 x ST 17')", "p.store.net.findCurve('ST 17')"
    for choose in ("", f"p.store.select({point}, {line})"):
        hand.ask(f"p => {{ {choose} }}")
        hand.settled()
        top, middle = hand.ask(
            "p => { const v = p.views.profile, b = v.box();"
            " return [v.at(0, 0, b.z1, 1)[1], v.at(v.midship, 0, 0, 1)[0]]; }"
        )
        above = sorted((left + right, text) for text, left, _, right, foot in
                       hand.ask(NAMED, "profile") if foot < top and text != "BTK")  # fmt: skip
        aft = [float(text) for x, text in above if x < 2.0 * middle]
        assert len(aft) > 5
        assert aft == sorted(aft)


def test_lines_along_the_ship_are_named_in_either_half(
    open_page: Open, bulk_carrier: ah.Hull
) -> None:
    """Most buttocks of the profile are, and most waterlines of the half-breadth plan aft."""
    hand = open_page(bulk_carrier.snapshot())
    for kind, family, fore in (("profile", "BTK ", 0.5), ("half", "WL ", 0.05)):
        middle = hand.ask("(p, kind) => p.views[kind].at(150, 0, 0, 1)[0]", kind)
        foot = hand.ask("(p, kind) => p.views[kind].at(0, 0, 0, 1)[1]", kind)
        names = {name.split()[1] for name in bulk_carrier.lines if name.startswith(family)}
        here = [(each[0], each[1]) for each in hand.ask(NAMED, kind)
                if each[0] in names and each[1] > 44.0 and each[4] < foot]  # fmt: skip
        assert len({text for text, x in here if x < middle}) > 0.6 * len(names)
        assert len({text for text, x in here if x > middle}) > fore * len(names)


def test_no_point_that_is_drawn_and_no_mark_covers_a_name(open_page: Open, hull: ah.Hull) -> None:
    """Of the chosen line, of all lines from near, and of a place that a finding names."""
    hand = open_page(hull)
    covered = (
        "async (p, kind) => { const {dotsOf} = await import('/marks.js'), v = p.views[kind],"
        " spots = dotsOf(v).map((row) => [...v.atPlace(p.store.placeOf(row)), 3])"
        ".filter(([x, y]) => !v.framed(x, y));"
        " if (p.store.marked) spots.push([...v.atPlace(p.store.marked), 20]);"
        " return [spots.length, v.written.slice(1).filter(({box: [l, t, r, b]}) => spots.some("
        "([x, y, reach]) => x > l - reach && x < r + reach && y > t + 3 - reach"
        " && y < b - 3 + reach)).map(({text}) => text)]; }"
    )
    hand.page.mouse.click(*hand.spot(POINT))
    hand.settled()
    drawn, under = hand.ask(covered, "body")
    assert drawn > 15
    assert under == []
    hand.near("WL 0.75 x ST 1", scale=150.0)
    drawn, under = hand.ask(covered, "body")
    assert drawn > 50
    assert under == []
    hand.ask("(p, name) => p.goTo(name, null)", POINT)
    hand.settled()
    assert hand.ask(covered, "body")[1] == []


def test_a_narrow_screen_gives_half_of_its_height_to_the_drawing(
    open_page: Open, hull: ah.Hull
) -> None:
    """The hull fills its width, and lies in its middle; the panel begins below it."""
    hand = open_page(hull, viewport={"width": 390, "height": 844})
    for kind in VIEWS:
        hand.page.locator(f".tabs [data-tab={kind}]").click()
        hand.settled()
        assert hand.ask("(p, kind) => p.views[kind].height", kind) >= 422
    hand.page.locator(".tabs [data-tab=body]").click()
    hand.settled()
    high, left, right, top, foot = hand.ask(
        "p => { const v = p.views.body, b = v.box(), [l, t] = v.at(0, b.y1, b.z1, -1),"
        " [r, f] = v.at(1e3, b.y1, b.z0, 1); return [v.height, l, r, t, f]; }"
    )
    assert right - left > 0.8 * 390.0
    assert abs(top - (high - foot)) < 30.0
    assert hand.ask("p => p.views.body.written.length") > 40


def test_the_buttons_stay_where_they_are_when_one_changes_its_words(
    open_page: Open, hull: ah.Hull
) -> None:
    """Compressed by 10 is a longer word than not compressed."""
    hand = open_page(hull)
    boxes = "p => [...document.querySelectorAll('.bar button')].map(b => b.offsetLeft)"
    before = hand.ask(boxes)
    hand.ask("p => p.compress(10)")
    hand.settled()
    assert hand.ask(boxes) == before


def test_a_ghost_of_other_knots_is_drawn_only_where_it_lies_elsewhere(
    open_page: Open, hull: ah.Hull
) -> None:
    """A point more in a line is no movement of all of it."""
    hand = open_page(hull)
    hand.ask(
        "p => { const id = p.store.net.findCurve('WL 0.625'), c = p.store.curves.get(id),"
        " i = 3 * (c.n >> 2), place = [0, 1, 2].map(j => (c.xyz[i + j] + c.xyz[i + 3 + j]) / 2);"
        " place[1] += 0.05; p.panel.proposal.show('more', [{op: 'insert', curve: 'WL 0.625',"
        " place, lead: true}]); }"
    )
    hand.until("p => p.store.ghost")
    other, moved = hand.ask(
        "async p => { const {middleMovement} = await import('/hermite.js');"
        " const id = p.store.net.findCurve('WL 0.625'), now = p.store.ghost.curves.get(id),"
        " then = p.store.curves.get(id);"
        " return [now.n - then.n, [...middleMovement(then, now)]]; }"
    )
    assert other != 0
    assert max(moved) > 0.01
    assert sum(far < 1e-4 for far in moved) > len(moved) / 3


def test_a_chosen_line_is_seen_in_every_drawing(open_page: Open, hull: ah.Hull) -> None:
    """A waterline as a straight line in the body plan and the profile, a station in the others."""
    hand = open_page(hull)
    for name, kinds in (("WL 0.625", ("body", "profile")), ("ST 4", ("profile", "half"))):
        for kind in kinds:
            hand.ask("(p, kind) => { p.store.select(null, null); p.active = kind; }", kind)
            hand.settled()
            before = hand.ask(INK, kind, "upper")
            hand.ask("(p, name) => p.store.select(null, p.store.net.findCurve(name))", name)
            hand.settled()
            size = hand.ask(
                "(p, kind) => Math.min(p.views[kind].width, p.views[kind].height)", kind
            )
            assert hand.ask(INK, kind, "upper") > before + 0.3 * size


def test_combs_end_within_their_drawing(open_page: Open, hull: ah.Hull) -> None:
    """However long they are made, no tooth whose foot is seen runs over the edge."""
    hand = open_page(hull)
    hand.ask("p => { p.find('WL 0.625'); p.store.gain = 40; p.store.changed('overlay'); }")
    hand.settled()
    assert hand.ask(INK, "half", "upper") > 5000
    at_edge = hand.ask(
        "p => { const c = p.views.half.upper, t = new OffscreenCanvas(c.width, c.height),"
        " g = t.getContext('2d', {willReadFrequently: true}); g.drawImage(c, 0, 0); let n = 0;"
        " for (const [x, y, w, h] of [[0, 0, c.width, 1], [0, c.height - 1, c.width, 1],"
        " [0, 0, 1, c.height], [c.width - 1, 0, 1, c.height]]) {"
        " const d = g.getImageData(x, y, w, h).data;"
        " for (let i = 3; i < d.length; i += 4) if (d[i] > 40) n++; } return n; }"
    )
    assert at_edge == 0


def test_movement_is_drawn_by_one_factor_that_is_told_once(open_page: Open, hull: ah.Hull) -> None:
    """In all drawings, in the line below; none where nothing is shown to move."""
    hand = open_page(hull)
    hand.near(POINT, scale=40.0)
    x, y = hand.press(POINT)
    hand.to(x + 1.0, y)
    foot = hand.page.locator(".page > footer")
    expect(foot).to_contain_text(re.compile(r"movement is drawn × [\d,]+ ·"), use_inner_text=True)
    assert hand.ask("p => p.store.magnified") > 1
    for kind in VIEWS:
        expect(hand.page.locator(f".view-{kind} .note")).to_have_text("")
    hand.page.keyboard.press("Escape")
    hand.page.mouse.up()
    hand.settled()
    expect(foot).not_to_contain_text("movement", use_inner_text=True)


def test_a_refusal_is_read_from_its_first_word(open_page: Open, hull: ah.Hull) -> None:
    """Its bubble lies within the drawing, however much it says."""
    hand = open_page(hull)
    x, y = hand.press(POINT)
    hand.page.mouse.move(x + 30.0, y)
    hand.until("p => p.store.refusal && p.pending === 0")
    bubble, view = (hand.page.locator(each).bounding_box() for each in (".bubble", ".view-body"))
    assert bubble is not None
    assert view is not None
    assert bubble["y"] >= view["y"]
    assert bubble["y"] + bubble["height"] <= view["y"] + view["height"]
    assert bubble["x"] >= view["x"]
    hand.page.keyboard.press("Escape")
    hand.page.mouse.up()
    hand.settled()


def test_one_view_alone_shows_the_place_that_was_looked_at(open_page: Open, hull: ah.Hull) -> None:
    """What was zoomed stays in the middle at its scale, there and back, and in another window."""
    hand = open_page(hull)
    hand.near(POINT)
    for act in ("1", "1", ""):
        if act:
            hand.page.locator(".view-body canvas").last.press(act)
        else:
            hand.page.set_viewport_size({"width": 1100, "height": 700})
            hand.until("p => p.pending === 0 && p.views.body.upper.width < 641")
        hand.settled()
        place, scale = hand.spot(POINT), hand.ask("p => p.views.body.axis.s")
        box = hand.page.locator(".view-body").bounding_box()
        assert box is not None
        assert abs(place[0] - box["x"] - box["width"] / 2) < 2.0
        assert abs(place[1] - box["y"] - box["height"] / 2) < 2.0
        assert abs(scale - 400.0) < 1e-6
