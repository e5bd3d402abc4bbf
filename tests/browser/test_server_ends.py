"""A server that is killed in the middle of a drag: nothing is lost, the page comes back."""

import functools
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import attrs
from playwright.sync_api import Browser, WebSocketRoute, expect

import assoc_hull as ah
from assoc_hull.page import PageServer
from tests.browser.conftest import READY, Hand

POINT = "WL 0.625 x ST 16"


@attrs.define(eq=False)
class Process:
    """A server in a process of its own, as far as a hand needs it."""

    address: str
    run: "subprocess.Popen[str]"


def started(path: Path, port: int = 0) -> Process:
    """Start a server, and wait for its address."""
    command = [sys.executable, "-m", "assoc_hull.cli", "page", str(path), "--no-browser", "--json"]
    run = subprocess.Popen(
        [*command, "--stay", "--port", str(port), "--author", "anna"],
        stdout=subprocess.PIPE, text=True,
        env={**os.environ, "XDG_RUNTIME_DIR": str(path.parent / "run")},
        # a shell that runs the tests behind it lets nothing in them hear Ctrl+C
        preexec_fn=functools.partial(signal.signal, signal.SIGINT, signal.SIG_DFL),
    )  # fmt: skip
    text = ""
    while "}" not in text:
        assert run.stdout is not None
        text += run.stdout.readline()
    return Process(json.loads(text)["address"], run)


def test_a_page_comes_back_by_itself_after_its_server_was_killed(
    browser: Browser, hull: ah.Hull, tmp_path: Path
) -> None:
    """The picture stays meanwhile, nothing committed is lost, and what was chosen still is."""
    path = tmp_path / "ship.hull"
    hull.snapshot().save(path)
    first = started(path)
    context = browser.new_context(viewport={"width": 1440, "height": 840}, bypass_csp=True)
    page = context.new_page()
    page.goto(first.address)
    page.wait_for_selector(READY)
    hand = Hand(page, first)  # type: ignore[arg-type]
    hand.near(POINT)
    hand.pull(POINT, 4.0)
    hand.until("p => p.store.history.edits === 1")
    x, y = hand.press(POINT)
    hand.to(x + 3.0, y)
    first.run.send_signal(signal.SIGKILL)
    first.run.communicate()
    page.wait_for_selector(".banner:not([hidden])")
    expect(page.locator(".banner")).to_contain_text("kept", use_inner_text=True)
    assert hand.ask("p => p.store.held === null && p.store.overlay === null")
    assert hand.ask("p => p.store.curves.size") > 70
    page.mouse.up()
    second = started(path)
    try:
        assert second.address == first.address  # also where any port would have done
        page.wait_for_selector(".banner", state="hidden")
        hand.until("p => p.store.connection === 'open' && p.store.history.edits === 1")
        hand.settled()
        assert hand.ask("p => p.store.net.points.get(p.store.selection.row).name") == POINT
        hand.pull(POINT, 3.0)
        hand.until("p => p.store.history.edits === 2")
    finally:
        second.run.send_signal(signal.SIGINT)
        second.run.communicate(timeout=30.0)
        assert second.run.returncode == 130
        context.close()
    assert list((tmp_path / "run").rglob("*.json")) == []  # one that ended lets nobody in
    opened = ah.open(path)
    assert [step.author for step in opened.history] == ["anna", "anna"]
    assert opened.verify() == ()
    opened.close()


def test_a_page_is_open_only_when_the_hull_has_come(browser: Browser, hull: ah.Hull) -> None:
    """What is taken hold of before would be let go by the hull that comes."""
    kept = list[bytes]()
    context = browser.new_context(bypass_csp=True)
    page = context.new_page()

    def hold(socket: WebSocketRoute) -> None:
        """Let the words of the server through, and keep back what it draws."""
        behind = socket.connect_to_server()
        behind.on_message(
            lambda sent: kept.append(sent) if kept_back and isinstance(sent, bytes)
            else socket.send(sent)
        )  # fmt: skip
        routes.append(socket)

    routes, kept_back = list[WebSocketRoute](), {bytes}
    page.route_web_socket("**/socket", hold)
    with PageServer(hull, author="anna") as server:
        page.goto(server.address)
        hand = Hand(page, server)
        hand.until("p => p.message !== null && p.store.history")
        for _ in range(200):  # what the server draws may come long after its words
            page.wait_for_timeout(50.0)
            if kept:
                break
        assert kept
        assert hand.ask("p => [p.store.connection, p.hand.free]") == ["connecting", False]
        while kept:
            routes[0].send(kept.pop(0))
        kept_back.clear()
        hand.until("p => p.store.connection === 'open' && p.hand.free")
        context.close()
