"""`assoc-hull fair`: lengths in mm, a trial, the hull file, refusals."""

import json
from pathlib import Path

import pytest

import assoc_hull as ah
from assoc_hull.cli import main
from tests.noisy_nets import put_noise


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A noisy hull in a file."""
    hull = ah.examples.wigley()
    put_noise(hull, 1.6e-3)
    hull.save(tmp_path / "ship.hull")
    hull.close()
    return tmp_path / "ship.hull"


def test_it_fairs_as_the_method_does(file: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The trial writes nothing; then one step with the same result, in m in JSON."""
    hull = ah.open(file)
    wanted, steps = hull.snapshot(), len(hull.history)
    wanted.fair(noise=0.0016, tolerance=0.003, hold=["volume"])
    print_ = hull.fingerprint
    hull.close()
    words = ["fair", str(file), "--noise", "1.6", "--tolerance", "3mm", "--hold", "volume"]
    assert main([*words, "--dry-run"]) == 0
    told = capsys.readouterr().out
    assert "noise        1.6 mm, stated" in told
    assert "nothing written" in told
    hull = ah.open(file)
    assert hull.fingerprint == print_
    hull.close()
    assert main([*words, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["noise"], found["refused"], found["unknowns"]) == (0.0016, False, 171)
    assert found["volume"][1] == pytest.approx(found["volume"][0], rel=1e-8)
    hull = ah.open(file)
    assert hull.fingerprint == wanted.fingerprint
    assert len(hull.history) == steps + 1


def test_lines_and_a_window_go_to_another_file(
    file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """And the first one stays as it is."""
    out, before = tmp_path / "faired.hull", file.read_bytes()
    place = ["--at", "WL 3.75 x ST 8", "--radius", "20", "4", "--keep", "ST 8"]
    words = ["fair", str(file), "waterlines", "--noise", "1.6", *place, "-o", str(out)]
    assert main(words) == 0
    assert "to be kept" in capsys.readouterr().out
    assert file.read_bytes() == before
    assert ah.open(out).history[-1].name == "fair"


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ([], "noise is not known"),
        (["--noise", "much"], "no length above 0 in mm"),
        (["--noise", "0"], "no length above 0 in mm"),
        (["--noise", "10", "--tolerance", "1"], "the tolerance 1 mm"),
        (["--noise", "1", "--at", "WL 3.75 x ST 8"], "without radius"),
        (["--noise", "1", "--radius", "3", "3"], "without at"),
        (["WL 99", "--noise", "1"], "WL 99"),
    ],
)
def test_bad_input_is_one_line(
    file: Path, more: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """On standard error, with exit code 2; the file stays."""
    before = file.read_bytes()
    assert main(["fair", str(file), *more]) == 2
    error = capsys.readouterr().err
    assert words in error
    assert error.count("\n") == 1
    assert file.read_bytes() == before


def test_a_refused_hull_is_told_with_exit_code_1(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """All findings, and a way out."""
    ah.examples.series60(cb=0.7).save(tmp_path / "ship.hull.json")
    before = (tmp_path / "ship.hull.json").read_bytes()
    assert main(["fair", str(tmp_path / "ship.hull.json"), "--noise", "100"]) == 1
    found = capsys.readouterr()
    assert "half the noise" in found.out
    assert "the hull is unchanged" in found.err
    assert (tmp_path / "ship.hull.json").read_bytes() == before
