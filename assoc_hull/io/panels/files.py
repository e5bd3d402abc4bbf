"""Panels in files of seakeeping codes: written whole or not at all, and read back.

Examples
--------
>>> import tempfile
>>> from pathlib import Path
>>> from assoc_hull.analysis.panels.hull_panels import panels
>>> from assoc_hull.io.panels.files import read_panels, write_panels
>>> from assoc_hull.hull.sources import examples
>>> mesh = panels(examples.wigley(), count=200)
>>> with tempfile.TemporaryDirectory() as folder:
...     write_panels(mesh, Path(folder) / "wigley.gdf")
...     again = read_panels(Path(folder) / "wigley.gdf")
>>> again.count, again.mirror_y
(200, True)
"""

from __future__ import annotations

import gzip
import io
import os
import zlib
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType

from assoc_hull.arguments import choice, file_path, instance, regular_file
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh
from assoc_hull.io.panels.formats import (
    dumps_gdf,
    dumps_mar,
    dumps_pnl,
    dumps_stl,
    dumps_stl_text,
    is_gdf,
    is_mar,
    is_pnl,
    is_stl,
    loads_gdf,
    loads_mar,
    loads_pnl,
    loads_stl,
)
from assoc_hull.io.write_file import form_by_ending, write_whole

__all__ = ["PANEL_FORMS", "panel_bytes", "panel_form_of", "read_panels", "write_panels"]

PANEL_FORMS: Mapping[str, str] = MappingProxyType({
    "nemoh": ".mar", "wamit": ".gdf", "hams": ".pnl", "stl": ".stl", "stl-text": "",
})  # fmt: skip
"""The forms, and the ending of a file that means each."""

_MOST_BYTES = 500_000_000


def panel_form_of(path: str | os.PathLike[str], form: str | None = None) -> str:
    """Tell in which form a file is to be written: the one asked for, else by its ending.

    Raises
    ------
    BadInputError
        Neither says one.

    Examples
    --------
    >>> from assoc_hull.io.panels.files import panel_form_of
    >>> panel_form_of("HullMesh.pnl"), panel_form_of("mesh.dat", "nemoh")
    ('hams', 'nemoh')
    """
    endings = {ending: name for name, ending in PANEL_FORMS.items() if ending}
    return form_by_ending(path, form, tuple(PANEL_FORMS), endings, "in panels")


def panel_bytes(mesh: PanelMesh, form: str) -> bytes:
    """Give the content of a file in a form, one of `PANEL_FORMS`."""
    instance(mesh, PanelMesh, "the mesh", "in panels")
    if choice(form, "format", tuple(PANEL_FORMS), "in panels") == "stl":
        return dumps_stl(mesh)
    write = {"nemoh": dumps_mar, "wamit": dumps_gdf, "hams": dumps_pnl, "stl-text": dumps_stl_text}
    return write[form](mesh).encode("utf-8")


def write_panels(mesh: PanelMesh, path: str | os.PathLike[str], form: str | None = None) -> None:
    """Write a mesh for a seakeeping code.

    Parameters
    ----------
    mesh : PanelMesh
        The mesh.
    path : path
        The file; what was there is replaced by the whole of it, or stays.
    form : str or None
        "nemoh", "wamit", "hams", "stl" or "stl-text"; by the ending of the file if None.

    Raises
    ------
    BadInputError
        A form that is not known, or a file that cannot be written.
    """
    write_whole(path, panel_bytes(mesh, panel_form_of(path, form)))


def read_panels(path: str | os.PathLike[str]) -> PanelMesh:
    """Read a mesh of panels; its content tells the form, and it may be packed with gzip.

    Parameters
    ----------
    path : path
        A file for Nemoh, WAMIT (low order) or HAMS, or an STL.

    Returns
    -------
    PanelMesh
        Equal vertices are one; panels that have no area because of it are left out. Nothing is
        known of what it was made of.

    Raises
    ------
    BadInputError
        The file cannot be read, is of none of these forms, or is damaged; with the line.
    """
    name = file_path(path, "in panels")
    data = _unpacked(Path(name))
    if is_stl(data):
        return loads_stl(data, name)
    text = data.decode("utf-8", "replace").removeprefix("\ufeff")
    for known, loads in ((is_pnl, loads_pnl), (is_mar, loads_mar), (is_gdf, loads_gdf)):
        if known(text):
            return loads(text, name)
    remedy = "give a file for Nemoh, WAMIT (low order) or HAMS, or an STL, whole"
    raise BadInputError("this is no file of panels", f"at {name}", remedy)


def _unpacked(path: Path) -> bytes:
    try:
        with regular_file(path).open("rb") as file:
            data = file.read(_MOST_BYTES + 1)
        if data[:2] == b"\x1f\x8b":
            data = gzip.GzipFile(fileobj=io.BytesIO(data)).read(_MOST_BYTES + 1)
    except (OSError, EOFError, zlib.error) as error:
        raise BadInputError(
            f"the file cannot be read ({error})", f"at {path}", "check name and file"
        ) from error
    if len(data) > _MOST_BYTES:
        raise BadInputError("the file is larger than 500 MB", f"at {path}", "thin the mesh first")
    return data
