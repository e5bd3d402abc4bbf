"""A hull that a command changes: read from one file, written to it or to another."""

from __future__ import annotations

import argparse
from pathlib import Path

import attrs

from assoc_hull.cli.arguments import HULL_ENDINGS
from assoc_hull.cli.problems import check_hull_target, check_target, is_apart
from assoc_hull.hull import Hull
from assoc_hull.sources import open as open_hull

__all__ = ["Changed", "open_to_change"]


@attrs.frozen(eq=False)
class Changed:
    """A hull, and where it goes once it is changed.

    Attributes
    ----------
    hull : Hull
        The hull; what is done to it is not in the file that it came from if it goes elsewhere.
    target : Path
        Where it goes.
    apart : bool
        Whether that is another file.
    replace : bool
        Whether that file may be there already.
    """

    hull: Hull
    target: Path
    apart: bool
    replace: bool

    def save(self) -> None:
        """Write the hull, unless it is in its file already."""
        if self.apart or self.hull.path is None:
            self.hull.save(self.target, replace=self.replace)


def open_to_change(arguments: argparse.Namespace) -> Changed:
    """Open a hull after it is sure that it can be written where it is to go.

    Parameters
    ----------
    arguments : Namespace
        With ``hull``, ``out``, ``wait`` and ``replace``.

    Raises
    ------
    AssocHullError
        The hull cannot be read, or not be written there.
    """
    target: Path = arguments.out or arguments.hull
    apart = is_apart(arguments.out, arguments.hull)
    check_target(target, HULL_ENDINGS)
    if apart:
        check_hull_target(target, replace=arguments.replace)
    hull = open_hull(arguments.hull, wait=arguments.wait)
    if apart:
        hull.detach()
    return Changed(hull, target, apart, arguments.replace)
