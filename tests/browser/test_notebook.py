"""The widget in a real JupyterLab: a hand in it and a cell beside it edit one hull."""

from __future__ import annotations

import json
import os
import secrets
import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import cast

import attrs
import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from assoc_hull.page import PageServer
from tests.browser.conftest import READY, Hand

pytest.importorskip("jupyterlab")

POINT = "WL 2.5 x ST 7"
CELLS = (
    "import assoc_hull as ah\nhull = ah.examples.wigley()\n"
    "shown = ah.widget(hull, height=600, author='anna')\nshown",
    "print([(step.name, step.author) for step in hull.history])",
    f"with hull.edit('in a cell') as edit:\n    edit.move('{POINT}', y=hull['{POINT}'].y + 0.05)\n"
    f"print(hull['{POINT}'].y)",
    "hull.plot.lines_plan()",
    "print(shown.selection)",
)


@attrs.define(eq=False)
class Lab:
    """A JupyterLab, the notebook in it, and the folder that it is in."""

    page: Page
    address: str
    path: Path

    def cell(self, number: int) -> Locator:
        """A cell, by its number from 0."""
        return self.page.locator(".jp-Notebook .jp-Cell").nth(number)

    def run(self, number: int) -> Locator:
        """Run a cell; gives what it shows."""
        self.cell(number).locator(".jp-InputArea-editor").click()
        self.page.keyboard.press("Control+Enter")
        prompt = self.cell(number).locator(".jp-InputPrompt").first
        expect(prompt).not_to_have_text("[ ]:", timeout=60_000)
        expect(prompt).not_to_have_text("[*]:", timeout=60_000)
        return self.cell(number).locator(".jp-OutputArea-output")


def notebook() -> dict[str, object]:
    """A notebook of the cells above."""
    cells: list[dict[str, object]] = [
        {"cell_type": "code", "id": f"cell-{number}", "metadata": {}, "source": text,
         "outputs": [], "execution_count": None}
        for number, text in enumerate(CELLS)
    ]  # fmt: skip
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    return {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}


@pytest.fixture(scope="module")
def lab(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Lab]:
    """A JupyterLab on a free port, with a notebook open."""
    folder = tmp_path_factory.mktemp("lab")
    (folder / "hull.ipynb").write_text(json.dumps(notebook()))
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    token = secrets.token_hex(16)
    own = {f"JUPYTER_{name}_DIR": str(folder / name) for name in ("CONFIG", "DATA", "RUNTIME")}
    command = [
        sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root", f"--port={port}",
        f"--IdentityProvider.token={token}", f"--ServerApp.root_dir={folder}",
    ]  # fmt: skip
    address = f"http://127.0.0.1:{port}/lab/tree/hull.ipynb?reset&token={token}"
    quiet = subprocess.DEVNULL
    with subprocess.Popen(command, env=os.environ | own, stdout=quiet, stderr=quiet) as server:
        try:
            _wait_for(address, server)
            page = browser.new_page(viewport={"width": 1500, "height": 1100})
            page.goto(address)
            page.wait_for_selector(".jp-Notebook .jp-Cell", timeout=60_000)
            status = page.locator("#jp-main-statusbar")
            expect(status).to_contain_text("Idle", timeout=60_000)  # of the kernel
            yield Lab(page, address, folder / "hull.ipynb")
            page.close()
        finally:
            server.terminate()


def _wait_for(address: str, server: subprocess.Popen[bytes]) -> None:
    for _ in range(240):
        assert server.poll() is None, "JupyterLab has ended"
        with suppress(OSError), urllib.request.urlopen(address, timeout=5.0):
            return
        time.sleep(0.25)
    pytest.fail("JupyterLab does not answer")


def test_hand_cell_and_saved_notebook_show_one_hull(lab: Lab, browser: Browser) -> None:
    """Open, drag, edit in a cell, a figure, saved, and seen again without a kernel."""
    lab.run(0)
    lab.page.wait_for_selector(f".assoc-hull-widget {READY}", timeout=60_000)
    expect(lab.page.locator(".assoc-hull-still")).to_be_hidden()
    hand = Hand(lab.page, cast(PageServer, None))  # the server is the kernel

    # A drag is a step of the cell's hull, in the name that the widget was given.
    hand.pull(POINT, 25.0)
    expect(lab.run(1)).to_contain_text("'anna')]")
    expect(lab.cell(1)).to_contain_text(f"pull {POINT}", use_inner_text=True)
    expect(lab.run(4)).to_contain_text("<Point ST 7 x WL 2.5>")

    # What a cell does is seen in the widget.
    y = float(lab.run(2).inner_text())
    hand.until("(p, name, y) => p.store.places.get(p.store.net.find(name))[1] === y", POINT, y)

    # A figure needs no magic.
    expect(lab.run(3).locator("img, svg").first).to_be_visible()

    # A saved notebook shows the three views without a kernel.
    lab.page.keyboard.press("Escape")
    lab.page.keyboard.press("Control+s")
    lab.page.wait_for_function("() => !document.querySelector('.jp-mod-dirty')")
    kept = json.loads(lab.path.read_text())
    pictures = ["".join(each["data"].get("text/html", "")) for each in kept["cells"][0]["outputs"]]
    assert any("<svg" in picture and "assoc-hull-still" in picture for picture in pictures)
    plain = browser.new_page()
    plain.set_content(pictures[0])
    expect(plain.locator("svg")).to_be_visible()
    plain.close()
