"""Several sheets as one PDF: the same bytes each time."""

from __future__ import annotations

import io
from collections.abc import Iterable

from assoc_hull.plot.sheet.sheet import Sheet, require_matplotlib

__all__ = ["pdf_of"]


def pdf_of(sheets: Iterable[Sheet], title: str) -> bytes:
    """Give sheets as the pages of a PDF.

    Parameters
    ----------
    sheets : iterable of Sheet
        At least one.
    title : str
        Of the document.

    Raises
    ------
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> from assoc_hull.plot.sheet.pages import pdf_of
    >>> from assoc_hull.plot.sheet.sheet import Sheet
    >>> pdf_of([Sheet("A4"), Sheet("A4")], "two pages")[:5]
    b'%PDF-'
    """
    require_matplotlib()
    import matplotlib
    from matplotlib.backends.backend_pdf import PdfPages

    out = io.BytesIO()
    about = {"CreationDate": None, "Title": title}
    with (
        matplotlib.rc_context({"pdf.fonttype": 42, "savefig.bbox": None}),
        PdfPages(out, metadata=about) as pages,
    ):
        for sheet in sheets:
            pages.savefig(sheet.figure)
    return out.getvalue()
