"""What the parts of `io.mesh` give, one small example of each."""

from __future__ import annotations

import tempfile
from pathlib import Path

from assoc_hull.hull.sources import examples
from assoc_hull.io.mesh.closed_mesh import write_mesh
from assoc_hull.surface.cells.closed_mesh import closed_mesh


def test_a_closed_mesh_as_a_file_stl_obj_ply() -> None:
    """A closed mesh as a file: STL, OBJ, PLY or glTF, whole or not at all."""
    mesh = closed_mesh(examples.wigley(stations=5, waterlines=4), points=2)
    with tempfile.TemporaryDirectory() as folder:
        report = write_mesh(mesh, Path(folder) / "wigley.stl", unit="mm")
    assert (report.form, report.unit, report.groups) == ("stl", "mm", ("shell", "deck"))
