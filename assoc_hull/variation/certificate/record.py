"""What a fold check found, as a record."""

from __future__ import annotations

from typing import Literal

import attrs

from assoc_hull.errors import FoldError

__all__ = ["Certificate", "Reason"]

Reason = Literal["certified", "folds", "thin", "undecided"]


@attrs.frozen
class Certificate:
    """Whether a layer, or a map, keeps space the right way round in a box.

    Attributes
    ----------
    reason : {"certified", "folds", "thin", "undecided"}
        ``"folds"``: a minor of the Jacobian is nil or negative at the witness. ``"thin"``: all
        are positive as far as was searched, but one is below the margin. ``"undecided"``: the
        bounds did not become sharp enough; such a layer is refused as well.
    least : float
        The least minor met.
    minor : str
        Which: ``"X_x"``, ``"Y_y"``, ``"Z_z"``, or ``"D"``, the determinant of two of them.
    witness : (float, float, float), m
        Where it was met.
    bound : float
        No minor is below it, if certified.
    margin : float
        What every minor must reach.
    boxes, splits : int
        How many boxes were looked at, and how many of them halved.
    layer, field : str
        The layer, and the field of it that makes the minor small; empty if there is none.
    between : tuple of (str, float)
        Names and heights (m) of the field's boundary curves next below and above the witness.
    node : float or None, m
        The node nearest to the witness along the ship.
    minors : tuple of (str, float)
        The least value met of every minor that is not 1 by itself.
    """

    reason: Reason
    least: float
    minor: str
    witness: tuple[float, float, float]
    bound: float
    margin: float
    boxes: int = 0
    splits: int = 0
    layer: str = ""
    field: str = ""
    between: tuple[tuple[str, float], ...] = ()
    node: float | None = None
    minors: tuple[tuple[str, float], ...] = ()

    @property
    def certified(self) -> bool:
        """Whether all minors reach the margin everywhere in the box."""
        return self.reason == "certified"

    def check(self) -> None:
        """Refuse what is not certified.

        Raises
        ------
        FoldError
            With the numbers.
        """
        if not self.certified:
            raise FoldError(
                self.reason, self.minor, self.least, self.margin, self.witness, self.layer,
                self.field, self.between, self.node,
            )  # fmt: skip
