"""Pictures of results, and of lines that are no hull yet; they need the extra `plot`.

Pictures of one hull are methods of `hull.plot`.
"""

from assoc_hull.plot.diagrams.form_curve import form_curve_picture
from assoc_hull.plot.diagrams.form_definitions import definition_curves
from assoc_hull.plot.diagrams.hydrostatics import (
    bonjean_curves,
    hydrostatic_curves,
    sectional_area_curve,
)
from assoc_hull.plot.diagrams.study import study_parallel, study_scatter
from assoc_hull.plot.lines_plan.before_after import before_after, snapshot
from assoc_hull.plot.lines_plan.comparison import comparison_pdf, comparison_plan
from assoc_hull.plot.lines_plan.curvature_combs import combs_plan
from assoc_hull.plot.lines_plan.drawing import given_lines
from assoc_hull.plot.plates.curvature_map import curvature_figure
from assoc_hull.plot.plates.development import development_figure
from assoc_hull.plot.plates.hull_map import hull_map
from assoc_hull.plot.plates.lit_surface import surface_figure
from assoc_hull.plot.plates.plate_book import plate_sheet

__all__ = [
    "before_after",
    "bonjean_curves",
    "combs_plan",
    "comparison_pdf",
    "comparison_plan",
    "curvature_figure",
    "definition_curves",
    "development_figure",
    "form_curve_picture",
    "given_lines",
    "hull_map",
    "hydrostatic_curves",
    "plate_sheet",
    "sectional_area_curve",
    "snapshot",
    "study_parallel",
    "study_scatter",
    "surface_figure",
]
