"""What the tests of the command line share."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from assoc_hull.cli import main
from assoc_hull.hull.sources import examples

Json = Callable[..., Any]


@pytest.fixture(scope="session")
def wigley_bytes(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """The Wigley hull as a file holds it."""
    path = tmp_path_factory.mktemp("hulls") / "wigley.hull.json"
    examples.wigley().save(path)
    return path.read_bytes()


@pytest.fixture
def hull(tmp_path: Path, wigley_bytes: bytes) -> Path:
    """A hull file of this test's own."""
    path = tmp_path / "ship.hull.json"
    path.write_bytes(wigley_bytes)
    return path


@pytest.fixture
def edits(tmp_path: Path) -> Callable[[object], Path]:
    """Write a file of edits."""

    def write(content: object) -> Path:
        path = tmp_path / "edits.json"
        text = content if isinstance(content, str) else json.dumps(content)
        path.write_text(text, "utf-8")
        return path

    return write


@pytest.fixture
def facts(capsys: pytest.CaptureFixture[str]) -> Json:
    """Run a command with ``--json`` and give the document it printed."""

    def run(*arguments: object, code: int = 0) -> Any:
        capsys.readouterr()
        assert main([*map(str, arguments), "--json"]) == code
        return json.loads(capsys.readouterr().out)

    return run
