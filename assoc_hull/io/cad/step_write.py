"""A shell of spline surfaces as STEP (AP214), by OpenCASCADE.

The same surfaces give the same bytes: the header holds a fixed time, as ours in IGES does, and no
name of a user; the counter that OpenCASCADE puts behind the name of the part is taken off.

Source: ISO 10303-21 (the file) and ISO 10303-214 (what it holds).
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Any

from assoc_hull.errors import BadInputError
from assoc_hull.io.cad.faces import Sewn
from assoc_hull.io.cad.kernel import quiet, words

__all__ = ["step_bytes"]

_TIME = "2000-01-01T00:00:00"
_UNITS = {"m": "M", "mm": "MM"}


def step_bytes(sewn: Sewn, names: Sequence[str], unit: str, name: str) -> bytes:
    """Lay out a shell as the bytes of a STEP file.

    Parameters
    ----------
    sewn : Sewn
        The shell.
    names : sequence of str
        One for each face.
    unit : {"m", "mm"}
        Of the lengths in the file.
    name : str
        Of the part.

    Raises
    ------
    BadInputError
        OpenCASCADE does not write it.
    """
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer

    settings = {"write.step.schema": "AP214IS", "write.step.unit": _UNITS[unit]}
    with quiet(settings):
        writer = STEPControl_Writer()
        kind = STEPControl_StepModelType.STEPControl_ShellBasedSurfaceModel
        done = writer.Transfer(sewn.shell, kind)
        if done == IFSelect_ReturnStatus.IFSelect_RetDone:
            _name_faces(writer, sewn, names)
            _name_part(writer.Model(), name)
            _set_header(writer.Model(), name)
            out = io.BytesIO()
            done = writer.WriteStream(out)
    if done != IFSelect_ReturnStatus.IFSelect_RetDone:
        what = f"OpenCASCADE does not write these surfaces as STEP ({done.name})"
        raise BadInputError(what, "in write_cad", "write IGES")
    return out.getvalue()


def _name_faces(writer: Any, sewn: Sewn, names: Sequence[str]) -> None:
    from OCP.STEPConstruct import STEPConstruct

    finder = writer.WS().TransferWriter().FinderProcess()
    for face, name in zip(sewn.faces, names, strict=True):
        STEPConstruct.FindEntity_s(finder, face).SetName(words(name))


def _name_part(model: Any, name: str) -> None:
    from OCP.StepBasic import StepBasic_Product

    for number in range(1, model.NbEntities() + 1):
        entity = model.Value(number)
        if isinstance(entity, StepBasic_Product):
            entity.SetId(words(name))
            entity.SetName(words(name))


def _set_header(model: Any, name: str) -> None:
    from OCP.APIHeaderSection import APIHeaderSection_MakeHeader

    header = APIHeaderSection_MakeHeader(model)
    header.SetName(words(name))
    header.SetTimeStamp(words(_TIME))
    header.SetDescriptionValue(1, words("Surface of a hull"))
    header.SetAuthorValue(1, words(""))
    header.SetOrganizationValue(1, words(""))
    header.SetOriginatingSystem(words("assoc-hull"))
