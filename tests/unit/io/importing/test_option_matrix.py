"""No option of an import is silently ignored, on any kind of file, in Python or in the shell."""

from __future__ import annotations

from pathlib import Path

import attrs
import pytest

from assoc_hull.cli import main
from assoc_hull.errors import BadInputError
from assoc_hull.io.importing import import_hull
from assoc_hull.io.importing.options import ImportOptions
from tests.long_forms import LONG
from tests.option_matrix import CHEAP, KINDS, OPTIONS, fate

TRIED = tuple(KINDS) if LONG else CHEAP


@pytest.fixture(scope="module", params=TRIED)
def file(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> tuple[str, Path]:
    """A kind of file, and one of it."""
    kind: str = request.param
    return kind, KINDS[kind][0](tmp_path_factory.mktemp("options"))


@pytest.mark.parametrize("option", OPTIONS)
def test_an_option_acts_or_is_refused_with_words(file: tuple[str, Path], option: str) -> None:
    """Another hull comes in, or the report tells of it, or a message says why not."""
    found = fate(*file, option)
    assert found != "IGNORED"
    if found.startswith("refused"):
        words = {option, *OPTIONS[option], option.replace("_", " ")}
        places = {"fp", "ap", "origin", "base", "waterline", "scale", "breadth", "length"}
        assert any(word in found for word in words) or (option in places and "give " in found)


@pytest.mark.parametrize("option", OPTIONS)
def test_the_command_takes_each_option_as_python_does(
    option: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is typed is what `ah.read` is given: both go the same way from there."""
    heard: list[ImportOptions] = []

    def hear(path: Path, options: ImportOptions, *_: object) -> None:
        heard.append(options)
        raise BadInputError("heard", "in a test", "go on")

    monkeypatch.setattr(import_hull, "import_hull", hear)
    file = tmp_path / "file.csv"
    file.write_text("station,wl_0\n")
    typed = [f"--{name.replace('_', '-')}={value}" for name, value in OPTIONS[option].items()]
    assert main(["import", str(file), "-o", str(tmp_path / "ship.hull"), *typed]) == 2
    (found,) = heard
    # The command takes what is not sound, to tell all of it, and refuses it then.
    assert found == ImportOptions(**OPTIONS[option], accept=True)


def test_every_option_of_an_import_is_in_the_matrix() -> None:
    """But for those that judge, and the draught forward, which goes with that aft."""
    names = {each.name for each in attrs.fields(ImportOptions)}
    assert names - {"accept", "strict", "draught_fwd"} == set(OPTIONS)
