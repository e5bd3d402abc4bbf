"""The command `transform`: coefficients as text and as JSON, pictures, refusals."""

from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.analysis.form.curve_transform import curve_transform
from assoc_hull.cli import main
from tests.unit.cli.conftest import Json


def test_the_document_holds_the_numbers_of_the_function(hull: Path, facts: Json) -> None:
    """The same coefficients, range and remainders; saved is empty."""
    found = facts("transform", hull, "--line", "WL 2.5", "--kind", "sine", "--terms", 4)
    wanted = curve_transform(ah.open(hull), "WL 2.5", "sine", 4)
    assert found["coefficients"] == wanted.coefficients.tolist()
    assert found["orders"] == [1, 2, 3, 4]
    assert (found["low"], found["high"], found["unit"]) == (wanted.low, wanted.high, 1.0)
    assert found["rms"] == wanted.truncation.rms.tolist()
    assert found["saved"] == []


def test_without_a_line_it_is_the_areas(hull: Path, facts: Json) -> None:
    """At the position that was given, over AP to FP."""
    found = facts("transform", hull, "--draughts", 5, 4, "--heel", 2, "--span-lpp", "--terms", 3)
    assert (found["name"], found["along"], found["across"]) == ("sectional areas", "x", "A")
    assert found["position"] == "at T_A 5 m, T_F 4 m, heel 2 deg"
    assert (found["low"], found["high"]) == (0.0, 100.0)


def test_descriptors_are_pairs(hull: Path, facts: Json) -> None:
    """Real and imaginary part; those of a section are imaginary."""
    found = facts("transform", hull, "--line", "ST 5", "--kind", "fourier", "--span", 0, 5)
    pairs = np.array(found["coefficients"])
    assert pairs.shape == (25, 2)
    assert np.abs(pairs[:, 0]).max() < 1e-9 < np.abs(pairs[:, 1]).max()


def test_words_have_a_line_per_coefficient(hull: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """With k, ten decimals and the sign; the range above, what is left below."""
    assert main(["transform", str(hull), "--line", "WL 2.5", "--terms", "3"]) == 0
    head, *rows, last = capsys.readouterr().out.splitlines()
    assert head == "WL 2.5: chebyshev, y, x from 0 to 100 m"
    assert [row.split()[0] for row in rows] == ["c_0", "c_1", "c_2"]
    assert rows[2].split()[1][:3] == "-1."
    assert last.startswith("left out: rms ")
    assert (
        main(["transform", str(hull), "--line", "ST 5", "--kind", "fourier", "--terms", "1"]) == 0
    )
    out = capsys.readouterr().out
    assert "X_-1 " in out
    assert out.count(" i\n") == 3


def test_a_picture_is_drawn(hull: Path, tmp_path: Path, facts: Json) -> None:
    """Its name stands in the document."""
    pytest.importorskip("matplotlib")
    target = tmp_path / "series.svg"
    found = facts("transform", hull, "--line", "WL 2.5", "--plot", target)
    assert found["saved"] == [str(target)]
    assert target.stat().st_size > 1000


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--line", "nowhere"], "no object named 'nowhere'"),
        (["--line", "WL 2.5", "--draught", "3"], "a floating position is given with a line"),
        (["--terms", "0"], "terms is 0"),
        (["--plot", "a.xyz"], "a.xyz"),
        (["--span", "5", "2"], "span is (5.0, 2.0)"),
    ],
)
def test_what_cannot_be_done_is_told_in_one_line(
    hull: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], message: str
) -> None:
    """Exit code 2, and nothing on standard output."""
    assert main(["transform", str(hull), *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("error: ")
    assert message in captured.err
    assert captured.err.count("\n") == 1
