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

__all__ = ["ShownAsText", "html_table"]


class _Printer(Protocol):
    """What IPython hands to `_repr_pretty_`."""

    def text(self, obj: str, /) -> None:
        """Write some text."""


class ShownAsText:
    """What a notebook, and a prompt of IPython, shows as `print` does."""

    __slots__ = ()

    def _repr_pretty_(self, printer: _Printer, cycle: bool) -> None:
        printer.text(str(self) if not cycle else "...")


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
