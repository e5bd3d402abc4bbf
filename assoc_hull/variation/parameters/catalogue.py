"""The catalogue of named parameters, and what a solver may change of them.

An entry has name, unit, meaning, and the function that lays out its fields. `Freedom` is a
parameter of the catalogue, or the strength of a raw layer, whose value is sought; it has a usual
change, by which changes of different kinds are compared.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.fields.layers import Layer, scaled_layer
from assoc_hull.variation.parameters import bulb_fields, parameter_fields
from assoc_hull.variation.parameters.field_layout import Layout, Share
from assoc_hull.variation.parameters.parent import Parent

__all__ = [
    "CATALOGUE",
    "NAMES",
    "Freedom",
    "NamedParameter",
]

_SIGNED = frozenset(
    {
        "deadrise_deg",
        "stem_rake_deg",
        "parallel_body_start",
        "parallel_body_end",
        "transom_height",
        "sheer_fore",
        "sheer_aft",
    }
)
"""Parameters that may be zero or negative."""

_Lays = Callable[[Parent, float, Layout], Share | Layer]


@attrs.frozen
class NamedParameter:
    """A parameter of a hull that a designer can ask for by name.

    Attributes
    ----------
    name, short : str
        In full, and as a formula has it.
    unit : {"m", "m2", "deg", "-"}
    meaning : str
        What is measured; x from AP, z from the base line.
    lays : callable or None
        Gives its share in the layer of local fields, or its own layer; None if it scales the
        hull as a whole.
    field : str
        What its field is, in words.
    """

    name: str
    short: str
    unit: str
    meaning: str
    lays: _Lays | None
    field: str

    @property
    def positive(self) -> bool:
        """Whether only values above 0 have a meaning."""
        return not (self.amplitude or self.name in _SIGNED)

    @property
    def amplitude(self) -> bool:
        """Whether it is a movement, present value 0, and no measure of the hull."""
        return self.name.endswith("_shift")


def _entries() -> tuple[NamedParameter, ...]:
    entry = NamedParameter
    return (
        entry(
            "length",
            "Lpp",
            "m",
            "length between perpendiculars",
            None,
            "ratio of x about the AP, everywhere",
        ),
        entry("breadth", "B", "m", "breadth of the ship", None, "ratio of y, everywhere"),
        entry("draught", "T", "m", "design draught", None, "ratio of z up to T, shift at its top"),
        entry(
            "depth",
            "D",
            "m",
            "height of the deck edge amidships",
            parameter_fields.depth_field,
            "ratio of z from the deck up, nothing below T",
        ),
        entry(
            "deck_height",
            "z_deck",
            "m",
            "height of the deck edge amidships",
            parameter_fields.deck_height_field,
            "ratio of z from the deck up, nothing below T",
        ),
        entry(
            "sheer_fore",
            "s_f",
            "m",
            "height of the deck edge at FP above that amidships",
            parameter_fields.sheer_fore_field,
            "ratio of z from the deck up, from amidships to FP, nothing below T",
        ),
        entry(
            "sheer_aft",
            "s_a",
            "m",
            "height of the deck edge at AP above that amidships",
            parameter_fields.sheer_aft_field,
            "ratio of z from the deck up, from amidships to AP, nothing below T",
        ),
        entry(
            "shaft_height",
            "h",
            "m",
            "height of the centre of the bossing end",
            parameter_fields.shaft_height_field,
            "dome of z over base, shaft and 1.25 T",
        ),
        entry(
            "bossing_radius",
            "r_b",
            "m",
            "radius of the circle of the bossing end",
            parameter_fields.bossing_radius_field,
            "ratio of y in a tube, of z about the centre",
        ),
        entry(
            "transom_height",
            "z_t",
            "m",
            "lowest point of the transom",
            parameter_fields.transom_height_field,
            "hat of z; what lies above moves along",
        ),
        entry(
            "transom_half_breadth",
            "y_t",
            "m",
            "greatest half-breadth of the transom",
            parameter_fields.transom_half_breadth_field,
            "ratio of y from the transom's foot up",
        ),
        entry(
            "bulb_height",
            "z_b",
            "m",
            "height of the foremost point of the bulb",
            parameter_fields.bulb_height_field,
            "hat of z over base, tip and 1.25 T",
        ),
        entry(
            "bulb_half_breadth",
            "y_b",
            "m",
            "greatest half-breadth at the FP below T",
            parameter_fields.bulb_half_breadth_field,
            "ratio of y from the tip down",
        ),
        entry(
            "bulb_area",
            "A_BT",
            "m2",
            "area of the section at FP below T, both sides",
            bulb_fields.bulb_area_field,
            "ratio of y from the tip down",
        ),
        entry(
            "bulb_section_height",
            "h_B",
            "m",
            "height of the centre of area of the section at FP below T",
            bulb_fields.bulb_section_height_field,
            "ratios of y below and above, the area at FP kept",
        ),
        entry(
            "bulb_length",
            "l_b",
            "m",
            "from the FP to the foremost point of the bulb",
            parameter_fields.bulb_length_field,
            "shift of x, full from the tip down, nothing above 1.25 T",
        ),
        entry(
            "bilge_radius",
            "r",
            "m",
            "radius of the bilge amidships",
            parameter_fields.bilge_radius_layer,
            "stretch about the corner of side and bottom",
        ),
        entry(
            "deadrise_deg",
            "beta",
            "deg",
            "rise of the bottom at the side of the keel",
            parameter_fields.deadrise_layer,
            "shear of z outward from the keel",
        ),
        entry(
            "flat_of_bottom",
            "y_f",
            "m",
            "half-breadth of the flat bottom amidships",
            parameter_fields.flat_of_bottom_layer,
            "stretch about the corner of side and bottom; of y alone where the bilge is no arc",
        ),
        entry(
            "parallel_body_start",
            "x_s",
            "m",
            "x of the after end of the parallel body",
            parameter_fields.parallel_body_start_field,
            "shift of x, nothing at AP and at the fore end",
        ),
        entry(
            "parallel_body_end",
            "x_e",
            "m",
            "x of the fore end of the parallel body",
            parameter_fields.parallel_body_end_field,
            "shift of x, nothing at the after end and at FP",
        ),
        entry(
            "parallel_body_length",
            "l_p",
            "m",
            "length of the parallel body",
            parameter_fields.parallel_body_length_field,
            "shift of x, half of it at each end, nothing at AP and FP",
        ),
        entry(
            "stem_rake_deg",
            "rake",
            "deg",
            "rake of the stem from T to its top",
            parameter_fields.stem_rake_field,
            "ramp of x above T",
        ),
        entry(
            "fore_frame_height",
            "z_f",
            "m",
            "height of the centre of area of the section at .925 Lpp up to T: low of U, high of V",
            bulb_fields.fore_frame_height_field,
            "ratios of y below and above, each area kept, from the parallel body to FP",
        ),
        entry(
            "aft_frame_height",
            "z_a",
            "m",
            "height of the centre of area of the section at .1 Lpp up to T: low of U, high of V",
            bulb_fields.aft_frame_height_field,
            "ratios of y below and above, each area kept, from AP to the parallel body",
        ),
        entry(
            "entrance_deg",
            "i_E",
            "deg",
            "half angle of entrance, by the chord of the design waterline over its first .05 Lpp",
            bulb_fields.entrance_field,
            "ratio of y about T, toward the stem",
        ),
        entry(
            "run_deg",
            "i_R",
            "deg",
            "half angle of run, by the chord of the design waterline over its last .05 Lpp",
            bulb_fields.run_field,
            "ratio of y about T, nothing at the after end of the waterline",
        ),
        entry(
            "waterline_fullness",
            "C_WL",
            "-",
            "area of the design waterline by Lpp and breadth",
            bulb_fields.waterline_fullness_field,
            "ratio of y about T, nothing at the ends and along the parallel body",
        ),
        entry(
            "fore_shift",
            "c_f",
            "m",
            "largest movement of the fore stations, + forward",
            parameter_fields.fore_shift_field,
            "bump of x between parallel body and rising profile",
        ),
        entry(
            "aft_shift",
            "c_a",
            "m",
            "largest movement of the after stations, + forward",
            parameter_fields.aft_shift_field,
            "bump of x between rising profile and parallel body",
        ),
    )


CATALOGUE = {each.name: each for each in _entries()}
"""All named parameters, in the order in which they are listed."""

NAMES = tuple(CATALOGUE)


_GOLDEN = 0.6180339887
"""Its multiples leave parts that are nowhere alike."""

_SHIFT, _SIZE, _ANGLE = 0.01, 0.05, 2.0
"""Usual changes: of shifts in parts of Lpp, of lengths in parts of themselves, of angles in deg."""


@attrs.frozen(eq=False)
class Freedom:
    """A free parameter.

    Attributes
    ----------
    name : str
    unit : str
        Of the amplitude: m, deg, or nothing for a layer.
    present : float
        The value of amplitude zero; 0 for shifts and layers.
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

    @staticmethod
    def probe(free: Sequence[Freedom]) -> FloatArray:
        """Give changes (k,) that show what all parameters together move, near the usual ones.

        Never all in one proportion: breadth and draught that grow alike keep circles round, which
        no other change of them does.
        """
        part = np.modf(_GOLDEN * np.arange(1, 1 + len(free)))[0]
        found: FloatArray = np.array([each.usual for each in free]) * (1.0 - 0.5 * part)
        return found

    def scaled(self, amplitude: float) -> Layer | None:
        """Give the layer times the amplitude; None for nothing."""
        if self.layer is None or amplitude == 0.0:
            return None
        return scaled_layer(self.layer, amplitude)
