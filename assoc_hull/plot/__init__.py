"""Pictures of hulls and of reports; they need the extra `plot`."""

from assoc_hull.plot.comb_plan import combs_plan
from assoc_hull.plot.combs import curvature_combs
from assoc_hull.plot.compare import before_after, snapshot
from assoc_hull.plot.comparison_plan import comparison_plan
from assoc_hull.plot.comparison_sheet import comparison_pdf
from assoc_hull.plot.curvature_map import curvature_figure
from assoc_hull.plot.definitions import definition_curves
from assoc_hull.plot.development import development_figure
from assoc_hull.plot.deviations import adoption_deviations
from assoc_hull.plot.form_curve import form_curve_picture
from assoc_hull.plot.hull_map import hull_map
from assoc_hull.plot.hydrostatic_curves import hydrostatic_curves
from assoc_hull.plot.lines_plan import lines_plan
from assoc_hull.plot.neighbourhood import neighbourhood
from assoc_hull.plot.plate_sheet import plate_sheet
from assoc_hull.plot.section_areas import bonjean_curves, sectional_area_curve
from assoc_hull.plot.surface_figure import surface_figure

__all__ = [
    "adoption_deviations",
    "before_after",
    "bonjean_curves",
    "combs_plan",
    "comparison_pdf",
    "comparison_plan",
    "curvature_combs",
    "curvature_figure",
    "definition_curves",
    "development_figure",
    "form_curve_picture",
    "hull_map",
    "hydrostatic_curves",
    "lines_plan",
    "neighbourhood",
    "plate_sheet",
    "sectional_area_curve",
    "snapshot",
    "surface_figure",
]
