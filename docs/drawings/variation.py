"""The fields of named parameters on the bulk carrier."""

from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.plot.variation import field_plan
from assoc_hull.variation.anchors import measure_all
from assoc_hull.variation.compose import compose
from assoc_hull.variation.fields_layer import FieldLayer
from assoc_hull.variation.layout import Layout
from assoc_hull.variation.parent_of import parent_of

__all__ = ["variation_fields"]

_MORE = {
    "shaft_height": 1.0,
    "transom_half_breadth": 0.6,
    "bulb_height": 0.5,
    "bulb_half_breadth": 0.46,
    "bulb_length": 1.0,
    "stem_rake_deg": 3.5,
}


def variation_fields() -> Figure:
    """Draw the local fields that six named parameters lay out together."""
    hull = ah.examples.bulk_carrier_207k()
    found = measure_all(hull.state)
    asked = {name: found[name] + more for name, more in _MORE.items()}
    (layer,) = compose(parent_of(hull.state, found), asked, Layout()).layers
    assert isinstance(layer, FieldLayer)
    return field_plan(hull, layer, paper="A4")
