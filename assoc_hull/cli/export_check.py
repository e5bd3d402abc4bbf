"""Options of `export` that do not go together, refused before anything is computed."""

from __future__ import annotations

import argparse

from assoc_hull.errors import BadInputError

__all__ = ["check_arcs", "check_form"]

_MESHES = ("stl", "stl-text", "obj", "ply", "glb")


def check_arcs(arguments: argparse.Namespace) -> None:
    """Refuse what means nothing without, or beside, a tolerance for arcs.

    Raises
    ------
    BadInputError
        A radius or lines without the tolerance; another form or its options with it.
    """
    name = str(arguments.out)
    if arguments.biarcs is None:
        told = {
            "--least-radius is one of arcs": arguments.least_radius is not None,
            "--lines chooses lines for arcs": arguments.lines is not None,
            "--entities is for a drawing of arcs": arguments.entities is not None,
        }
        remedy = "add --biarcs 0.5mm"
    else:
        told = {
            "--format is none of arcs": arguments.format is not None,
            "--views is none of arcs, which lie in their places": arguments.views is not None,
            "--scale is none of arcs": arguments.scale is not None,
            "--unit is none of arcs, which are in m": arguments.unit is not None,
            "--half is none of arcs, which are those of one half": arguments.half,
            "--points is none of arcs": arguments.points is not None,
        }
        remedy = "leave it out, and end the file in .dxf or .csv"
    _refuse(told, name, remedy)


def check_form(arguments: argparse.Namespace, form: str, *, mesh_or_surface: bool) -> str:
    """Refuse options that a form does not take; give the form, as the views choose it.

    Parameters
    ----------
    arguments : Namespace
        As they were typed.
    form : str
        By the format, or the ending.
    mesh_or_surface : bool
        Whether it holds these, and not lines.

    Raises
    ------
    BadInputError
        An option of another form.
    """
    drawn = form.startswith("dxf")
    told = {
        "--views chooses the views of a drawing": arguments.views is not None and form != "dxf",
        "--half is for surfaces and meshes": arguments.half and not mesh_or_surface,
        "--points is for meshes": arguments.points is not None and form not in _MESHES,
        "--unit is for drawings, surfaces and meshes": arguments.unit is not None
        and not (drawn or mesh_or_surface or form == "iges-lines"),
    }  # fmt: skip
    _refuse(told, str(arguments.out), "leave it out")
    chosen = "dxf-plan" if arguments.views == "2d" else form
    if arguments.scale is not None and chosen != "dxf-plan":
        _refuse({"--scale is for a lines plan": True}, str(arguments.out), "add --views 2d")
    return chosen


def _refuse(told: dict[str, bool], name: str, remedy: str) -> None:
    for what, given in told.items():
        if given:
            raise BadInputError(what, f"at {name}", remedy)
