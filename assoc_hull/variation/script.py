"""Variations as scripts: what was asked as data, and JSON files of it.

The same parent and the same script give the same hull to the last bit, in whichever form and
process. A program in Python that calls ``assoc_hull.vary`` is a script of the other form.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from types import MappingProxyType
from typing import Any

import attrs

from assoc_hull.arguments import file_path, once
from assoc_hull.errors import BadInputError
from assoc_hull.model.line import Group, Line
from assoc_hull.variation.ask import VERSION, Ask
from assoc_hull.variation.parameters.layout import Layout

__all__ = ["read_script", "script_of"]


def read_script(path: str | PathLike[str]) -> dict[str, Any]:
    """Read a script file; a script without a name is called as the file is.

    Parameters
    ----------
    path : path
        A JSON file with one object; `assoc_hull.variation.ask` says what it may hold.

    Raises
    ------
    BadInputError
        It cannot be read, is no JSON, holds no object, or a key twice.
    """
    file = Path(file_path(path, "in vary"))
    try:
        found = json.loads(file.read_text(encoding="utf-8"), object_pairs_hook=once)
    except OSError as error:
        raise BadInputError(
            f"script {file}: {error.strerror or error}", "in vary", "check name and place"
        ) from error
    except (ValueError, RecursionError) as error:
        raise BadInputError(f"script {file} is no JSON: {error}", "in vary", "mend it") from error
    if not isinstance(found, dict):
        raise BadInputError(
            f"script {file} holds a {type(found).__name__}", "in vary", "give an object"
        )
    return {"name": file.stem, **found}


def script_of(ask: Ask) -> Mapping[str, Any] | None:
    """Give what was asked for as data; None where layers were not given as data.

    Examples
    --------
    >>> from assoc_hull.variation.ask import Ask
    >>> from assoc_hull.variation.script import script_of
    >>> dict(script_of(Ask.of({"breadth": 51.5}, layout={"stern": 0.3})))["layout"]
    {'stern': 0.3}
    """
    if ask.given is None or (ask.reach is not None and ask.reach.given is None):
        return None
    usual = attrs.asdict(Layout())
    found: dict[str, Any] = {"version": VERSION, "set": dict(ask.values)}
    if ask.reach is not None:
        found.update(ask.reach.data())
    layout = {name: each for name, each in attrs.asdict(ask.layout).items() if each != usual[name]}
    if layout:
        found["layout"] = layout
    if ask.given:
        found["layers"] = list(ask.given)
    if ask.drivers is not None:
        found["drivers"] = [_name(each) for each in ask.drivers]
    found.update(stations=ask.stations, planes=ask.planes, tolerance=ask.tolerance, name=ask.name)
    return MappingProxyType(found)


def _name(driver: Group | Line | str) -> str:
    return driver if isinstance(driver, str) else driver.name
