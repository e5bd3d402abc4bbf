"""The fields of named parameters on the bulk carrier."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.plot.lines_plan.variation_fields import variation_fields as field_plan
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.field import AffinePiece, StackedField, level_boundaries
from assoc_hull.variation.fields.layers import FieldLayer
from assoc_hull.variation.parameters.compose_map import compose_map
from assoc_hull.variation.parameters.field_layout import Layout
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.parameters.parent import parent_of
from drawings.common import DRIVEN, FAINT, INK, PALE, SHARED

__all__ = ["rounded_hat", "variation_fields"]

_MORE = {
    "shaft_height": 1.0,
    "transom_half_breadth": 0.6,
    "bulb_height": 0.5,
    "bulb_half_breadth": 0.46,
    "bulb_length": 1.0,
    "stem_rake_deg": 3.5,
}


def variation_fields() -> Figure:
    """Draw the fields that six named parameters lay out together."""
    hull = ah.examples.bulk_carrier_207k()
    found = measure_all(hull.state)
    asked = {name: found[name] + more for name, more in _MORE.items()}
    layers = compose_map(parent_of(hull.state, found), asked, Layout()).layers
    fields = [field for each in layers if isinstance(each, FieldLayer) for field in each.fields]
    return field_plan(hull, FieldLayer("all", tuple(fields)), paper="A4")


def rounded_hat() -> Figure:
    """Draw three ways to raise the carrier's shaft by a metre: what moves, and how it stretches."""
    hull = ah.examples.bulk_carrier_207k()
    found = measure_all(hull.state)
    h, r, top = found["shaft_height"], found["bossing_radius"], found["draught"]
    (hat,) = compose_map(parent_of(hull.state, found), {"shaft_height": h + 1.0}, Layout()).layers
    heights, names = [0.0, h - r, h + r, top], ["base", "shaft-r", "shaft+r", "T"]
    always = BlendChain.constant(1.0)
    ways = {
        "ratios, as in the paper": _pieces("a", [0.0, 1.0 / (h - r), 1.0 / (h + r), 0.0], always),
        "shifts from anchor to anchor": _pieces("d", [0.0, 1.0, 1.0, 0.0], always),
    }
    z = np.linspace(-2.0, 30.0, 1601)
    places = np.column_stack([np.full_like(z, 6.0), np.zeros_like(z), z])
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.4, 4.6), sharey=True,
                                         layout="constrained")  # fmt: skip
    stack = level_boundaries(names, heights)
    layers = {name: FieldLayer("local", (StackedField("shaft", "z", stack, pieces),))
              for name, pieces in ways.items()}  # fmt: skip
    assert isinstance(hat, FieldLayer)
    for (name, layer), colour in zip(
        [*layers.items(), ("rounded hat, the usual one", hat)], (PALE, DRIVEN, SHARED), strict=True
    ):
        left.plot(layer.displacement(places)[:, 2], z, color=colour, linewidth=1.8, label=name)
        right.plot(layer.jacobian(places)[:, 2, 2], z, color=colour, linewidth=1.8)
    for axes, title in ((left, "moves upward, m"), (right, "is stretched in height, times")):
        for name, height in zip(["base line", "", "", "T"], heights, strict=True):
            axes.axhline(height, color=FAINT, linewidth=0.8, zorder=0)
            axes.annotate(name, (1.0, height), xycoords=("axes fraction", "data"), ha="right",
                          va="bottom", fontsize=8, color=INK)  # fmt: skip
        axes.axhspan(h - r, h + r, color=FAINT, alpha=0.6, zorder=0)
        axes.set_xlabel(title)
    left.annotate("bossing", (0.02, h), xycoords=("axes fraction", "data"), va="center",
                  fontsize=8, color=INK)  # fmt: skip
    left.set_ylabel("z, m")
    figure.legend(loc="outside upper center", frameon=False, fontsize=9, ncols=3)
    return figure


def _pieces(kind: str, values: list[float], always: BlendChain) -> tuple[AffinePiece, ...]:
    """Give pieces with these ratios less one (a), or these shifts (d)."""
    return tuple(
        AffinePiece.along(always, *((value, 0.0) if kind == "a" else (0.0, value)))
        for value in values
    )
