"""What commands print: facts on standard output, as text or as one JSON document."""

from __future__ import annotations

import argparse
import contextlib
import json
import math
import sys
import threading
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import attrs
import numpy as np

from assoc_hull.edit.explain.causes import Why
from assoc_hull.graph.derived import Gate
from assoc_hull.io.reports import Tell, no_progress

__all__ = ["can_print", "emit", "plain", "progress", "progress_bar", "say", "why_document"]

_PATIENCE = 1.0
"""Seconds after which a person is told what takes so long."""


def emit(arguments: argparse.Namespace, document: Mapping[str, Any], text: str) -> None:
    """Print the document if JSON was asked for, else the text."""
    say(json.dumps(plain(document), indent=1, allow_nan=False) if arguments.json else text)


def say(text: str) -> None:
    """Print on standard output; characters that it cannot take become their numbers."""
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    print(text.encode(encoding, "backslashreplace").decode(encoding))


def can_print(marks: str) -> bool:
    """Tell whether standard output can take some characters."""
    try:
        marks.encode(getattr(sys.stdout, "encoding", None) or "utf-8")
    except UnicodeEncodeError:
        return False
    return True


def plain(value: Any) -> Any:
    """Give what JSON can say; numbers that are not finite become null.

    Examples
    --------
    >>> from assoc_hull.cli.output import plain
    >>> from assoc_hull.edit.step import Movement
    >>> plain([Movement("P", float("inf"), (0.0, 1.0, 2.0)), Path("a")])
    [{'point': 'P', 'distance': None, 'place': [0.0, 1.0, 2.0], 'name': ''}, 'a']
    """
    if isinstance(value, Why):
        return why_document(value)
    if attrs.has(type(value)):
        return {
            field.name: plain(getattr(value, field.name))
            for field in attrs.fields(type(value))
            if field.repr
        }
    if isinstance(value, Mapping):
        return {str(key): plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [plain(each) for each in value]
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, Path):
        return str(value)
    return None if isinstance(value, float) and not math.isfinite(value) else value


def why_document(cause: Why, told: set[str] | None = None) -> dict[str, Any]:
    """Give a tree of causes; an object that was told already comes again without its causes."""
    known = set() if told is None else told
    again = cause.object in known
    known.add(cause.object)
    return {
        "object": cause.object,
        "name": cause.name,
        "edit": cause.edit,
        "step": cause.step,
        "moved": plain(cause.moved),
        "what": cause.what,
        "again": again,
        "causes": [] if again else [why_document(each, known) for each in cause.causes],
        "stopped": list(cause.stopped),
        "because": cause.because,
        "left": cause.left,
    }


@contextlib.contextmanager
def progress(what: str) -> Iterator[None]:
    """Say on standard error what is being done and since when, if a person would wait for it.

    Nothing may be printed meanwhile; nothing is where no terminal shows it.
    """
    if sys.stderr is None or not sys.stderr.isatty():
        yield
        return

    def show() -> contextlib.AbstractContextManager[Any]:
        from rich.console import Console
        from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

        clock = Progress(
            SpinnerColumn(), TextColumn("{task.description}"), TimeElapsedColumn(),
            console=Console(stderr=True), transient=True,
            redirect_stdout=False, redirect_stderr=False,
        )  # fmt: skip
        clock.add_task(f"{what} ...")
        return clock

    with _patiently(show):
        yield


@contextlib.contextmanager
def progress_bar(what: str, *, hidden: bool) -> Iterator[Tell]:
    """Show on standard error how far work is, on a terminal and unless it is hidden.

    Parameters
    ----------
    what : str
        What is done, until work tells more.
    hidden : bool
        Whether nothing is shown.

    Yields
    ------
    callable
        What work is to tell: the step, parts done, and of how many.
    """
    if hidden or sys.stderr is None or not sys.stderr.isatty():
        yield no_progress
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    bar = Progress(
        SpinnerColumn(), TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn(),
        console=Console(stderr=True), transient=True, redirect_stdout=False, redirect_stderr=False,
    )  # fmt: skip
    task = bar.add_task(what, total=None)

    def tell(step: str, done: int, of: int) -> None:
        bar.update(task, description=f"{what}: {step}", completed=done, total=of or None)

    with _patiently(lambda: bar):
        yield tell


@contextlib.contextmanager
def _patiently(shown: Callable[[], contextlib.AbstractContextManager[Any]]) -> Iterator[None]:
    """Enter a context after some time, from another thread, if work is not done by then."""
    with contextlib.ExitStack() as stack:
        gate, done = Gate(), threading.Event()

        def show() -> None:
            context = shown()
            gate.alone(lambda: None if done.is_set() else stack.enter_context(context))

        timer = threading.Timer(_PATIENCE, show)
        timer.daemon = True
        timer.start()
        try:
            yield
        finally:
            timer.cancel()
            gate.alone(done.set)
