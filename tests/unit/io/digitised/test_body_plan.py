"""A flat drawing of a body plan becomes sections in their places; what is left out is told."""

from __future__ import annotations

import io
from pathlib import Path

import ezdxf.filemanagement
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError
from assoc_hull.hull import Hull
from assoc_hull.io.digitised.body_plan import BodyPlanRules, is_body_plan, read_body_plan
from assoc_hull.io.digitised.read import read_lines
from assoc_hull.io.lines.line_points import lines_as_points
from assoc_hull.io.lines.mend_lines import distances_off
from assoc_hull.io.lines.raw_lines import RawPiece
from tests.body_plans import body_plan

LENGTH = 121.92
STATIONS = [(str(k), 0.1 * k * LENGTH) for k in range(1, 10)]


@pytest.fixture(scope="module")
def hull(series60_60: Hull) -> Hull:
    """It has sections at all full stations."""
    return series60_60


@pytest.mark.parametrize(
    ("drawn", "rules"),
    [
        ({}, {"length": LENGTH}),
        ({"scale": 100.0, "unit": "mm", "centre": 210.0}, {"length": LENGTH, "scale": 100.0}),
        ({}, {"spacing": 0.1 * LENGTH}),
    ],
    ids=["full size", "1:100 in mm, centre line aside", "spacing given"],
)
def test_sections_come_to_their_stations(
    hull: Hull, tmp_path: Path, drawn: dict[str, float], rules: dict[str, float]
) -> None:
    """Places by labels, half-breadths from the centre line, to rounding."""
    path = tmp_path / "plan.dxf"
    path.write_text(body_plan(hull, STATIONS, **drawn), encoding="utf-8")  # type: ignore[arg-type]
    assert is_body_plan(path)
    plan = read_body_plan(path, BodyPlanRules(**rules))  # type: ignore[arg-type]
    slices = read_lines(plan.text, unit=plan.unit, scale=rules.get("scale", 1.0))
    known = {line.offset: line for line in lines_as_points(hull.state, ("sections",))}
    assert len(slices.lines) == 9
    for line in slices.lines:
        place = min(known, key=lambda x: abs(x - line.offset))
        assert line.offset == pytest.approx(place, abs=1e-6)
        points = np.concatenate([piece.points for piece in known[place].pieces])
        given = np.concatenate([piece.points for piece in line.pieces])
        assert np.abs(given[:, 1:] - points[:, 1:]).max() <= 1e-9
    told = "\n".join(map(str, plan.notes.assumptions))
    assert "the layer 'grid': 3 straight lines" in told
    assert "the layer 'stamp': 1 of CIRCLE" in told


def test_stations_may_be_numbered_from_the_bow(hull: Hull, tmp_path: Path) -> None:
    """The after body is to the left: where its numbers are higher station 0 is at FP, as told."""
    stations = [(str(20 - 2 * k), 0.1 * k * LENGTH) for k in range(1, 10)]
    path = tmp_path / "plan.dxf"
    path.write_text(body_plan(hull, stations), encoding="utf-8")
    plan = read_body_plan(path, BodyPlanRules(length=LENGTH, spacings=20))
    places = [each.offset for each in read_lines(plan.text, unit=plan.unit).lines]
    assert np.allclose(places, [x for _, x in STATIONS], atol=1e-9)
    assert any("at the FP" in note.what for note in plan.notes.assumptions)


def redrawn(text: str, form: str) -> str:
    """The sections of a drawing as lines from point to point, in two pieces, or on both sides."""
    drawing = ezdxf.filemanagement.read(io.StringIO(text))
    space = drawing.modelspace()
    for each in list(space.query("LWPOLYLINE")):
        xy = np.array(each.get_points("xy"))
        half, layer = len(xy) // 2, {"layer": "sections"}
        if form == "lines":
            for a, b in zip(xy[:-1].tolist(), xy[1:].tolist(), strict=True):
                space.add_line(a, b, dxfattribs=layer)
        elif form == "pieces":
            for part in (xy[half:], xy[half::-1]):
                space.add_lwpolyline(part.tolist(), dxfattribs=layer)
        space.delete_entity(each)
    out = io.StringIO()
    drawing.write(out)
    return out.getvalue()


@pytest.mark.parametrize("form", ["lines", "pieces"])
def test_pieces_of_sections_are_joined_where_they_meet(
    hull: Hull, tmp_path: Path, form: str
) -> None:
    """Lines from point to point are no grid, and pieces without a number are not left out."""
    path, text = tmp_path / "plan.dxf", body_plan(hull, STATIONS)
    found = []
    for each in (text, redrawn(text, form)):
        path.write_text(each, encoding="utf-8")
        plan = read_body_plan(path, BodyPlanRules(length=LENGTH))
        assert not plan.notes.suspicions
        found.append(read_lines(plan.text, unit=plan.unit))
    for one, other in zip(found[0].lines, found[1].lines, strict=True):
        assert one.offset == other.offset
        a, b = one.pieces[0].points, other.pieces[0].points
        # Steps of 1e-5 of the size are none; all other points are kept.
        assert distances_off(a, [RawPiece("", b, "")]).max() < 1e-3
        assert np.linalg.norm(a[:, None] - b, axis=2).min(axis=0).max() < 1e-9


def test_a_section_on_both_sides_is_two_halves(hull: Hull, tmp_path: Path) -> None:
    """Parted at its middle, where no point need be; one of the halves has the number."""
    drawing = ezdxf.filemanagement.read(io.StringIO(body_plan(hull, STATIONS)))
    space = drawing.modelspace()
    for each in list(space.query("LWPOLYLINE")):
        xy = np.array(each.get_points("xy"))
        whole = np.concatenate([xy[:0:-1] * [-1.0, 1.0], xy[1:]])
        space.add_lwpolyline(whole.tolist(), dxfattribs={"layer": "sections"})
        space.delete_entity(each)
    path = tmp_path / "plan.dxf"
    drawing.saveas(path)
    lines = read_lines(read_body_plan(path, BodyPlanRules(length=LENGTH)).text, unit="m")
    for line in lines.lines:
        assert line.pieces[0].points[:, 1].min() == 0.0


def test_labels_at_one_offset_from_their_sections_are_not_shared_out_anew(tmp_path: Path) -> None:
    """Over a keel deeper aft the fuller section need not lie nearer amidships."""
    rows, labels = [], []
    for k in range(1, 10):
        low, wide = 0.1 * k, 4.0 + 0.002 * (k - 5) ** 2
        z = np.linspace(low, 5.0, 21)
        y = wide * np.sqrt(1.0 - ((5.0 - z) / (5.0 - low)) ** 2)
        sign = -1.0 if k < 5 else 1.0
        rows.append(np.column_stack([sign * y, z]))
        labels.append((str(k), (sign * (wide + 0.2), 5.1)))
    drawing = ezdxf.filemanagement.new("R2000")
    drawing.units = 6
    for row, (word, place) in zip(rows, labels, strict=True):
        drawing.modelspace().add_lwpolyline(row.tolist())
        drawing.modelspace().add_text(word).dxf.insert = place
    path = tmp_path / "plan.dxf"
    drawing.saveas(path)
    lines = read_lines(read_body_plan(path, BodyPlanRules(length=100.0)).text, unit="m").lines
    lows = [line.pieces[0].points[0, 2] for line in lines]
    assert lows == pytest.approx(0.1 * np.arange(1, 10))


def test_a_body_plan_becomes_a_hull(hull: Hull, tmp_path: Path) -> None:
    """`ah.read` takes it with its scale and length, and tells what it took."""
    path = tmp_path / "plan.dxf"
    path.write_text(body_plan(hull, STATIONS, 100.0, "mm"), encoding="utf-8")
    back = ah.read(path, scale=100.0, length=LENGTH, draught=7.0, accept=True)
    assert len(back.groups["sections"].lines) == 9  # the hull goes on abaft of the first
    assert {"profile", "deck edge"} <= set(back.groups["boundary"].lines)
    assert back.adoption is not None
    assert any("station numbers" in note for note in back.adoption.notes)


@pytest.mark.parametrize(
    ("labels", "rules", "words"),
    [
        (False, {"length": LENGTH}, "no section of the body plan has a number"),
        (True, {}, "nothing tells how far apart"),
        (True, {"length": LENGTH, "unit": "mm"}, "the file says that its unit is 'm'"),
    ],
    ids=["no labels", "no length", "another unit"],
)
def test_what_is_missing_is_asked_for(
    hull: Hull, tmp_path: Path, labels: bool, rules: dict[str, object], words: str
) -> None:
    """Labels, the length or the spacing, the unit."""
    path = tmp_path / "plan.dxf"
    path.write_text(body_plan(hull, STATIONS, labels=labels), encoding="utf-8")
    with pytest.raises(BadInputError, match=words):
        read_body_plan(path, BodyPlanRules(**rules))  # type: ignore[arg-type]


def test_drawings_in_space_are_no_body_plans(hull: Hull, tmp_path: Path) -> None:
    """Neither lines in their places nor a lines plan of ours."""
    for form in ("dxf", "dxf-plan"):
        hull.export(tmp_path / "a.dxf", form)
        assert not is_body_plan(tmp_path / "a.dxf")
