"""All entries of the catalogue of form parameters.

Entries stand in modules by subject; whatever entry such a module holds is taken. An entry of
one's own is handed to `form_parameters` and needs no change anywhere.
"""

from __future__ import annotations

from assoc_hull.analysis.form.entries import (
    after_section,
    bow,
    floating,
    fore_section,
    midship,
    particulars,
    proportions,
    resistance,
    skeg,
    stern,
    volume_coefficients,
    waterline,
    waterplane_coefficients,
)
from assoc_hull.analysis.form.entries import (
    ship_parts as parts,
)
from assoc_hull.analysis.form.evaluate import check_catalogue
from assoc_hull.model.named_mapping import Named

__all__ = ["CATALOGUE"]

_MODULES = (
    particulars,
    floating,
    volume_coefficients,
    waterplane_coefficients,
    proportions,
    resistance,
    parts,
    waterline,
    bow,
    midship,
    stern,
    fore_section,
    after_section,
    skeg,
)

CATALOGUE = Named(
    "form parameter", check_catalogue(each for module in _MODULES for each in module.PARAMETERS)
)
"""The catalogue, by symbol."""
