"""What the parts of `io.cad` give, one small example of each."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.io.cad.check_file import area_of, declared_unit
from assoc_hull.io.cad.faces import sew_surfaces
from assoc_hull.io.cad.read import read_faces, require_sound_step, step_unit
from assoc_hull.io.cad.write import both_sides, step_bytes, write_cad


def test_the_half_of_a_hull_to_port_and_its() -> None:
    """The half of a hull to port and its image to starboard."""
    side = SplineSurface.bezier(
        np.array([[[0, 1, 0], [0, 1, 2]], [[5, 1, 0], [5, 1, 2]]], float), "side"
    )
    _port, starboard = both_sides([side])
    assert (starboard.name, starboard.at(0.0, 1.0).tolist()) == (
        "side, starboard",
        [5.0, -1.0, 2.0],
    )


def test_surfaces_of_a_hull_for_cad_programs_step() -> None:
    """Surfaces of a hull for CAD programs: STEP or IGES, read back and compared before it is
    kept."""
    side = SplineSurface.bezier(
        np.array([[[5, 0, 0], [5, 1, 2]], [[0, 0, 0], [0, 1, 2]]], float), "side"
    )
    with tempfile.TemporaryDirectory() as folder:
        report = write_cad([side], Path(folder) / "hull.step", unit="m")
    assert (report.faces, report.shells, report.joined_edges, report.free_edges) == (2, 1, 1, 6)


def test_what_opencascade_finds_in_a_file_of_surfaces() -> None:
    """What OpenCASCADE finds in a file of surfaces, as numbers to compare with what was
    written."""
    assert (
        declared_unit(b"#5=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));", "step") == "mm"
    )


def test_whether_a_file_holds_what_was_to_be_written() -> None:
    """Whether a file holds what was to be written, as OpenCASCADE reads it: for every file we
    write."""
    side = SplineSurface.bezier(
        np.array([[[0, 1, 0], [0, 1, 2]], [[5, 1, 0], [5, 1, 2]]], float), "side"
    )
    assert round(area_of(side), 9) == 10.0


def test_whether_the_text_of_a_step_file_is_sound() -> None:
    """Whether the text of a STEP file is sound, before OpenCASCADE reads it; and its unit of
    length."""
    unit = "#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));"
    text = f"ISO-10303-21;HEADER;ENDSEC;DATA;{unit}ENDSEC;END-ISO-10303-21;"
    require_sound_step(text, "a.step")
    assert step_unit(text) == "mm"


def test_faces_of_step_and_of_trimmed_iges_files_through() -> None:
    """Faces of STEP and of trimmed IGES files through OpenCASCADE, as surfaces and their
    triangles."""
    side = SplineSurface.bezier(
        np.array([[[0, 1, 0], [0, 1, 2]], [[5, 1, 0], [5, 1, 2]]], float), "side"
    )
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "side.step"
        path.write_bytes(step_bytes(sew_surfaces([side]), ["side"], "mm", "hull"))
        faces = read_faces(path, "step", "mm", None)
    assert faces.surfaces[0] is not None
    assert (faces.surfaces[0].domain, len(faces.facets(0.01, 1.0).mesh.face)) == (
        ((0.0, 1.0), (0.0, 1.0)),
        2,
    )
