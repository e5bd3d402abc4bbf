"""The command that makes a form-parameter curve."""

import json
from pathlib import Path
from typing import Any

import pytest

from assoc_hull.cli import main
from tests.form_curves import CURVES

RUN = [
    "start_x=-1", "start_y=0", "start_angle_deg=60", "start_curvature=-2", "finish_x=-0.3",
    "finish_y=1", "finish_angle_deg=0", "area=0.55", "centroid=-0.59",
]  # fmt: skip


def test_parameters_in_vertices_out(facts: Any) -> None:
    """A published curve from the command line."""
    found = facts("curve", "--set", *RUN)
    assert found["vertices"][3] == pytest.approx(CURVES["T1_run"]["P"][3], abs=1e-14)
    assert found["parameters"]["start_tangent"] == pytest.approx(0.152581945197, abs=1e-12)
    assert [each["code"] for each in found["messages"]] == ["inflections", "C6"]


def test_a_document_is_read_again(facts: Any, tmp_path: Path) -> None:
    """What is printed is a file to go on from: by vertices, and by parameters."""
    path = tmp_path / "run.json"
    path.write_text(json.dumps(facts("curve", "--set", *RUN)), "utf-8")
    first = json.loads(path.read_text("utf-8"))
    assert facts("curve", path) == first
    fuller = facts("curve", path, "--set", "area=0.56")
    assert fuller["parameters"]["area"] == pytest.approx(0.56, abs=1e-15)
    assert fuller["parameters"]["centroid"] == pytest.approx(-0.59, abs=1e-15)
    fair = facts("curve", path, "--tangents", "auto")
    assert fair["parameters"]["start_tangent"] == pytest.approx(0.062258, abs=1e-4)
    dragged = facts("curve", path, "--drag", "1", "-1", "0.01", "--keep", "area", "centroid")
    assert dragged["vertices"][1] == [-1.0, 0.01]
    assert dragged["parameters"]["area"] == pytest.approx(0.55, abs=1e-14)
    bare = tmp_path / "bare.json"
    bare.write_text(json.dumps({"parameters": first["parameters"]}), "utf-8")
    assert facts("curve", bare)["vertices"][3] == pytest.approx(first["vertices"][3], abs=1e-13)


def test_words_and_a_picture(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The table, and a picture with the vertices, the comb and the centroid."""
    path = tmp_path / "run.svg"
    assert main(["curve", "--set", *RUN, "-o", str(path)]) == 0
    words = capsys.readouterr().out
    assert "P3    -0.922173590026     0.787861836193" in words
    assert "C6 info: area 0.55 needs an inflection" in words
    assert words.endswith(f"written: {path}\n")
    drawing = path.read_text("utf-8")
    for name in ("polygon", "teeth", "inflections", "centroid", "label/P6"):
        assert f'id="{name}"' in drawing


def test_a_violated_condition_is_a_finding(capsys: pytest.CaptureFixture[str]) -> None:
    """Exit 1 where the area lies outside the box of the ends."""
    given = [each for each in RUN if not each.startswith(("area", "centroid"))]
    assert main(["curve", "--set", *given, "area=0.75"]) == 1
    assert "C3 error: area 0.75 outside the box" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("content", "arguments", "words"),
    [
        (None, [], "neither FILE.json nor --set is given"),
        (None, ["--set", "area"], "give NAME=VALUE"),
        (None, ["--set", "sense=1"], "no parameter of a curve named 'sense'"),
        (None, ["--set", *RUN, "--drag", "a", "0", "0"], "the vertex is a whole number"),
        (None, ["--set", *RUN, "--drag", "1", "b", "0"], "'b' is no number"),
        (None, ["--set", *RUN[:-1], "centroid=-0.3"], "cannot both be met"),
        (None, ["--set", *RUN, "-o", "run.doc"], ".pdf"),
        ("{", [], "this is no JSON"),
        ("[1]", [], "this is no JSON object"),
        ('{"a": NaN}', [], "NaN is no finite number"),
        ('{"vertices": 1, "vertices": 2}', [], "given twice"),
        ('{"vertices": [[0, 0]]}', [], "seven finite places"),
        ('{"parameters": 3}', [], "no JSON object"),
        ('{"parameters": {"start_x": "a"}}', [], "start_x is 'a'"),
    ],
)
def test_what_cannot_be_used(
    content: str | None,
    arguments: list[str],
    words: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """One line says what is wrong; the exit code is 2."""
    path = tmp_path / "curve.json"
    if content is not None:
        path.write_text(content, "utf-8")
        arguments = [str(path), *arguments]
    assert main(["curve", *arguments]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert words in line
