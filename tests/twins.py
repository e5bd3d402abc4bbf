"""Hulls that are dear to make: made once, by one process, and handed out as twins.

A twin has the tables of the hull to the last bit, in arrays of its own, read-only where they
were. What edits leave in the tables is in the twin too; the history is not.
"""

from __future__ import annotations

import fcntl
import functools
import inspect
import io
import os
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.graph.table import BLOCK, Column, SparseColumn
from assoc_hull.hull.sources import Examples
from assoc_hull.shipped import bulk_carrier_207k, series60, wigley

__all__ = ["let_examples_give_twins", "made_once", "packed", "twin"]

T = TypeVar("T")


def _frozen(array: np.typing.NDArray[Any]) -> np.typing.NDArray[Any]:
    array.setflags(write=False)
    return array


def _column(
    kind: type[Column[Any]], store: np.typing.NDArray[Any], fill: float, count: int, writes: int
) -> Column[Any]:
    """Make a column whose rows in use are a view of its store, as it must be."""
    column = kind(store.dtype, store.shape[1:], fill)
    if isinstance(column, SparseColumn):
        column.resize(count)
        column.put(np.arange(count), store)
        column.writes = writes
        return column
    column._store, column.data, column.writes = store, _frozen(store[:count]), writes
    column.blocks = np.full(-(-len(store) // BLOCK), writes)
    return column


def _hull(state: Any, adoption: Any) -> ah.Hull:
    hull = ah.Hull(state)
    hull.adoption = adoption
    return hull


class _Pickler(pickle.Pickler):
    """Keeps what plain pickles lose: that an array is read-only, or a view of another."""

    def reducer_override(self, value: Any) -> Any:
        if isinstance(value, ah.Hull):
            assert not value.history, "the history stays behind"
            return _hull, (value.document.state, value.adoption)
        if isinstance(value, Column):
            store = value.data if isinstance(value, SparseColumn) else value._store
            what = type(value), store, value.fill, len(value.data), value.writes
            return _column, what
        if type(value) is np.ndarray and not value.flags.writeable:
            return _frozen, (value.copy(),)
        return NotImplemented


def packed(value: object) -> bytes:
    """Pack a hull, or a tuple with one: `twin` gives as many as are wanted."""
    out = io.BytesIO()
    _Pickler(out, pickle.HIGHEST_PROTOCOL).dump(value)
    return out.getvalue()


def twin(pack: bytes) -> Any:
    """Give a twin of what was packed."""
    return pickle.loads(pack)


def made_once(factory: pytest.TempPathFactory, name: str, make: Callable[[], T]) -> T:
    """Make a value, unless another process of this run of tests has made it, or is about to.

    The others wait for the first, and load a twin from a file beside their own folders.
    """
    if "PYTEST_XDIST_WORKER" not in os.environ:
        return make()
    path: Path = factory.getbasetemp().parent / f"{name}.pickle"
    with path.with_suffix(".lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if path.exists():
            found: T = twin(path.read_bytes())
            return found
        made = make()
        path.write_bytes(packed(made))
        return made


def let_examples_give_twins() -> None:
    """Let hulls that ship be made once in this process, and give twins of them from then on.

    Tests and examples ask for the Wigley hull thousands of times, and a net takes forty times as
    long to adopt as a twin to load. Modules that are imported already keep what makes them.
    """
    for name, make in inspect.getmembers(Examples, inspect.isfunction):
        if make.__annotations__["return"] == "Hull":
            setattr(Examples, name, _remembered(make))
    carrier = bulk_carrier_207k
    makers = (wigley, "wigley"), (series60, "series60_net"), (carrier, "bulk_carrier_207k_net")
    for module, name in makers:
        setattr(module, name, _remembered(getattr(module, name)))


def _remembered(make: Callable[..., T]) -> Callable[..., T]:
    packs = dict[str, bytes]()

    @functools.wraps(make)
    def give(*given: object, **named: object) -> T:
        what = repr((*(each for each in given if each is not ah.examples), sorted(named.items())))
        if what not in packs:
            packs[what] = packed(make(*given, **named))
        found: T = twin(packs[what])
        return found

    return give
