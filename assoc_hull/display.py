"""How results show themselves in a notebook: as the text that `print` gives, or as a table.

Nothing here imports IPython; it asks objects for these methods.

Examples
--------
>>> from assoc_hull.display import html_table
>>> html_table(("what", "m"), [("draught", "18.00")], right=(1,))[:20]
'<table><thead><tr><t'
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from html import escape
from typing import Protocol

__all__ = [
    "Printer",
    "ShownAsText",
    "counted",
    "html_room",
    "html_table",
    "html_text",
    "screenful",
    "shortened",
]


class Printer(Protocol):
    """What IPython hands to `_repr_pretty_`."""

    def text(self, obj: str, /) -> None:
        """Write some text."""


_SCREEN = 40
"""Lines of a text that a prompt shows of it."""

_ROOM = "max-height:32em;overflow:auto"
"""What is longer is scrolled within its place in a notebook."""


class ShownAsText:
    """What a notebook, and a prompt of IPython, shows as `print` does: as much as fits a screen."""

    __slots__ = ()

    def __repr__(self) -> str:
        first = next(iter(str(self).splitlines()), "")
        return f"<{type(self).__name__}: {shortened(' '.join(first.split()))}>"

    def _repr_pretty_(self, printer: Printer, cycle: bool) -> None:
        printer.text(screenful(str(self)) if not cycle else "...")

    def _repr_html_(self) -> str:
        return html_text(str(self))


def counted(number: int, thing: str) -> str:
    """Give a number of things in words.

    Examples
    --------
    >>> from assoc_hull.display import counted
    >>> counted(1, "curve"), counted(0, "curve")
    ('1 curve', '0 curves')
    """
    return f"{number} {thing}{'' if number == 1 else 's'}"


def shortened(text: str, most: int = 90) -> str:
    """Give a text within so many signs; dots stand for the rest."""
    return text if len(text) <= most else f"{text[: most - 3].rstrip()}..."


def screenful(text: str) -> str:
    """Give as many lines of a text as fit a screen, and how the others are seen."""
    lines = text.splitlines()
    if len(lines) <= _SCREEN:
        return text
    left = len(lines) - _SCREEN + 1
    return "\n".join([*lines[: _SCREEN - 1], f"({left} more lines: print() shows them)"])


def html_text(text: str) -> str:
    """Give a text as HTML, line by line; a long one is scrolled in its place."""
    wrap = "pre" if "\n" in text else "pre-wrap"
    return f'<pre style="{_ROOM};white-space:{wrap}">{escape(text)}</pre>'


def html_room(*parts: str) -> str:
    """Give parts of HTML one below the other; what is longer than a screen is scrolled."""
    return f'<div style="{_ROOM}">{"".join(parts)}</div>'


def html_table(
    head: Sequence[str], rows: Iterable[Sequence[str]], right: Collection[int] = ()
) -> str:
    """Give a table as HTML; columns in `right` stand at the right, as numbers do."""
    return (
        f"<table><thead><tr>{_cells('th', head, right)}</tr></thead><tbody>"
        + "".join(f"<tr>{_cells('td', row, right)}</tr>" for row in rows)
        + "</tbody></table>"
    )


def _cells(tag: str, row: Sequence[str], right: Collection[int]) -> str:
    return "".join(
        f'<{tag} style="text-align:{"right" if place in right else "left"}">{escape(text)}</{tag}>'
        for place, text in enumerate(row)
    )
