"""What a solver may change: a named parameter, or how much there is of a layer of raw fields."""

from __future__ import annotations

import attrs

from assoc_hull.errors import BadInputError
from assoc_hull.variation.fields.additive import AdditiveLayer, Factors
from assoc_hull.variation.fields.corner import CornerLayer
from assoc_hull.variation.fields.fields_layer import FieldLayer
from assoc_hull.variation.fields.layer import Layer
from assoc_hull.variation.fields.shear import DeadriseLayer
from assoc_hull.variation.parameters.catalogue import CATALOGUE

__all__ = ["Freedom", "scaled_layer"]

_SHIFT, _SIZE, _ANGLE = 0.01, 0.05, 2.0
"""Usual changes: of shifts in parts of Lpp, of lengths in parts of themselves, of angles."""


@attrs.frozen(eq=False)
class Freedom:
    """A free parameter.

    Attributes
    ----------
    name : str
    unit : str
        Of the amplitude: m, deg, or nothing for a layer.
    present : float
        The value of amplitude nil; 0 for shifts and layers.
    usual : float
        A usual change, by which amplitudes are compared.
    layer : Layer or None
        What is scaled by the amplitude; None for a named parameter.
    """

    name: str
    unit: str
    present: float
    usual: float
    layer: Layer | None = None

    @classmethod
    def named(cls, name: str, present: float, length: float) -> Freedom:
        """Take a parameter of the catalogue, with its present value and Lpp, m."""
        entry = CATALOGUE[name]
        usual = _SHIFT * length if entry.amplitude else _SIZE * abs(present)
        if entry.unit == "deg" or usual == 0.0:
            usual = _ANGLE if entry.unit == "deg" else 1.0
        return cls(name, entry.unit, present, usual)

    @classmethod
    def raw(cls, layer: Layer) -> Freedom:
        """Take a layer: at amplitude 1 it acts as it was given."""
        return cls(layer.name, "", 0.0, 1.0, layer)

    def scaled(self, amplitude: float) -> Layer | None:
        """Give the layer times the amplitude; None for nothing."""
        if self.layer is None or amplitude == 0.0:
            return None
        return scaled_layer(self.layer, amplitude)


def scaled_layer(layer: Layer, factor: float) -> Layer:
    """Give a layer with its displacement times a factor.

    Raises
    ------
    BadInputError
        A layer of no known kind.

    Examples
    --------
    >>> from assoc_hull.variation.parameters.freedom import scaled_layer
    >>> from assoc_hull.variation.fields.additive import AdditiveLayer
    >>> from assoc_hull.variation.fields.piecewise_linear import Chain
    >>> longer = AdditiveLayer("longer", x=Chain.through([0.0, 100.0], [0.0, 1.0]))
    >>> scaled_layer(longer, 2.5).x.v.tolist()
    [0.0, 2.5]
    """
    if isinstance(layer, FieldLayer):
        return attrs.evolve(layer, fields=tuple(each.scaled(factor) for each in layer.fields))
    if isinstance(layer, AdditiveLayer):
        x = None if layer.x is None else layer.x.scaled(factor)
        return attrs.evolve(layer, x=x, y=_scaled(layer.y, factor), z=_scaled(layer.z, factor))
    if isinstance(layer, CornerLayer):
        eta, zeta = ((ratio - 1.0) * factor for ratio in (layer.eta_ratio, layer.zeta_ratio))
        return attrs.evolve(layer, eta_ratio=1.0 + eta, zeta_ratio=1.0 + zeta)
    if isinstance(layer, DeadriseLayer):
        return attrs.evolve(layer, q=layer.q * factor)
    raise BadInputError(
        f"'{layer.name}' is a {type(layer).__name__}", "in vary", "free a layer of a known kind"
    )


def _scaled(factors: Factors | None, factor: float) -> Factors | None:
    return None if factors is None else (factors[0].scaled(factor), factors[1], factors[2])
