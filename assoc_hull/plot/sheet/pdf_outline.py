"""Bookmarks of a PDF: what a viewer lists beside the pages, to go to one of them.

Matplotlib writes none. They are appended as an update of the document, which is how the format
itself adds to a file: new objects, a table of where they lie, and a trailer that names the old one
(ISO 32000-1:2008, 7.5.6 incremental updates, 12.3.3 outline). The pages stay as they were written.

Examples
--------
>>> from assoc_hull.plot.sheet.pdf_outline import Bookmark, with_outline
>>> with_outline(b"no PDF", [Bookmark("Lines plan", 0, 2)])
b'no PDF'
"""

from __future__ import annotations

import re
from collections.abc import Sequence

import attrs

__all__ = ["Bookmark", "with_outline"]

_TRAILER = re.compile(
    rb"trailer\s*<<\s*/Size (\d+) /Root (\d+) 0 R(.*?)>>\s*startxref\s+(\d+)\s+%%EOF\s*\Z",
    re.DOTALL,
)
_KIDS = re.compile(rb"/Type /Pages\s*/Kids \[(.*?)\]", re.DOTALL)


@attrs.frozen
class Bookmark:
    """A line of the outline.

    Attributes
    ----------
    title : str
        Its words.
    level : int
        0 for a part, 1 for what stands below the part before it.
    page : int
        Where it leads, counted from 1.
    """

    title: str
    level: int
    page: int


def with_outline(pdf: bytes, marks: Sequence[Bookmark]) -> bytes:
    """Append bookmarks to a PDF as matplotlib writes one; another PDF is given back as it is."""
    trailer, kids = _TRAILER.search(pdf), _KIDS.search(pdf)
    if not marks or trailer is None or kids is None:
        return pdf
    size, root = int(trailer[1]), int(trailer[2])
    catalog = re.search(rb"\n%d 0 obj\n<<(.*?)>>\nendobj" % root, pdf, re.DOTALL)
    pages = [int(each) for each in re.findall(rb"(\d+) 0 R", kids[1])]
    if catalog is None or any(not 1 <= mark.page <= len(pages) for mark in marks):
        return pdf
    objects = {root: b"<<" + catalog[1] + b"/Outlines %d 0 R /PageMode /UseOutlines >>" % size}
    objects |= _outline(marks, pages, size)
    return pdf + _update(objects, trailer, len(pdf))


def _outline(marks: Sequence[Bookmark], pages: Sequence[int], first: int) -> dict[int, bytes]:
    """Give the objects of an outline by number, the first of which is the outline itself."""
    number = {k: first + 1 + k for k in range(len(marks))}
    above = dict[int, int | None]()
    part: int | None = None
    for k, mark in enumerate(marks):
        above[k] = part if mark.level else None
        part = part if mark.level else k
    families: dict[int | None, list[int]] = {}
    for k, parent in above.items():
        families.setdefault(parent, []).append(k)
    top = families[None]
    found = {
        first: b"<< /Type /Outlines /First %d 0 R /Last %d 0 R /Count %d >>"
        % (number[top[0]], number[top[-1]], len(top))
    }
    for parent, mine in families.items():
        for at, k in enumerate(mine):
            parts = [
                b"/Title <%s>" % (b"\xfe\xff" + marks[k].title.encode("utf-16-be")).hex().encode(),
                b"/Parent %d 0 R" % (first if parent is None else number[parent]),
                b"/Dest [%d 0 R /Fit]" % pages[marks[k].page - 1],
            ]
            if at:
                parts.append(b"/Prev %d 0 R" % number[mine[at - 1]])
            if at < len(mine) - 1:
                parts.append(b"/Next %d 0 R" % number[mine[at + 1]])
            below = families.get(k, [])
            if below:  # a negative count: shown closed
                ends = number[below[0]], number[below[-1]], len(below)
                parts.append(b"/First %d 0 R /Last %d 0 R /Count -%d" % ends)
            found[number[k]] = b"<< " + b" ".join(parts) + b" >>"
    return found


def _update(objects: dict[int, bytes], trailer: re.Match[bytes], start: int) -> bytes:
    """Write objects, the table of their places, and the trailer that leads to the one before."""
    # A table begins with the head of the list of free objects, also that of an update.
    body, table = b"", [b"0 1\n0000000000 65535 f \n"]
    for number, content in sorted(objects.items()):
        place = start + len(body)
        table.append(b"%d 1\n%010d 00000 n \n" % (number, place))
        body += b"%d 0 obj\n%s\nendobj\n" % (number, content)
    size = max(int(trailer[1]), max(objects) + 1)
    ends = b"<< /Size %d /Root %s 0 R%s /Prev %s >>" % (size, trailer[2], trailer[3], trailer[4])
    where = start + len(body)
    return (
        body
        + b"xref\n"
        + b"".join(table)
        + b"trailer\n%s\nstartxref\n%d\n%%%%EOF\n" % (ends, where)
    )
