"""Spline surfaces as IGES, by OpenCASCADE: trimmed surfaces (144 on 128), or faces of a shell.

Entities 144 do not know their neighbours; faces of a shell (514, 510) do, and fewer programs read
them. The same surfaces give the same bytes.

Source: IGES 5.3 (US PRO, 1996), sections 4.34, 4.24 and 4.148 to 4.151.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Any

from assoc_hull.errors import BadInputError
from assoc_hull.io.cad.faces import Sewn
from assoc_hull.io.cad.kernel import quiet, words

__all__ = ["iges_bytes"]

_TIME = "20000101.000000"
_UNITS = {"m": "M", "mm": "MM"}
_FACES = (144, 510)
_DIGITS = 12
"""Behind the point; of 14 and more OpenCASCADE loses the power of ten."""


def iges_bytes(
    sewn: Sewn, names: Sequence[str], unit: str, name: str, *, shell: bool = False
) -> bytes:
    """Lay out a shell as the bytes of an IGES file.

    Parameters
    ----------
    sewn : Sewn
        The shell.
    names : sequence of str
        One for each face; what is no ASCII is written as ``?``.
    unit : {"m", "mm"}
        Of the lengths in the file.
    name : str
        Of the part.
    shell : bool
        Whether faces keep their edges in common (514, 510); else each is a 144 by itself.

    Raises
    ------
    BadInputError
        OpenCASCADE does not write it.
    """
    from OCP.IGESControl import IGESControl_Writer

    with quiet():
        writer = IGESControl_Writer(_UNITS[unit], int(shell))
        done = writer.AddShape(sewn.shell)
        if done:
            _set_head(writer.Model(), name)
            writer.ComputeModel()
            _name_faces(writer.Model(), names)
            data = _printed(writer.Model())
    if not done:
        what = "OpenCASCADE does not write these surfaces as IGES"
        raise BadInputError(what, "in write_cad", "write the form 'iges-surfaces'")
    return data


def _set_head(model: Any, name: str) -> None:
    head = model.GlobalSection()
    head.SetDate(words(_TIME))
    head.SetLastChangeDate(words(_TIME))
    head.SetSendName(words(name))
    head.SetFileName(words("surfaces.igs"))
    head.SetAuthorName(words(""))
    head.SetCompanyName(words(""))
    model.SetGlobalSection(head)


def _name_faces(model: Any, names: Sequence[str]) -> None:
    """Label faces, by eight letters; face and surface have the whole name as a property."""
    from OCP.IGESBasic import IGESBasic_Name

    numbers = range(1, model.NbEntities() + 1)
    entities = [model.Entity(number) for number in numbers]
    faces = [each for each in entities if each.TypeNumber() in _FACES]
    for face, name in zip(faces, names, strict=True):
        face.SetLabel(words(name[:8]))
        called = IGESBasic_Name()
        called.Init(1, words(name))
        for each in (face, face.Surface()):
            each.AddProperty(called)
        model.AddEntity(called)


def _printed(model: Any) -> bytes:
    """Print with more digits than OpenCASCADE does: its nine leave 0.05 micrometres at 100 m."""
    from OCP.IGESData import IGESData_IGESWriter

    printer, out = IGESData_IGESWriter(model), io.BytesIO()
    printer.FloatWriter().SetDefaults(_DIGITS)
    printer.SendModel(model.Protocol())
    printer.Print(out)
    return out.getvalue()
