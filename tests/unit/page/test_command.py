"""The command that serves a page: it tells the address, serves, and ends with the keyboard."""

import functools
import json
import signal
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest

from tests.conftest import Shipped

COMMAND = [sys.executable, "-m", "assoc_hull.cli", "page"]


def test_the_command_serves_until_it_is_stopped(shipped: Shipped, tmp_path: Path) -> None:
    """The document has the address, at which the page is; Ctrl+C ends it with 130."""
    path = tmp_path / "ship.hull"
    shipped("wigley").save(path)
    given = [str(path), "--no-browser", "--json", "--author", "anna"]
    with subprocess.Popen(
        [*COMMAND, *given],
        stdout=subprocess.PIPE,
        text=True,
        # what a shell puts in the background ignores Ctrl+C, and so would the command
        preexec_fn=functools.partial(signal.signal, signal.SIGINT, signal.SIG_DFL),
    ) as run:
        try:
            assert run.stdout is not None
            text = ""
            while "}" not in text:
                text += run.stdout.readline()
            told = json.loads(text)
            address, _, admission = told["address"].partition("#")
            with urllib.request.urlopen(address) as answer:
                assert b"main.js" in answer.read()
            run.send_signal(signal.SIGINT)
            assert run.wait(30.0) == 130
        finally:
            run.kill()
    assert told["kept"] is True
    assert "author=anna" in admission


@pytest.mark.parametrize(("given", "words"), [
    (["no such.hull"], "no such.hull"), (["--port", "70000"], "port"), (["--author", ""], "author"),
])  # fmt: skip
def test_what_does_not_fit_is_one_line(
    shipped: Shipped, tmp_path: Path, given: list[str], words: str
) -> None:
    """Nothing is served."""
    path = tmp_path / "ship.hull.json"
    shipped("wigley").save(path)
    words_of = [str(path), *given] if given[0].startswith("--") else given
    run = subprocess.run(
        [*COMMAND, *words_of, "--no-browser"],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert run.returncode == 2
    assert run.stderr.startswith("error: ")
    assert words in run.stderr
    assert run.stderr.count("\n") == 1
