"""Panels beside the drawing: history, why, hydrostatics, areas; nothing changes unasked."""

import re

from playwright.sync_api import Locator, expect

import assoc_hull as ah
from tests.browser.conftest import Hand, Open
from tests.net_strategies import fresh

POINT = "WL 0.625 x ST 16"


def opened(hand: Hand, title: str) -> Locator:
    """Open a panel by its heading."""
    box = hand.page.locator(f"details:has(h2:text-is('{title}'))")
    box.locator("summary").click()
    return box


def pull(hand: Hand, metres: float) -> None:
    """Pull at a point, as its page would."""
    hand.ask(
        "(p, name, d) => p.apply('pull by hand', [{op: 'pull', point: name, d, radius: [15, 5]}])",
        POINT, metres,
    )  # fmt: skip
    hand.until("p => p.store.last && p.store.history.edits > 0")


def test_the_history_goes_back_and_compares(open_page: Open, hull: ah.Hull) -> None:
    """A ghost shows the state of then, Esc removes it; going there and back loses nothing."""
    before = hull.fingerprint
    hand = open_page(hull)
    pull(hand, 0.02)
    after, box = hull.fingerprint, opened(hand, "History")
    box.get_by_text("pull by hand").wait_for()
    expect(box.locator("li").first).to_contain_text("anna", use_inner_text=True)
    box.get_by_label("compare with the hull as it came").click()
    box.get_by_text("Dashed: the hull as it was then").wait_for()
    assert hand.ask("p => p.store.ghost.curves.size") > 20
    assert hull.fingerprint == after
    hand.page.keyboard.press("Escape")
    assert hand.ask("p => p.store.ghost === null")
    box.get_by_role("button", name="the hull as it came", exact=True).click()
    hand.until("p => p.store.history.edits === 0")
    assert hull.fingerprint == before
    box.get_by_text("taken back").wait_for()
    box.get_by_role("button", name="pull by hand", exact=True).click()
    hand.until("p => p.store.history.edits === 1")
    assert hull.fingerprint == after
    box.get_by_label("name of the present state").fill("fuller")
    box.get_by_text("Keep under this name").click()
    box.get_by_text("“fuller”").wait_for()
    assert "fuller" in hull.labels
    assert hull.labels["fuller"].author == "anna"


def test_an_edit_made_after_an_undo_leaves_a_branch(open_page: Open, hull: ah.Hull) -> None:
    """What was left stands in the list, is compared with, and is gone back to, to the bit."""
    hand = open_page(hull)
    box = opened(hand, "History")
    pull(hand, 0.02)
    left = hull.fingerprint
    hand.page.keyboard.press("Control+z")
    hand.until("p => p.store.history.edits === 0")
    hand.ask("(p, name) => p.apply('the other way', [{op: 'pull', point: name, d: -0.02}])", POINT)
    hand.until("p => p.store.history.edits === 1")
    now = hull.fingerprint
    branch = box.locator("li", has_text="on a branch from step 0").first
    branch.get_by_label("compare with pull by hand").click()
    box.get_by_text("Dashed: the hull as it was then").wait_for()
    assert hull.fingerprint == now
    branch.get_by_role("button", name="pull by hand", exact=True).click()
    hand.until("p => p.store.history.redo === null && p.store.history.undo === 'pull by hand'")
    hand.settled()
    assert hull.fingerprint == left
    assert hand.shows_what_is_published()
    box.locator("li", has_text="on a branch").get_by_role(
        "button", name="the other way", exact=True
    ).click()
    hand.until("p => p.store.history.undo === 'the other way'")
    assert hull.fingerprint == now


def test_comparing_right_after_an_edit_is_answered(open_page: Open, hull: ah.Hull) -> None:
    """The list is renewed a moment after each edit: neither answer is lost to the other."""
    hand = open_page(hull)
    pull(hand, 0.02)
    box = opened(hand, "History")
    box.get_by_text("pull by hand").first.wait_for()
    hand.ask(
        "async (p, name) => { p.apply('once more', [{op: 'pull', point: name, d: 0.01}]);"
        " while (p.store.history.edits < 2) await new Promise(done => setTimeout(done, 5));"
        " p.panel.past.list.querySelector('[aria-label^=compare]').click(); }", POINT,
    )  # fmt: skip
    box.get_by_text("Dashed: the hull as it was then").wait_for()
    box.get_by_text("once more").first.wait_for()
    assert hand.ask("p => p.store.ghost.curves.size") > 20


def test_going_back_over_edits_of_others_is_refused_in_the_history(
    open_page: Open, hull: ah.Hull
) -> None:
    """The refusal names whose they are, in the panel, and the hull stays."""
    hand = open_page(hull)
    hull.author = "bert"
    pull(hand, 0.02)
    hand.ask("p => p.sign('clara')")
    after, box = hull.fingerprint, opened(hand, "History")
    box.get_by_role("button", name="the hull as it came", exact=True).click()
    box.get_by_text("'pull by hand' of anna").wait_for()
    assert hull.fingerprint == after


def test_why_leads_to_the_causes(open_page: Open, hull: ah.Hull) -> None:
    """What moved a line is told as a tree, and a click on a cause chooses it."""
    hand = open_page(hull)
    pull(hand, 0.02)
    box = opened(hand, "Why")
    hand.ask("p => p.find('ST 16')")
    box.get_by_text("pull by hand").wait_for()
    box.locator("li li").get_by_role("button", name=POINT, exact=True).click()
    assert hand.ask("p => p.store.net.points.get(p.store.selection.row).name") == POINT
    box.get_by_text("set by the edit").first.wait_for()


def test_hydrostatics_tell_what_changed_since_the_session_began(
    open_page: Open, hull: ah.Hull
) -> None:
    """Values have units, the change is that of the kernel, and the areas are drawn for both."""
    volume = hull.hydrostatics().volume
    hand = open_page(hull)
    pull(hand, 0.05)
    box = opened(hand, "Hydrostatics")
    box.locator("table").wait_for()
    row = box.locator("tr").first
    more = hull.hydrostatics().volume - volume
    expect(row).to_contain_text(f"+{more:.2f} m³", use_inner_text=True)
    assert box.locator("svg polyline").count() == 2
    assert box.locator("svg rect").count() > 2


def test_a_button_stays_under_the_pointer_while_an_answer_comes(
    open_page: Open, hull: ah.Hull
) -> None:
    """What an answer shows above waits until the button is let go, and then is shown."""
    hand = open_page(hull)
    box, numbers = opened(hand, "Fair"), opened(hand, "Hydrostatics")
    numbers.locator("table").wait_for()
    hand.ask("p => p.panel.numbers.list.replaceChildren()")
    place = box.get_by_text("List the waviest lines")
    place.hover()
    hand.page.mouse.down()
    hand.ask("p => p.panel.numbers.ask({t: 'hydrostatics'}, 'Measuring …')")
    at = place.bounding_box()
    hand.until("p => p.panel.waiting.length > 0")
    assert place.bounding_box() == at
    place.hover()  # what was asked has moved it
    hand.page.mouse.up()
    for each in (box, numbers):
        each.locator("table").wait_for()


def test_a_hull_that_is_sound_is_said_to_be(open_page: Open, hull: ah.Hull) -> None:
    """The list tells when nothing is wrong."""
    hand = open_page(hull)
    box = opened(hand, "Problems")
    box.get_by_text("Check the hull").click()
    box.get_by_text("Nothing is wrong.").wait_for()
    assert hull.check() == ()
    expect(box.locator("summary")).to_have_text("Problems", use_inner_text=True)
    assert box.locator("button.link").count() == 0


def test_the_bubble_of_a_refusal_goes_with_undo(open_page: Open, hull: ah.Hull) -> None:
    """What was refused is past then; nothing of it lies over the drawing."""
    hand = open_page(hull)
    pull(hand, 0.02)
    hand.ask("(p, name) => p.find(name)", POINT)
    hand.ask("(p, name) => p.apply('far', [{op: 'move', point: name, y: 400}])", POINT)
    hand.page.wait_for_selector(".bubble")
    hand.ask("p => p.undo()")
    hand.until("p => p.store.history.edits === 0")
    assert hand.page.locator(".bubble").count() == 0


def test_an_export_is_told_in_sentences(open_page: Open, hull: ah.Hull) -> None:
    """As the command tells it: nothing of objects, nor where the server had the file."""
    hand = open_page(hull)
    box = opened(hand, "Export")
    with hand.page.expect_download():
        hand.ask("p => p.panel.files.write('csv')")
    box.get_by_text("lines in").wait_for()
    words = box.inner_text()
    assert "Report(" not in words
    assert "/tmp" not in words


def test_what_was_refused_last_stands_among_the_problems(open_page: Open, hull: ah.Hull) -> None:
    """Also when its bubble has gone; it is counted, a click goes there, an edit ends it."""
    hand = open_page(hull)
    box = opened(hand, "Problems")
    hand.ask("(p, name) => p.find(name)", POINT)
    hand.ask("(p, name) => p.apply('far', [{op: 'move', point: name, y: 400}])", POINT)
    hand.page.wait_for_selector(".bubble")
    hand.page.keyboard.press("Escape")
    hand.page.wait_for_selector(".bubble", state="detached")
    reason = box.locator("button.link").first
    expect(box.locator("summary")).to_have_text("Problems 1", use_inner_text=True)
    hand.page.keyboard.press("Escape")
    assert hand.ask("p => p.store.selection.row") is None
    reason.click()
    assert hand.ask("p => p.store.net.points.get(p.store.selection.row).name") == POINT
    pull(hand, 0.01)
    reason.wait_for(state="detached")
    expect(box.locator("summary")).to_have_text("Problems", use_inner_text=True)


def test_what_was_refused_is_past_after_an_undo(open_page: Open, hull: ah.Hull) -> None:
    """Also where there was an edit before it to take back: the panel counts no problem."""
    hand = open_page(hull)
    box = opened(hand, "Problems")
    pull(hand, 0.01)
    hand.ask("(p, name) => p.find(name)", POINT)
    hand.ask("(p, name) => p.apply('far', [{op: 'move', point: name, y: 400}])", POINT)
    expect(box.locator("summary")).to_have_text("Problems 1")
    hand.ask("p => p.undo()")
    hand.until("p => p.store.history.edits === 0")
    expect(box.locator("summary")).to_have_text("Problems")


def test_the_curve_of_areas_runs_from_one_end_of_the_water_line_to_the_other(
    open_page: Open, bulk_carrier: ah.Hull
) -> None:
    """Aft of AP and forward of FP too, where no station stands; both perpendiculars are marked."""
    hand = open_page(bulk_carrier.snapshot())
    box = opened(hand, "Hydrostatics")
    picture = box.locator("svg")
    expect(picture).to_contain_text("AP")
    expect(picture).to_contain_text("FP")
    told = picture.locator("text").all_text_contents()
    low, high = (re.search(r"-?[\d.]+", text) for text in told if text.endswith(" m"))
    assert low is not None
    assert high is not None
    assert float(low[0]) < -3.0
    assert float(high[0]) > bulk_carrier.particulars.length + 5.0
    ends = picture.locator("polyline.now").get_attribute("points") or ""
    heights = [float(each.split(",")[1]) for each in ends.split()]
    assert heights[0] == heights[-1] == max(heights)


def test_volume_has_one_word_and_one_symbol(open_page: Open, hull: ah.Hull) -> None:
    """While a point is pulled, in an answer that is only shown, and among the hydrostatics."""
    hand = open_page(hull)
    numbers, edit = (
        opened(hand, "Hydrostatics"),
        hand.page.locator("details:has(h2:text-is('Edit'))"),
    )
    expect(numbers.locator("tr").first).to_contain_text("∇")
    expect(numbers.locator("tr").first).to_have_attribute("title", re.compile("volume"))
    hand.near(POINT)
    x, y = hand.press(POINT)
    hand.to(x + 3.0, y)
    expect(edit).to_contain_text("volume ∇", use_inner_text=True)
    hand.page.keyboard.press("Escape")
    hand.page.mouse.up()
    hand.settled()
    ops = [{"op": "pull", "point": POINT, "d": 0.005, "radius": [15.0, 5.0]}]
    hand.ask("(p, ops) => p.panel.proposal.show('pull', ops)", ops)
    told = hand.page.locator("details:has(h2:text-is('Proposal'))")
    expect(told).to_contain_text(re.compile(r"volume ∇ [+−±][\d.]+ m³"), use_inner_text=True)


def test_the_page_uses_no_word_of_its_program(open_page: Open, hull: ah.Hull) -> None:
    """Where a point is chosen and held, and where lines are listed that are to be faired."""
    hand = open_page(hull)
    words = re.compile(r"(?<!@ )\b(kernel|adopted|noise|turns|sort)\b")  # names are as given
    box = opened(hand, "Fair")
    box.get_by_role("button", name="List the waviest lines").click()
    expect(box.locator("table")).to_contain_text("inflections")
    expect(box).to_contain_text("Take out waviness of", use_inner_text=True)
    hand.near(POINT)
    x, y = hand.press(POINT)
    hand.to(x + 3.0, y)
    expect(hand.page.locator(".page > footer")).to_contain_text("computed in", use_inner_text=True)
    expect(hand.page.locator(".page")).not_to_contain_text(words, use_inner_text=True)
    hand.page.keyboard.press("Escape")
    hand.page.mouse.up()
    hand.settled()


def test_points_that_define_a_line_are_told_from_those_on_it(
    open_page: Open, hull: ah.Hull
) -> None:
    """Beside the line, and above the table that lists all of them."""
    hand = open_page(hull)
    hand.ask("p => p.find('WL 0.5')")
    curve = hull.lines["WL 0.5"].curves[0]
    on, define = len(curve.points), hand.ask("p => p.store.curveNow(p.store.selection.curve).n")
    assert on > define
    expect(hand.page.locator("details:has(h2:text-is('Curve'))")).to_contain_text(
        f"{define} define it, {on} lie on it", use_inner_text=True
    )
    table = opened(hand, "Points").locator("table")
    expect(table.locator("caption")).to_contain_text(f"{on} points lie on WL 0.5")
    expect(table.locator("tbody tr")).to_have_count(on)


def test_a_click_on_a_problem_goes_to_its_place(open_page: Open) -> None:
    """All drawings come to it, near enough to see it; it is marked until Esc."""
    hull = fresh(10)
    with hull.edit("bend", gaps="report") as edit:
        edit.move("WL 3.234 x ST 1", y=hull.points["WL 3.234 x ST 1"].y + 0.1)
    gap = next(each for each in hull.check() if each.kind == "gap")
    hand = open_page(hull)
    hand.ask("p => p.activeView().upper.focus()")
    hand.page.keyboard.press("Shift+P")
    hand.page.locator("aside").get_by_role("button", name=str(gap)[:40]).first.click()
    hand.settled()
    assert gap.place is not None
    assert hand.ask("p => p.store.marked") == list(gap.place)
    for kind in ("body", "profile", "half"):
        off = hand.ask(
            "(p, kind) => { const v = p.views[kind], [x, y] = v.atPlace(p.store.marked);"
            " return [x - v.width / 2, y - v.height / 2, v.axis.s]; }", kind,
        )  # fmt: skip
        assert abs(off[0]) < 1.0
        assert abs(off[1]) < 1.0
        assert off[2] > 59.0
    hand.ask("p => p.activeView().upper.focus()")
    hand.page.keyboard.press("Escape")
    assert hand.ask("p => p.store.marked === null")


def test_a_burst_of_arrows_is_made_before_what_is_asked_then(
    open_page: Open, hull: ah.Hull
) -> None:
    """Whoever compares, names a state or types a value at once loses no step of the arrows."""
    hand = open_page(hull)
    pull(hand, 0.02)
    box = opened(hand, "History")
    box.get_by_text("pull by hand").first.wait_for()
    for edits, act in enumerate(("compare", "keep", "type"), start=2):
        hand.ask("(p, name) => p.find(name)", POINT)
        hand.ask("p => p.activeView().upper.focus()")
        hand.page.keyboard.press("ArrowUp")
        hand.until("p => p.hand.gripped")
        if act == "compare":
            hand.ask("p => p.panel.past.list.querySelector('[aria-label^=compare]').click()")
        elif act == "keep":
            box.get_by_label("name of the present state").fill("nudged")
            box.get_by_text("Keep under this name").click()
        else:
            edits += 1
            hand.ask("(p, name) => p.apply('typed', [{op: 'pull', point: name, d: 0.01}])", POINT)
        hand.until("(p, n) => p.hand.free && p.store.history.edits === n", edits)
        assert hand.ask("p => p.store.problem") is None


def test_the_points_of_every_line_fit_the_panel(open_page: Open, bulk_carrier: ah.Hull) -> None:
    """Both coordinates of a line in a plane, all three of another; the panel is not cut."""
    hand = open_page(bulk_carrier.snapshot())
    hand.ask("p => p.find('ST 18')")
    box = opened(hand, "Points")
    box.locator("caption").get_by_text("all at x = 270.000").wait_for()
    expect(box.locator("th")).to_have_text(["point", "y", "z"], use_inner_text=True)
    fits = (
        "(([aside]) => aside.scrollWidth <= aside.clientWidth)(document.querySelectorAll('aside'))"
    )
    for name in ("ST 18", "deck edge", "profile [2]", "flat of bottom", "WL 8", "BTK 2"):
        hand.ask("(p, name) => p.find(name)", name)
        box.locator("caption").get_by_text(name).wait_for()
        assert hand.page.evaluate(fits), name
    hand.ask("p => p.find('deck edge')")
    box.locator("caption").get_by_text("deck edge").wait_for()
    expect(box.locator("th")).to_have_text(["point", "x", "y", "z"], use_inner_text=True)


def test_what_has_moved_a_little_has_not_moved_by_nothing(open_page: Open, hull: ah.Hull) -> None:
    """Why tells so; a comparison tells of lines how far they differ, not only which."""
    hand = open_page(hull)
    pull(hand, 0.00004)
    hand.ask("(p, name) => p.find(name)", POINT)
    box = opened(hand, "Why")
    box.get_by_text("moved under 0.1 mm").first.wait_for()
    box = opened(hand, "History")
    box.get_by_label("compare with the hull as it came").click()
    box.get_by_text("Dashed: the hull as it was then").wait_for()
    most = re.compile(r"Most: BTK [\d.]+ by [\d.]+ mm,")
    expect(box.locator("[role=status]")).to_contain_text(most)


def test_names_of_the_grid_stay_at_the_foot(open_page: Open, bulk_carrier: ah.Hull) -> None:
    """Points of a buttock on the base line are no reason to lift the names of stations."""
    hand = open_page(bulk_carrier.snapshot(), viewport={"width": 1440, "height": 900})
    hand.ask("p => { p.find('BTK 2'); p.fit(); }")
    hand.settled()
    foot = hand.ask("p => p.views.profile.at(0, 0, p.views.profile.box().z0, 1)[1]")
    tops = hand.ask(
        "p => p.views.profile.written.filter(({text, box, colour}) => colour === p.ink.soft &&"
        " box[0] > 50 && /^[0-9]/.test(text)).map(({box}) => box[1])"
    )
    assert len(tops) > 8
    assert all(top > foot for top in tops)


def test_what_was_said_gives_way_to_a_hint(open_page: Open, hull: ah.Hull) -> None:
    """After some seconds, also where nothing else happens."""
    hand = open_page(hull)
    hand.ask("p => p.say('something was done')")
    foot = hand.page.locator(".page > footer")
    expect(foot).to_contain_text("something was done", use_inner_text=True)
    foot.get_by_text("Click a point or a line").wait_for(timeout=8000)


def test_letters_of_the_areas_are_no_larger_than_those_beside(
    open_page: Open, hull: ah.Hull
) -> None:
    """On a narrow screen the curve is as wide as the page."""
    for wide in (390, 800, 1440):
        hand = open_page(hull, viewport={"width": wide, "height": 844})
        box = opened(hand, "Hydrostatics")
        text = box.locator("svg text").first
        text.wait_for()
        high = text.bounding_box()
        assert high is not None
        assert 8.0 < high["height"] < 20.0
