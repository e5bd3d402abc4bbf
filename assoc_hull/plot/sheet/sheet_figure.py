"""A sheet of paper as a figure: lines and letters placed in millimetres, and how it is saved.

`Sheet` wraps a figure of matplotlib whose one axes are millimetres; each thing drawn has an id.
`save` writes PDF, SVG or PNG by the ending of a name, `pdf_of` several sheets as one PDF. The
same content gives the same bytes each time: no dates, no random ids.
"""

from __future__ import annotations

import io
import os
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import attrs
import numpy as np

from assoc_hull.errors import BadInputError, MissingExtraError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.plot.sheet.paper import POINT, Paper, Pen, paper_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from matplotlib.text import Text

__all__ = [
    "Path_",
    "Sheet",
    "pdf_of",
    "pdf_of_figures",
    "printable",
    "require_matplotlib",
    "save",
]

# --------------------------------------------------------------------------------------
# A sheet of paper: lines and letters placed in millimetres, written the same way each time.
#
# Matplotlib is imported here only when a sheet is made, through its objects: no global state
# of pyplot is read or changed.

_FONT = "DejaVu Sans"  # comes with matplotlib: the same letters on every machine
_FORMATS = {".pdf": {"CreationDate": None}, ".svg": {"Date": None}, ".png": {"Software": None}}

Path_ = str | os.PathLike[str]


def require_matplotlib() -> None:
    """Make sure that pictures can be drawn.

    Raises
    ------
    MissingExtraError
        Matplotlib is not installed.
    """
    try:
        import matplotlib.figure  # noqa: F401
    except ImportError:
        raise MissingExtraError("matplotlib", "plot") from None


class Sheet:
    """One picture.

    Parameters
    ----------
    paper : str or Paper
        The size, or its name.
    height : float, mm, optional
        Instead of the paper's own.

    Attributes
    ----------
    paper : Paper
        Its size.
    figure : matplotlib.figure.Figure
        The picture so far.
    taken : list of (4,)
        Boxes of labels that others must keep clear of, mm.
    """

    def __init__(self, paper: str | Paper, height: float | None = None) -> None:
        require_matplotlib()
        from matplotlib.backends.backend_agg import FigureCanvasAgg

        from assoc_hull.plot.sheet.shown_figure import ShownFigure

        size = paper if isinstance(paper, Paper) else paper_of(paper)
        self.paper = size if height is None else attrs.evolve(size, height=height)
        inches = (self.paper.width / 25.4, self.paper.height / 25.4)
        self.figure: Figure = ShownFigure(figsize=inches, dpi=self.paper.dots, facecolor="white")
        self._renderer = FigureCanvasAgg(self.figure).get_renderer()  # type: ignore[no-untyped-call]
        self.axes = self.figure.add_axes((0.0, 0.0, 1.0, 1.0))
        self.axes.set_xlim(0.0, self.paper.width)
        self.axes.set_ylim(0.0, self.paper.height)
        self.axes.set_axis_off()
        self.taken: list[FloatArray] = []

    def line(self, points: FloatArray, pen: Pen, name: str = "") -> None:
        """Draw a polyline (n, 2), mm; `name` becomes its id."""
        from matplotlib.lines import Line2D

        width = pen.width * self.paper.factor / POINT
        on = tuple(length * self.paper.factor / POINT / width for length in pen.dash)
        self.axes.add_line(
            Line2D(
                points[:, 0], points[:, 1], linewidth=width, color=pen.colour, zorder=pen.over,
                linestyle=(0, on) if on else "-", solid_capstyle="round", solid_joinstyle="round",
                dash_capstyle="butt", antialiased=True, gid=name or None,
            )
        )  # fmt: skip

    def rule(
        self, start: tuple[float, float], end: tuple[float, float], pen: Pen, name: str = ""
    ) -> None:
        """Draw a straight line between two places, mm."""
        self.line(np.array([start, end], np.float64), pen, name)

    def dots(self, points: FloatArray, colour: str, size: float, name: str = "") -> None:
        """Draw round dots at (n, 2), mm; `size` is their diameter, mm."""
        from matplotlib.lines import Line2D

        across = size * self.paper.factor / POINT
        self.axes.add_line(
            Line2D(
                points[:, 0], points[:, 1], linestyle="", marker="o", markersize=across,
                markerfacecolor=colour, markeredgewidth=0.0, zorder=4.0, gid=name or None,
            )
        )  # fmt: skip

    def arrow(
        self,
        start: tuple[float, float],
        end: tuple[float, float],
        pen: Pen,
        name: str = "",
        *,
        both: bool = False,
    ) -> None:
        """Draw an arrow between two places, mm; `both`: with a head at either end."""
        from matplotlib.patches import FancyArrowPatch

        patch = FancyArrowPatch(
            start, end, arrowstyle="<|-|>" if both else "-|>", color=pen.colour,
            shrinkA=0.0, shrinkB=0.0,
            linewidth=pen.width * self.paper.factor / POINT, mutation_scale=self.paper.letter,
            zorder=pen.over, gid=name or None,
        )  # fmt: skip
        self.axes.add_patch(patch)

    def text(
        self,
        place: tuple[float, float],
        words: str,
        *,
        size: float = 1.0,
        across: Literal["left", "center", "right"] = "center",
        up: Literal["center", "top", "bottom", "baseline"] = "center",
        angle: float = 0.0,
        colour: str = "black",
        bold: bool = False,
        halo: bool = False,
        name: str = "label",
    ) -> Text:
        """Write words.

        Parameters
        ----------
        place : (float, float), mm
            Where.
        words : str
            What.
        size : float
            In label letters.
        across, up
            Which part of the words lies at the place.
        angle : float, degrees
            Anticlockwise.
        colour : str
            Of the letters.
        bold : bool
            Whether they are bold.
        halo : bool
            Whether a rim of paper white parts them from what lies under them.
        name : str
            Becomes the id.
        """
        from matplotlib.patheffects import withStroke

        rim = withStroke(linewidth=0.45 * self.paper.letter, foreground="white")
        return self.axes.text(
            *place, printable(words), fontsize=size * self.paper.letter, ha=across, va=up,
            rotation=angle,
            rotation_mode="anchor" if angle and across != "center" else "default", color=colour,
            fontweight="bold" if bold else "normal", fontfamily=_FONT, gid=name, zorder=5.0,
            path_effects=[rim] if halo else None, parse_math=False,
        )  # fmt: skip

    def box(self, text: Text) -> FloatArray:
        """Give the box around words that were written: left, bottom, right, top, mm."""
        extent = text.get_window_extent(self._renderer)
        corners = np.array([extent.x0, extent.y0, extent.x1, extent.y1])
        return corners * (25.4 / self.paper.dots)

    def width(self, words: str, *, size: float = 1.0, bold: bool = False) -> float:
        """Give how wide words are on paper, mm; the dots of a screen may ask for a little more."""
        from matplotlib.font_manager import FontProperties
        from matplotlib.textpath import text_to_path

        font = FontProperties(
            family=_FONT, weight="bold" if bold else "normal", size=size * self.paper.letter
        )
        wide, _, _ = text_to_path.get_text_width_height_descent(
            printable(words), font, ismath=False
        )
        return float(wide) * POINT

    def take(self, text: Text) -> None:
        """Keep later labels clear of these words."""
        self.taken.append(self.box(text))


@cache
def _glyphs() -> frozenset[int]:
    """Give the characters that the font of sheets has."""
    from matplotlib.font_manager import FontProperties, findfont, get_font

    return frozenset(get_font(findfont(FontProperties(family=_FONT))).get_charmap())


def printable(words: str) -> str:
    """Put a blank square in the place of each character that the font of sheets lacks.

    Names may be written in any script; the font is the same on every machine, and no other is
    looked for.

    Examples
    --------
    >>> from assoc_hull.plot.sheet.sheet_figure import printable
    >>> printable("Größe 船")
    'Größe □'
    """
    if words.isascii():
        return words
    known = _glyphs()
    return "".join(each if ord(each) in known or each == "\n" else "□" for each in words)


def save(figure: Figure, path: Path_) -> None:
    """Write a picture as PDF, SVG or PNG, told by the ending; the same bytes each time.

    Raises
    ------
    BadInputError
        Another ending, or a place that cannot be written to.
    """
    import matplotlib

    suffix = Path(path).suffix.lower()
    if suffix not in _FORMATS:
        raise BadInputError(
            f"the ending {suffix!r} was asked", f"for {path}", f"use one of {', '.join(_FORMATS)}"
        )
    fixed: dict[Any, Any] = {
        "svg.hashsalt": "assoc-hull", "svg.fonttype": "path", "pdf.fonttype": 42,
        "savefig.bbox": None, "savefig.dpi": "figure",
    }  # fmt: skip
    more: dict[str, Any] = {"pil_kwargs": {"compress_level": 3}} if suffix == ".png" else {}
    with matplotlib.rc_context(fixed):
        try:
            figure.savefig(os.fspath(path), format=suffix[1:], metadata=_FORMATS[suffix], **more)
        except OSError as trouble:
            why = trouble.strerror or trouble
            raise BadInputError(
                f"the file cannot be written ({why})", f"at {path}", "name another place"
            ) from None


# --------------------------------------------------------------------------------------
# Several sheets as one PDF: the same bytes each time.


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
    >>> from assoc_hull.plot.sheet.sheet_figure import pdf_of
    >>> from assoc_hull.plot.sheet.sheet_figure import Sheet
    >>> pdf_of([Sheet("A4"), Sheet("A4")], "two pages")[:5]
    b'%PDF-'
    """
    return pdf_of_figures((sheet.figure for sheet in sheets), title)


def pdf_of_figures(figures: Iterable[Figure], title: str, date: str | None = None) -> bytes:
    """Give figures as the pages of a PDF; see `pdf_of`. Its date is kept as a subject, in words."""
    require_matplotlib()
    import matplotlib
    from matplotlib.backends.backend_pdf import PdfPages

    out = io.BytesIO()
    about = {"CreationDate": None, "Title": title} | ({} if date is None else {"Subject": date})
    with (
        matplotlib.rc_context({"pdf.fonttype": 42, "savefig.bbox": None}),
        PdfPages(out, metadata=about) as pages,
    ):
        for figure in figures:
            pages.savefig(figure)
    return out.getvalue()
