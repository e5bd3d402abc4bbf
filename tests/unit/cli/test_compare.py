"""The command `compare`: what it prints, writes and refuses."""

from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

import assoc_hull as ah
from assoc_hull.cli import main
from assoc_hull.io.tables.comparison import comparison_schema
from assoc_hull.plot.lines_plan import comparison as comparison_sheet
from assoc_hull.variation.comparing.comparison import HullComparison
from tests.unit.cli.conftest import Json


@pytest.fixture
def variant(tmp_path: Path) -> Path:
    """A broader Wigley hull with fewer lines."""
    path = tmp_path / "variant.hull.json"
    ah.examples.wigley(breadth=11.0, stations=11, waterlines=6).save(path)
    return path


def test_the_document_has_the_form_of_the_schema(
    hull: Path, variant: Path, tmp_path: Path, facts: Json, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It names the PDF that was written beside it, as the library makes it of the same numbers."""
    drawn: list[HullComparison] = []

    def pdf(parent: ah.Hull, variant: ah.Hull, found: HullComparison) -> bytes:
        drawn.append(found)
        return b"%PDF-"

    monkeypatch.setattr(comparison_sheet, "comparison_pdf", pdf)
    target = tmp_path / "comparison.pdf"
    found = facts("compare", hull, variant, "--draught", 6, "--shaft-height", 2,
                  "--propeller-diameter", 3, "--pdf", target)  # fmt: skip
    assert Draft202012Validator(comparison_schema()).is_valid(found)
    assert found["saved"] == [str(target)]
    assert target.read_bytes() == b"%PDF-"
    assert drawn[0].variant.draught == 6.0
    assert found["variant"]["at_draught"] == 6.0
    own = ah.open(hull).compare(ah.open(variant), draught=6.0)
    volume = next(each for each in found["hydrostatics"] if each["symbol"] == "volume")
    assert volume["difference"] == own.hydrostatic("volume").difference


def test_so_many_lines_are_listed(
    hull: Path, variant: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """As are asked for; hulls are as they were."""
    before = hull.read_bytes(), variant.read_bytes()
    assert main(["compare", str(hull), str(variant), "--lines", "3"]) == 0
    told = capsys.readouterr().out
    assert "LINES, the 3 that moved farthest of " in told
    assert (hull.read_bytes(), variant.read_bytes()) == before


@pytest.mark.parametrize(
    ("more", "holds"),
    [
        pytest.param(["--draught", "20"], "20 m", id="draught"),
        pytest.param(["--lines", "-1"], "lines is -1", id="lines"),
        pytest.param(["--pdf", "a.doc"], ".pdf", id="ending"),
        pytest.param(["--pdf", "none/a.pdf"], "there is no folder none", id="folder"),
        pytest.param(["--shaft-height", "2"], "--propeller-diameter", id="half a screw"),
    ],
)
def test_what_cannot_be_is_refused(
    more: list[str], holds: str, hull: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """In one line; nothing is printed or written."""
    assert main(["compare", str(hull), str(hull), *more]) == 2
    told = capsys.readouterr()
    assert (told.out, told.err.count("\n")) == ("", 1)
    assert holds in told.err
