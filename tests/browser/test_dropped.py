"""Files and pictures that are dropped on the page: shown beside, the hull stays as it is."""

import base64
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import expect

import assoc_hull as ah
from tests.browser.conftest import Hand, Open

PICTURE = (
    "iVBORw0KGgoAAAANSUhEUgAAAAQAAAACCAIAAADwyuo0AAAAEElEQVR42mP4z8AARwzIHABvqgf5aN2v"
    "pwAAAABJRU5ErkJggg=="
)


def drop(hand: Hand, name: str, data: bytes, kind: str = "", view: str = "body") -> None:
    """Drop a file on a drawing, as a hand does from another window."""
    hand.page.evaluate(
        "([name, data, kind, view]) => { const raw = atob(data), moved = new DataTransfer();"
        " moved.items.add(new File([Uint8Array.from(raw, c => c.charCodeAt(0))], name,"
        " {type: kind})); document.querySelector(`.view-${view} canvas:last-of-type`)"
        ".dispatchEvent(new DragEvent('drop', {dataTransfer: moved, bubbles: true,"
        " cancelable: true})); }", [name, base64.b64encode(data).decode(), kind, view],
    )  # fmt: skip


def test_a_dropped_hull_is_shown_beside(open_page: Open, hull: ah.Hull, tmp_path: Path) -> None:
    """Its lines to the bit, with its size in words; taken away, nothing is left of it."""
    hand, before = open_page(hull), hull.fingerprint
    other = ah.examples.wigley()
    other.export(tmp_path / "other.hull.json")
    drop(hand, "../oth er.hull.json", (tmp_path / "other.hull.json").read_bytes())
    hand.until("p => p.store.beside !== null")
    hand.settled()
    box = hand.page.locator("details:has(h2:text-is('Beside'))")
    expect(box).to_contain_text(f"Lpp {other.particulars.length:.2f}", use_inner_text=True)
    shown = hand.ask("p => [...p.store.beside.frame.curves].map(([id, c]) => [id, ...c.xyz])")
    shapes = ah.read(tmp_path / "other.hull.json").shapes()
    assert [each[0] for each in shown] == shapes.curves.tolist()
    for (_, *flat), spline in zip(shown, shapes.spline.single(), strict=True):
        assert np.array_equal(flat, spline.xyz.ravel())
    assert hull.fingerprint == before
    box.get_by_role("button", name="Take it away").click()
    assert hand.ask("p => p.store.beside === null")


def test_offsets_and_meshes_are_dropped_as_well(
    open_page: Open, hull: ah.Hull, tmp_path: Path
) -> None:
    """Each takes the place of the one before, with its size in words."""
    hand, before = open_page(hull), hull.fingerprint
    other = ah.examples.wigley(stations=7, waterlines=5)
    box = hand.page.locator("details:has(h2:text-is('Beside'))")
    for name in ("offsets.csv", "mesh.stl"):
        other.export(tmp_path / name)
        drop(hand, name, (tmp_path / name).read_bytes())
        box.get_by_text(f"{name}, dotted: ").wait_for()
        expect(box).to_contain_text("Lpp ", use_inner_text=True)
        assert hand.ask("p => p.store.beside.frame.curves.size") > 5
    assert hull.fingerprint == before


@pytest.mark.parametrize("name", ["garbage.csv", "garbage.stl", "garbage.xyz"])
def test_garbage_that_is_dropped_is_told_in_a_sentence(
    open_page: Open, hull: ah.Hull, name: str
) -> None:
    """No folder of the server is named, and the hull stays."""
    hand, before = open_page(hull), hull.fingerprint
    drop(hand, name, bytes(range(256)))
    box = hand.page.locator("details:has(h2:text-is('Beside'))")
    box.get_by_text(name).first.wait_for()
    expect(box).not_to_contain_text("error of this program", use_inner_text=True)
    expect(box).not_to_contain_text("/tmp", use_inner_text=True)
    assert hull.fingerprint == before


def test_a_picture_is_placed_by_two_clicks(open_page: Open, hull: ah.Hull) -> None:
    """Both places lie where they were said to; it moves with the drawing, and can go."""
    hand = open_page(hull)
    drop(hand, "plan.png", base64.b64decode(PICTURE), "image/png", "profile")
    hand.until("p => p.views.profile.picture !== null")
    frame = hand.ask(
        "p => { const b = p.views.profile.upper.getBoundingClientRect(); return [b.left, b.top]; }"
    )
    clicks = [(frame[0] + 200.0, frame[1] + 120.0), (frame[0] + 500.0, frame[1] + 40.0)]
    for x, y in clicks:
        hand.page.mouse.click(x, y)
    box = hand.page.locator("details:has(h2:text-is('Beside'))")
    for label, value in (("x of the first", "10"), ("z of the first", "0"),
                         ("x of the second", "100"), ("z of the second", "12")):  # fmt: skip
        box.get_by_label(label).fill(value)
    pixels = hand.ask("p => p.panel.beside.placing.at")
    box.get_by_role("button", name="Place it").click()
    picture = hand.ask("p => { const {x, y, across, up} = p.views.profile.picture;"
                       " return [x, y, across, up]; }")  # fmt: skip
    x, y, across, up = picture
    for (u, v), place in zip(pixels, ((10.0, 0.0), (100.0, 12.0)), strict=True):
        assert x + u * across == pytest.approx(place[0], abs=1e-9)
        assert y - v * up == pytest.approx(place[1], abs=1e-9)
    box.get_by_role("button", name="Take it away").click()
    assert hand.ask("p => p.views.profile.picture === null")


def test_of_two_files_the_one_dropped_last_is_shown(
    open_page: Open, hull: ah.Hull, tmp_path: Path
) -> None:
    """Also where the first is read after it; one that was given up is not shown at all."""
    hand = open_page(hull)
    for name, other in (("one", ah.examples.wigley()), ("two", ah.examples.plain_ship())):
        other.export(tmp_path / f"{name}.hull.json")
    hand.ask(
        "p => { const {upload} = p.options, waits = p.let = []; p.options.upload ="
        " async (file) => { const found = await upload(file);"
        " await new Promise(done => waits.push(done)); return found; }; }"
    )
    for count, name in enumerate(("one", "two"), 1):
        drop(hand, f"{name}.hull.json", (tmp_path / f"{name}.hull.json").read_bytes())
        hand.until("(p, n) => p.let.length === n", count)
    hand.ask("p => p.let[1]()")
    hand.until("p => p.store.beside !== null")
    hand.ask("p => p.let[0]()")
    hand.settled()
    box = hand.page.locator("details:has(h2:text-is('Beside'))")
    expect(box).to_contain_text("two.hull.json", use_inner_text=True)
    drop(hand, "one.hull.json", (tmp_path / "one.hull.json").read_bytes())
    hand.until("p => p.let.length === 3")
    box.get_by_role("button", name="Give up").click()
    hand.ask("p => p.let[2]()")
    hand.settled()
    assert hand.ask("p => p.store.beside === null")
    expect(box).to_contain_text("Nothing is shown beside", use_inner_text=True)


def test_a_server_that_answers_otherwise_is_told(open_page: Open, hull: ah.Hull) -> None:
    """With its own words where there are some; not as if it had been silent."""
    hand = open_page(hull)
    box = hand.page.locator("details:has(h2:text-is('Beside'))")
    answer = {"status": 200, "content_type": "application/json", "body": '{"problem": "too large"}'}
    hand.page.route("**/drop*", lambda route: route.fulfill(**answer))
    drop(hand, "a.csv", b"1")
    box.get_by_text("a.csv: too large").wait_for()
    answer.update(content_type="text/plain", body="no")
    drop(hand, "a.csv", b"1")
    told = box.get_by_text("a.csv: the server answered 200")
    told.wait_for()
    expect(box).not_to_contain_text("too large", use_inner_text=True)
    assert hand.ask("p => p.store.beside === null")
