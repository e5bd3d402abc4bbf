"""The page in a notebook: `widget` shows a hull below a cell, where it is faired by hand.

The cell's hull is the one that is edited: what a hand does in the widget is a step of its history,
and what a cell does is seen in the widget. Widgets of one hull share its session, as two windows
of the page do.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from assoc_hull.arguments import instance, integer, text
from assoc_hull.errors import MissingExtraError
from assoc_hull.hull.hull import Hull
from assoc_hull.page.server import user_name

if TYPE_CHECKING:
    from assoc_hull.page.notebook_widget import HullWidget

__all__ = ["widget"]


def widget(hull: Hull, *, height: int = 720, author: str | None = None) -> HullWidget:
    """Show a hull in a notebook, and edit it there by hand.

    Views, tools and keys are those of the fairing page. Each drag is an edit of this hull; edits in
    cells are shown. A saved notebook keeps the three views as a picture, without a kernel.

    Parameters
    ----------
    hull : Hull
        The hull.
    height : int
        Of the widget, pixels of the browser, from 200 to 5,000.
    author : str or None
        Who signs the edits made in it; the name of the user if None.

    Returns
    -------
    HullWidget
        What a notebook shows at the end of a cell. `selection` is the point that is chosen in it;
        `close` ends it.

    Raises
    ------
    MissingExtraError
        The extra `jupyter` is not installed.
    BadInputError, WrongTypeError
        No hull, no such height, no name.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> shown = ah.widget(ah.examples.wigley(), height=500)  # doctest: +SKIP
    """
    instance(hull, Hull, "hull", "in widget")
    integer(height, "height", "in widget", least=200, most=5000)
    name = user_name() if author is None else text(author, "author", "in widget")
    try:
        from assoc_hull.page.notebook_widget import HullWidget as Made
    except ImportError as error:
        raise MissingExtraError(error.name or "anywidget", "jupyter") from None
    return Made(hull, height=height, author=name)
