"""The command `panels`: what it divides, what it says, what it writes."""

from pathlib import Path

import pytest

from assoc_hull.cli import main
from assoc_hull.cli.panels import _FORMS
from assoc_hull.io.panels.formats import PANEL_FORMS, read_panels
from tests.unit.cli.conftest import Json


def test_the_command_knows_every_form() -> None:
    """The list that starts without loading the writers is theirs."""
    assert tuple(PANEL_FORMS) == _FORMS


@pytest.mark.parametrize(("name", "count"), [("a.mar", 400), ("a.gdf", 400), ("a.pnl", 400)])
def test_a_mesh_is_written_and_read_back(
    hull: Path, facts: Json, tmp_path: Path, name: str, count: int
) -> None:
    """The ending chooses the form; the report tells number, volume and its error."""
    found = facts("panels", hull, "--stations", 41, "--points", 11, "-o", tmp_path / name)
    report = found["panels"]
    assert (report["panels"], report["images"]) == (count, 2)
    assert report["watertight"]
    assert report["outward"]
    assert report["volume_error"] == pytest.approx(-0.0033, abs=2e-4)
    assert report["origin"]["ship"] == "Wigley"
    assert found["saved"] == [str(tmp_path / name)]
    again = read_panels(tmp_path / name)
    assert again.count == count
    assert again.volumes[1] == pytest.approx(report["volume"][1], rel=1e-6)


def test_a_heeled_hull_is_written_whole(hull: Path, facts: Json, tmp_path: Path) -> None:
    """Both sides, at draughts of her own, with points on knuckles and the origin at AP."""
    path = tmp_path / "mesh.dat"
    found = facts(
        "panels", hull, "--draughts", 6, 5, "--heel", 8, "--count", 600, "--knuckles", 10,
        "--spacing", "cosine", "--origin", 0, "-o", path, "--format", "stl",
    )  # fmt: skip
    report = found["panels"]
    assert report["images"] == 1
    assert report["origin"]["heel_deg"] == 8.0
    assert report["origin"]["x"] == 0.0
    assert report["edges"]["below"] == 0
    assert read_panels(path).triangle.all()


def test_words_say_what_a_person_wants(
    hull: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """Volume, error, free edges, normals, waves, and the files; sections may be named by x."""
    where = ["--at", "10", "30", "50", "70", "90", "--points", "8", "--full"]
    plot = tmp_path / "mesh.png"
    assert main(["panels", str(hull), *where, "--plot", str(plot)]) == 0
    words = capsys.readouterr().out
    assert "watertight  yes" in words
    assert "out of the hull" in words
    assert "84, 0 of them triangles, the whole hull" in words
    assert f"written: {plot}" in words
    assert plot.read_bytes()[:4] == b"\x89PNG"


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["-o", "mesh.dat"], "the ending of the name tells no form"),
        (["--heel", "5", "--half"], "half of a heeled hull"),
        (["--count", "3"], "count is 3"),
        (["--stations", "9", "--at", "10", "20"], "not allowed with"),
        (["--at", "20", "10"], "ascending"),
        (["--plot", "mesh.txt"], "mesh.txt"),
        (["--draught", "40"], "mean draught of 40"),
    ],
)
def test_what_cannot_be_done_is_one_line(
    hull: Path, words: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """With exit code 2, and nothing written."""
    before = sorted(hull.parent.iterdir())
    assert main(["panels", str(hull), *words]) == 2
    error = capsys.readouterr().err
    assert told in error
    assert error.count("\n") == 1
    assert sorted(hull.parent.iterdir()) == before


def test_the_hull_itself_is_not_written_over(
    hull: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A mesh never takes the place of the hull it is made of."""
    data = hull.read_bytes()
    assert main(["panels", str(hull), "-o", str(hull), "--format", "wamit"]) == 2
    assert hull.read_bytes() == data
    assert "error" in capsys.readouterr().err
