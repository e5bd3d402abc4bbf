"""From asked values to a map: layers in their order, local fields solved for together.

Dimensions of the whole hull come first, all else is laid out on the hull so scaled. Local
fields add; as one may act at the anchor of another, their sizes are solved for, so that all
targets are met together. The rake of the stem, bilge and bottom follow as layers of their own.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.variation.fields.field import StackedField
from assoc_hull.variation.fields.layers import FieldLayer, Layer, Rake
from assoc_hull.variation.fields.space_map import VariationMap
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.field_layout import Layout, Share
from assoc_hull.variation.parameters.parameter_fields import body_length_field_beside, main_layer
from assoc_hull.variation.parameters.parent import Parent

__all__ = ["STEEPEST", "compose_map", "conflicts", "refuse_clashes", "solve_field_sizes"]

_CONDITION = 50.0
"""Above this, two parameters ask for the movement of one place."""

_LARGEST = 3.0
"""Fields larger than this many times what is asked work against one another."""

STEEPEST = 80.0
"""Degrees; beyond, a small change of an angle moves a place by metres."""

_RAKE = ("stem_rake_deg",)
"""An angle between two places that other fields move: laid out where they have come to."""

_BILGE = ("bilge_radius", "flat_of_bottom", "deadrise_deg")
_CLASHES = (
    ("bilge_radius", "flat_of_bottom", "a bilge of one radius ends where the flat bottom does"),
    ("bilge_radius", "deadrise_deg", "both turn the bilge"),
    ("flat_of_bottom", "deadrise_deg", "a bottom with deadrise is not flat"),
    ("bulb_area", "bulb_half_breadth", "both widen the section at FP"),
)
_LENGTH = "parallel_body_length"
_BODY = ("parallel_body_start", "parallel_body_end", _LENGTH)
_DECKS = ("depth", "deck_height", "both set the deck edge amidships")
"""No contradiction where the height is asked for at a perpendicular."""


def compose_map(parent: Parent, asked: Mapping[str, float], layout: Layout) -> VariationMap:
    """Lay out the map of a variation.

    Parameters
    ----------
    parent : Parent
        The hull as it is.
    asked : mapping of str to float
        Named parameters with the values they are to have; m or degrees.
    layout : Layout
        How far their fields reach.

    Raises
    ------
    BadInputError
        Two parameters contradict each other; the parent has not what one is measured at; a
        value has no meaning.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.variation.parameters.compose_map import compose_map
    >>> from assoc_hull.variation.parameters.field_layout import Layout
    >>> from assoc_hull.variation.parameters.parent import Parent
    >>> ship = Parent(300, 50, 27, 18, 27, {"boss": np.array([6.0, 0.0, 5.0])})
    >>> vmap = compose_map(ship, {"shaft_height": 6.0, "breadth": 51.0}, Layout())
    >>> vmap(np.array([[6.0, 5.0, 5.0]])).round(12).tolist()
    [[6.0, 5.1, 6.0]]
    """
    refuse_clashes(asked, layout)
    _refuse_angles(asked)
    layers = list[Layer]()
    main = main_layer(parent, asked, layout)
    if main is not None:
        layers.append(main)
        if any(CATALOGUE[name].lays is not None for name in asked):
            parent = _scaled(parent, main, asked)
    local = [name for name in CATALOGUE if name not in (*_RAKE, *_BILGE)]
    for title, names in (("local fields", local), ("rake", _RAKE)):
        shares = _shares(parent, {name: asked[name] for name in names if name in asked}, layout)
        if shares:
            layer = FieldLayer(title, solve_field_sizes(shares))
            layers.append(layer)
            parent = parent.mapped(VariationMap((layer,)))
    for name in _BILGE:
        lays = CATALOGUE[name].lays
        if name in asked and lays is not None:
            own = lays(parent, asked[name], layout)
            if not isinstance(own, Share):
                layers.append(own)
    return VariationMap(tuple(layers))


def _shares(parent: Parent, asked: Mapping[str, float], layout: Layout) -> list[Share]:
    """Give what parameters put into a layer of fields; nothing where a value is as it was."""
    found = list[Share]()
    for name in asked:
        share = _laid_out(parent, name, asked, layout)
        if isinstance(share, Share) and share.change != 0.0:
            found.append(share)
    return found


def _laid_out(
    parent: Parent, name: str, asked: Mapping[str, float], layout: Layout
) -> Share | Layer | None:
    """Lay out one parameter beside the others that are asked for."""
    if name == _LENGTH and len(asked.keys() & _BODY) > 1:
        return body_length_field_beside(parent, asked, layout)
    lays = CATALOGUE[name].lays
    return None if lays is None else lays(parent, asked[name], layout)


def _scaled(parent: Parent, main: FieldLayer, asked: Mapping[str, float]) -> Parent:
    """Give the parent after the scaling of the whole, with what was asked for exactly."""
    sizes = {name: asked[name] for name in ("length", "breadth", "draught") if name in asked}
    depth = float(VariationMap((main,))(np.array([[0.0, 0.0, parent.depth]]))[0, 2])
    return parent.mapped(VariationMap((main,)), depth=depth, **sizes)


def _refuse_angles(asked: Mapping[str, float]) -> None:
    for name, value in asked.items():
        if name.endswith("_deg") and not abs(value) <= STEEPEST:
            raise BadInputError(
                f"{name} is {value:g} degrees", "in vary", f"give at most {STEEPEST:g} either way"
            )


def conflicts(name: str, layout: Layout | None = None) -> tuple[str, ...]:
    """Give the parameters that cannot be asked for beside one.

    Examples
    --------
    >>> from assoc_hull.variation.parameters.compose_map import conflicts
    >>> conflicts("bilge_radius")
    ('flat_of_bottom', 'deadrise_deg')
    """
    pairs = [(one, other) for one, other, _ in _clashes(layout or Layout())]
    return tuple(other if one == name else one for one, other in pairs if name in (one, other))


def _clashes(layout: Layout) -> tuple[tuple[str, str, str], ...]:
    """Give pairs of parameters that are one number, and why."""
    return (*_CLASHES, _DECKS) if layout.deck == "midship" else _CLASHES


def refuse_clashes(asked: Mapping[str, float], layout: Layout) -> None:
    """Refuse parameters that are one number.

    Raises
    ------
    BadInputError
        Both named, and why.
    """
    for one, other, why in _clashes(layout):
        if one in asked and other in asked:
            raise BadInputError(
                f"'{one}' and '{other}' cannot be asked for together: {why}", "in vary",
                "drop one of them",
            )  # fmt: skip
    if {*_BODY} <= asked.keys():
        raise BadInputError(
            f"'{_BODY[0]}', '{_BODY[1]}' and '{_BODY[2]}' cannot be asked for together: two of "
            "them give the third", "in vary", "drop one of them",
        )  # fmt: skip


def solve_field_sizes(shares: Sequence[Share]) -> tuple[StackedField | Rake, ...]:
    """Size fields so that every share's anchor changes by what it asks, all acting together.

    Raises
    ------
    BadInputError
        Two shares ask different changes of what is the same place.
    """
    effect = np.array([[each.effect(anchor) for each in shares] for anchor in shares])
    change = np.array([share.change for share in shares])
    unit = effect / change[None, :]
    size = np.linalg.solve(unit, change) if _sound(unit) else np.full(len(shares), np.inf)
    if not np.abs(size).max() <= _LARGEST * np.abs(change).max():
        raise _clash(shares, unit, change)
    whole = unit == np.eye(len(shares))
    factor = np.where(whole.all(axis=1), 1.0, size / change)
    return tuple(
        field
        for share, part in zip(shares, factor.tolist(), strict=True)
        for field in share.scaled(part).fields
    )


def _sound(unit: np.typing.NDArray[np.float64]) -> bool:
    return bool(np.isfinite(unit).all()) and float(np.linalg.cond(unit)) <= _CONDITION


def _clash(
    shares: Sequence[Share], unit: np.typing.NDArray[np.float64],
    change: np.typing.NDArray[np.float64],
) -> BadInputError:  # fmt: skip
    """Name the two parameters that act most alike."""
    if len(shares) < 2:
        part = shares[0].effect(shares[0]) / shares[0].change
        if part:
            return BadInputError(
                f"the field of '{shares[0].name}' gives {100.0 * part:.3g} % of the change where "
                "that is measured", "in vary", "let it be full nearer to there",
            )  # fmt: skip
        return BadInputError(
            f"'{shares[0].name}' cannot use a ratio: its anchor equals its pivot", "in vary",
            "use a shift",
        )  # fmt: skip
    length = np.sqrt((unit * unit).sum(axis=0))
    alike = np.abs(unit.T @ unit) / (length[:, None] * length[None, :]) - 2.0 * np.eye(len(shares))
    i, j = sorted(divmod(int(alike.argmax()), len(shares)))
    return BadInputError(
        f"'{shares[i].name}' and '{shares[j].name}' ask different changes of the same place "
        f"(condition {np.linalg.cond(unit):.3g}, {change[i]:.3f} and {change[j]:.3f} m)",
        "in vary", "drop one of them, or let their fields reach less far",
    )  # fmt: skip
