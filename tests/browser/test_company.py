"""Several hands on one hull: windows that watch one another, and another process on the file."""

import subprocess
import sys
from pathlib import Path

import pytest
from playwright.sync_api import expect

import assoc_hull as ah
from assoc_hull.page import PageServer
from tests.browser.conftest import Hand, Open

POINT, OTHER = "WL 0.625 x ST 16", "WL 0.5 x ST 15"

COMMIT = """
import sys
import assoc_hull as ah
hull = ah.open(sys.argv[1])
hull.author = "bert"
hull.apply("elsewhere", [{"op": "pull", "point": sys.argv[2], "d": 0.004}])
hull.close()
"""


def committed_elsewhere(path: Path) -> None:
    """Pull a point in another process."""
    subprocess.run([sys.executable, "-c", COMMIT, str(path), OTHER], check=True, timeout=60.0)


def in_file(open_page: Open, hull: ah.Hull, path: Path) -> Hand:
    """Open the page of a hull in a file."""
    hull.snapshot().save(path)
    return open_page(ah.open(path))


def test_what_another_process_commits_is_shown_unasked(
    open_page: Open, hull: ah.Hull, tmp_path: Path
) -> None:
    """Within a second, under its author's name; what is done next stands on it."""
    path = tmp_path / "ship.hull"
    hand = in_file(open_page, hull, path)
    committed_elsewhere(path)
    hand.until("p => p.store.history.edits === 1")
    hand.settled()
    assert hand.shows_what_is_published()
    told = hand.page.locator("details:has(h2:text-is('Edit'))")
    for word in ("elsewhere", "bert"):
        expect(told).to_contain_text(word, use_inner_text=True)
    hand.near(POINT)
    hand.pull(POINT, 4.0)
    hand.until("p => p.store.history.edits === 2")
    assert [step.author for step in hand.hull.history] == ["bert", "anna"]
    assert hand.hull.verify() == ()
    hand.hull.close()


def test_what_another_process_commits_waits_until_a_point_is_let_go(
    open_page: Open, hull: ah.Hull, tmp_path: Path
) -> None:
    """The hull does not change under the hand; the edit is not made, and the page says why."""
    path = tmp_path / "ship.hull"
    hand = in_file(open_page, hull, path)
    hand.near(POINT)
    x, y = hand.press(POINT)
    hand.to(x + 3.0, y)
    committed_elsewhere(path)
    hand.to(x + 4.0, y)
    assert hand.ask("p => p.store.history.edits") == 0
    hand.page.mouse.up()
    hand.page.locator(".banner").get_by_text("elsewhere").wait_for()
    hand.until("p => p.store.history.edits === 1 && p.hand.free")
    assert hand.shows_what_is_published()
    hand.pull(POINT, 4.0)
    hand.until("p => p.store.history.edits === 2")
    assert [step.author for step in hand.hull.history] == ["bert", "anna"]
    hand.hull.close()


@pytest.mark.parametrize("how", ["let go", "window closed"])
def test_who_holds_a_point_hands_it_over(open_page: Open, hull: ah.Hull, how: str) -> None:
    """The other sees it free, takes hold of it, and its edit is its own; nothing is left over."""
    first = open_page(hull)
    second = open_page(server=first.server)
    second.ask("p => p.sign('bert')")
    first.near(POINT)
    x, y = first.press(POINT)
    first.to(x + 3.0, y)
    second.until("p => p.store.theirs && p.store.theirs.frame")
    if how == "let go":
        first.page.keyboard.press("Escape")
        first.page.mouse.up()
    else:
        first.page.close()
    second.until("p => p.store.theirs === null")
    second.near(POINT)
    second.pull(POINT, 4.0)
    second.until("p => p.store.history.edits === 1")
    assert [step.author for step in hull.history] == ["bert"]
    assert second.shows_what_is_published()


def test_an_address_of_a_server_that_ended_lets_nobody_in(open_page: Open, hull: ah.Hull) -> None:
    """The page says that there is a new one; nothing is tried for ever."""
    hand = open_page(hull)
    port = int(hand.server.address.split(":")[2].split("/")[0])
    hand.server.__exit__(None, None, None)
    with PageServer(hull, port=port):
        hand.page.wait_for_selector("[data-connection=over]")
    expect(hand.page.locator(".banner")).to_contain_text("open the new one", use_inner_text=True)
