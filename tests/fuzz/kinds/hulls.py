"""Small hulls that the inputs of other kinds are made of."""

from __future__ import annotations

import functools

from assoc_hull.hull import Hull
from assoc_hull.io.hull_json import dumps_hull_json
from tests.strategies import wigley_sources

__all__ = ["edited_text", "plain_text", "whole_hull"]


@functools.cache
def plain_text() -> str:
    """Two stations, two waterlines."""
    return dumps_hull_json(wigley_sources(2, 2).adopt())


@functools.cache
def whole_hull() -> Hull:
    """Seven stations, four waterlines: what other forms hold of it is taken, and is sound."""
    return Hull(wigley_sources(7, 4).adopt())


@functools.cache
def edited_text() -> str:
    """Of three families, with most of what a definition can tell."""
    hull = Hull(wigley_sources(2, 2, 1).adopt())
    with hull.edit("features") as edit:
        edit.insert("ST 1", (100 / 3, 1.2, 0.9), lead=False)
        edit.set_end("ST 2", "start", tangent=(0.0, 1.0, 0.1))
        edit.set_role("WL 2.083 x ST 2", "drives a")
        edit.rename("WL 2.083 x ST 1", "bilge")
    with hull.edit("more") as edit:
        edit.set_kind("ST 1 @ placed 1", "knuckle")
        edit.shift_line("WL 4.167", 4.2)
        edit.dissociate("waterlines", "buttocks")
    return dumps_hull_json(hull.state)
