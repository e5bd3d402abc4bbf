"""Holes of profiles, and lines that pass the centre plane: mended or refused at import."""

from pathlib import Path

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import NotSoundError
from assoc_hull.hull import Hull
from assoc_hull.io.lines.line_points import lines_as_points


def workboat(hole: float, beyond: float = 0.0) -> str:
    """The lines of a boat of 25 m as text, its keel with a hole (m), sections beyond y = 0 (m)."""
    hull = ah.examples.wigley(25.0, 6.0, 2.0, stations=11, waterlines=6)
    rows = ["line,piece,x,y,z"]
    for line in lines_as_points(hull.state, ("boundary", "sections", "waterlines"), 1e-3):
        pieces = [np.round(piece.points, 6) for piece in line.pieces]
        if line.name == "profile" and hole:
            (points,) = pieces
            ends = np.array([[10.0, 0.0, 0.0], [10.0 + hole, 0.0, 0.0]])
            pieces = [
                np.vstack([points[points[:, 0] < 10.0], ends[:1]]),
                np.vstack([ends[1:], points[points[:, 0] > 10.0 + hole]]),
            ]
        for number, points in enumerate(pieces):
            if line.group == "sections" and beyond and abs(line.offset - 12.5) < 1.0:
                points = np.vstack([points[0] + [0.0, -beyond, 0.0], points[1:]])
            rows += [f"{line.name},{number},{x!r},{y!r},{z!r}" for x, y, z in points.tolist()]
    return "\n".join(rows) + "\n"


def read(folder: Path, text: str, **options: float) -> Hull:
    """Import a text with the particulars of the boat."""
    path = folder / "boat.csv"
    path.write_text(text, encoding="utf-8")
    return ah.read(path, length=25.0, breadth=6.0, draught=1.8, **options)  # type: ignore[arg-type]


def test_a_hole_in_the_keel_is_refused_and_its_remedy_leads_to_a_closed_hull(
    tmp_path: Path,
) -> None:
    """170 mm in the keel of a workboat: place and width are told; with join= all runs."""
    text = workboat(0.17)
    with pytest.raises(NotSoundError, match=r"profile: a hole of 170 mm at \(10\.08") as refused:
        read(tmp_path, text)
    assert "give join= of 0.17" in str(refused.value)
    hull = read(tmp_path, text, join=0.171)
    assert hull.mesh().report.sound
    assert hull.hydrostatics().volume == pytest.approx(
        read(tmp_path, workboat(0.0)).hydrostatics().volume, rel=5e-4
    )
    assert hull.check() == ()


def test_a_narrow_hole_is_joined_unasked(tmp_path: Path) -> None:
    """7 mm are within the tolerance of the file: the net closes."""
    hull = read(tmp_path, workboat(0.007))
    assert hull.mesh().report.sound


def test_sections_are_cut_where_they_pass_the_centre_plane(tmp_path: Path) -> None:
    """4 mm beyond y = 0 are cut off at import, and the hull can be edited."""
    hull = read(tmp_path, workboat(0.0, beyond=0.004))
    assert min(hull.state.rows.xyz[hull.state.live("rows"), 1]) >= 0.0
