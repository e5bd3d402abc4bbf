"""Hulls from STEP and trimmed IGES, read by OpenCASCADE: the same lines as from whole surfaces."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.errors import BadInputError, MissingExtraError, NeedsCadError
from assoc_hull.io.cad import kernel
from assoc_hull.io.cad.faces import face_of, sew_surfaces
from assoc_hull.io.cad.kernel import quiet_kernel
from assoc_hull.io.cad.read import require_sound_step, step_unit
from assoc_hull.io.cad.write import both_sides, step_bytes, write_cad
from assoc_hull.io.lines.slices import HullSlices
from assoc_hull.io.slicing.surface_lines import faces_of_file, read_surface_lines
from tests import meshes
from tests.iges_files import face, iges
from tests.unit.io.slicing.test_surface_slices import wigley

CUTS: dict[str, Any] = {"stations": [10.0, 50.0], "waterlines": [2.0], "buttocks": [2.0]}


def check_wigley(slices: HullSlices) -> None:
    """Every line is one piece on the formula, and ends on boundary curves."""
    for line in slices.lines:
        (piece,) = line.pieces
        x, y, z = piece.points.T
        assert np.abs(y - meshes.wigley_y(x, z)).max() < 1e-9
        assert "loose" not in piece.ends


def test_a_step_file_gives_exact_lines(tmp_path: Path) -> None:
    """Of both halves, in metres; the unit is told."""
    path = tmp_path / "wigley.step"
    surfaces = both_sides([wigley()])
    path.write_bytes(
        step_bytes(sew_surfaces(surfaces), [each.name for each in surfaces], "m", "hull")
    )
    slices = read_surface_lines(path, **CUTS)
    check_wigley(slices)
    assert "unit: the surfaces: m: the hull is 100 m long" in str(slices.report)
    assert "a whole hull" in str(slices.report)


def write_trimmed(path: Path, height: float) -> None:
    """Write the Wigley hull cut off at a height, as a trimmed surface of IGES."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
    from OCP.gp import gp_Pnt
    from OCP.IGESControl import IGESControl_Writer

    with quiet_kernel():
        box = BRepPrimAPI_MakeBox(gp_Pnt(-1e3, -1e3, -1e3), gp_Pnt(1e6, 1e6, 1e3 * height))
        common = BRepAlgoAPI_Common(face_of(wigley()), box.Shape())
        writer = IGESControl_Writer("MM", 0)
        writer.AddShape(common.Shape())
        writer.ComputeModel()
        assert writer.Write(str(path))


def test_a_trimmed_surface_is_cut_where_it_ends(tmp_path: Path) -> None:
    """The deck edge is that of the face, not of its surface; the file is in millimetres."""
    path = tmp_path / "trimmed.igs"
    write_trimmed(path, 5.0)
    slices = read_surface_lines(path, **CUTS)
    check_wigley(slices)
    assert "unit: the surfaces: mm: the hull is " in str(slices.report)
    assert slices.high[2] == pytest.approx(5.0, abs=1e-6)
    for line in slices.group("sections"):
        assert line.pieces[0].points[-1, 2] == pytest.approx(5.0, abs=2e-3)


def test_what_needs_the_extra_names_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """STEP, and trimmed IGES, which says why; whole surfaces need none."""
    monkeypatch.setattr(kernel, "find_spec", lambda name: None)
    step, trimmed, whole = (tmp_path / name for name in ("a.step", "b.igs", "c.igs"))
    step.write_text("ISO-10303-21;\nHEADER;\n")
    with pytest.raises(MissingExtraError, match=r"assoc-hull\[cad\]"):
        ah.read(step)
    trimmed.write_text(iges(face(((0, 0), (1, 0), (1, 1)))))
    with pytest.raises(NeedsCadError, match=r"is trimmed.*assoc-hull\[cad\]"):
        ah.read(trimmed)
    write_cad([wigley()], whole, "iges-surfaces", half=True)
    assert len(faces_of_file(whole).surfaces) == 1


@pytest.mark.parametrize("text", [
    pytest.param("ISO-10303-21;\nHEADER;\n", id="cut short"),
    pytest.param("ISO-10303-21;HEADER;ENDSEC;DATA;ENDSEC;END-ISO-10303-21;", id="empty"),
    pytest.param("ISO-10303-21;HEADER;ENDSEC;DATA;\n#1=PLANE('',#1);ENDSEC;END-ISO-10303-21;",
                 id="in a ring"),
])  # fmt: skip
def test_a_damaged_step_file_is_refused(
    tmp_path: Path, text: str, capfd: pytest.CaptureFixture[str]
) -> None:
    """In one line, and OpenCASCADE prints none of its own."""
    path = tmp_path / "bad.step"
    path.write_text(text)
    with pytest.raises(BadInputError, match=r"in bad\.step"):
        ah.read(path)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(("old", "new", "message"), [
    pytest.param("END-ISO-10303-21;", "", "cut short", id="no end"),
    pytest.param("1.,2.", "nan,2.", "no statement.*nan", id="no number"),
    pytest.param("1.,2.", "1e999,2.", "too large", id="no finite number"),
    pytest.param("#1,", "#-1,", "no statement", id="no reference"),
    pytest.param("#1,", "#3,", "no entity #3", id="a reference to nothing"),
    pytest.param("2.))", "2.)", "no statement", id="an open bracket"),
    pytest.param(".T.,", ".T.,,", "no statement", id="no value"),
    pytest.param("#2 = ", "", "no statement", id="no name"),
    pytest.param("DATA;", "", "no data", id="no data section"),
])  # fmt: skip
def test_text_that_ends_opencascade_is_refused_before(old: str, new: str, message: str) -> None:
    """Each of these ended the process, hung, or could; strings may hold anything."""
    text = (
        "ISO-10303-21;\nHEADER;\nFILE_NAME('a;''b#9','',(''),(''),'','','');ENDSEC;\nDATA;\n"
        "#1 = CARTESIAN_POINT('nan #7 (',(0.,1.,2.));\n/* nan; */"
        "#2 = LINE('',#1,.T.,-1.5E-07,$,*);\nENDSEC;\nEND-ISO-10303-21;\n"
    )
    require_sound_step(text, "a.step")
    with pytest.raises(BadInputError, match=rf"{message}.*in a\.step"):
        require_sound_step(text.replace(old, new), "a.step")


@pytest.mark.parametrize(("entity", "unit"), [
    ("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.))", "m"),
    ("( LENGTH_UNIT ( )\nNAMED_UNIT(*) SI_UNIT (.CENTI. , .METRE.) )", "cm"),
    ("(CONVERSION_BASED_UNIT('foot',#9)LENGTH_UNIT()NAMED_UNIT(#8))", "ft"),
    ("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.KILO.,.METRE.))", None),
    ("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))", None),
])  # fmt: skip
def test_the_unit_of_a_step_file(entity: str, unit: str | None) -> None:
    """As it may be written; what is no length, or none that is known, is none."""
    assert step_unit(f"#1=PLANE('',#2);\n#7= {entity} ;") == unit
