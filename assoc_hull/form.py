"""What form parameters of a hull take and give, and fairness of single curves.

`Hull.form_parameters`, `Hull.fairness` and `Hull.curve_transform` are the verbs; an entry of one's
own for the first is made by `parameter`.
"""

from assoc_hull.analysis.form.curve_transform import CurveTransform
from assoc_hull.analysis.form.floating_shape import Screw
from assoc_hull.analysis.form.form_parameters import CATALOGUE
from assoc_hull.analysis.form.parameter import (
    Absent,
    FormParameter,
    FormValue,
    Warned,
    parameter,
)
from assoc_hull.fairing.line_fairness import FairnessTable, fairness

__all__ = [
    "CATALOGUE",
    "Absent",
    "CurveTransform",
    "FairnessTable",
    "FormParameter",
    "FormValue",
    "Screw",
    "Warned",
    "fairness",
    "parameter",
]
