"""The rows of a study: one variant each, made of a hull that was prepared for it.

A row has the values, the outputs, and the reason where there is no hull. It is the same to the
last bit, whichever process makes it: each prepares the hull for itself, from the same tables, and
each variant begins at the parent.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.edit.recording import VariedValues
from assoc_hull.errors import (
    AssocHullError,
    FoldError,
    OutOfRangeError,
    RefusedEditError,
)
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.tables import HullState
from assoc_hull.study.design import StudyDesign
from assoc_hull.study.prepared_parent import StudyParent
from assoc_hull.study.target_search import NotReachedError, QuadraticModel, search_variant
from assoc_hull.variation.parameters.catalogue import CATALOGUE

__all__ = [
    "StudyRow",
    "StudyRun",
    "failure_kind",
    "make_row",
    "make_rows",
]


def failure_kind(error: AssocHullError) -> str:
    """Give the kind of a failure in a word or two, by which failed variants are counted.

    Examples
    --------
    >>> from assoc_hull.errors import RefusedEditError
    >>> from assoc_hull.study.run import failure_kind
    >>> failure_kind(RefusedEditError("x", ("a line folds",)))
    'refused'
    """
    words: tuple[tuple[type[AssocHullError], str], ...] = (
        (FoldError, "map folds"),
        (OutOfRangeError, "out of range"),
        (RefusedEditError, "refused"),
        (NotReachedError, "not reached"),
    )
    return next((word for kind, word in words if isinstance(error, kind)), "no hull")


def _bits(array: FloatArray) -> bytes:
    """Give numbers as they are compared: to the last bit, nan being nan."""
    return array.tobytes()


@attrs.frozen
class StudyRow:
    """What became of a variant; rows are compared to the last bit.

    Attributes
    ----------
    number : int
        Which variant; the first is 0.
    values : (p,)
        Of all parameters: m, degrees, or factors on layers; nan for free ones without a hull.
    outputs : (o,)
        Measured of the variant; nan without a hull.
    margin : float
        The least minor of its map, which is one to one where that is positive; nan without.
    shift : float, m
        The largest movement of a point; nan without a hull.
    residual : float
        The largest residual of a target, in parts of the parent's value; nan without a hull.
    trials : int
        Hulls that were made for it; 0 without one.
    anew : bool
        Whether its lines were cut anew, as in `vary`: the parent's structure would not do.
    failure, reason : str
        What went wrong, in a word and in a line; empty if nothing did.
    """

    number: int
    values: FloatArray = attrs.field(eq=_bits)
    outputs: FloatArray = attrs.field(eq=_bits)
    margin: float = attrs.field(eq=repr)
    shift: float = attrs.field(eq=repr)
    residual: float = attrs.field(eq=repr)
    trials: int
    failure: str = ""
    reason: str = ""
    anew: bool = False

    def __attrs_post_init__(self) -> None:
        freeze(self.values, self.outputs)


@attrs.frozen(eq=False)
class StudyRun:
    """A hull and a design, ready to make any row.

    Attributes
    ----------
    design : StudyDesign
    ground : StudyParent
    model : QuadraticModel or None
        Of the outputs that are aimed at, if there are any.
    """

    design: StudyDesign
    ground: StudyParent
    model: QuadraticModel | None

    @classmethod
    def of(cls, state: HullState, design: StudyDesign) -> StudyRun:
        """Prepare a hull.

        Raises
        ------
        AssocHullError
            It has not what the design changes, or cannot be changed so at all.
        """
        ground = StudyParent.of(state, design)
        return cls(design, ground, QuadraticModel.of(ground) if design.aims else None)

    @property
    def units(self) -> dict[str, str]:
        """Units of all columns of the table that have one."""
        ground = self.ground
        told = dict(zip(ground.outputs.names, ground.outputs.units, strict=True))
        asked = {f"asked {name}": told[name] for name in ground.aims.names}
        return {each.name: each.unit for each in ground.maps.free} | told | asked | {"shift": "m"}

    def varied(self, row: StudyRow) -> VariedValues:
        """Give what a variant was given, to be kept with its step."""
        design, free = self.design, self.ground.maps.free
        pairs = list(zip(free, row.values.tolist(), strict=True))
        held = {
            each.name: value for each, value in pairs
            if each.name in design.given and each.layer is None
            and not CATALOGUE[each.name].amplitude
        }  # fmt: skip
        reached = dict(zip(design.aims, design.targets[row.number].tolist(), strict=True))
        return VariedValues(held, reached, {each.name: v - each.present for each, v in pairs})


def make_row(run: StudyRun, number: int) -> StudyRow:
    """Make one variant, or give the row that says why there is none."""
    design = run.design
    try:
        found = search_variant(run.ground, run.model, design, number)
    except AssocHullError as error:
        values = np.full(len(design.names), np.nan)
        values[: len(design.given)] = design.values[number]
        return StudyRow(
            number, values, np.full(len(design.outputs), np.nan), np.nan, np.nan, np.nan, 0,
            failure_kind(error), " ".join(str(error).split()),
        )  # fmt: skip
    return StudyRow(
        number, found.values, found.outputs,
        found.variant.certificate.least, found.variant.shift, found.residual, found.trials,
        anew=found.variant.anew,
    )  # fmt: skip


def make_rows(run: StudyRun, numbers: Sequence[int]) -> tuple[StudyRow, ...]:
    """Make some variants; every process that makes rows does so by this function.

    What becomes of a variant does not depend on those that are made with it, to the last bit.
    """
    return tuple(make_row(run, number) for number in numbers)
