"""Associative ship hull forms: lines that follow one another when one is changed.

Examples
--------
>>> import assoc_hull as ah
>>> hull = ah.examples.wigley()
>>> hull.points["WL 2.5 x ST 7"].free
('y',)
"""

from importlib import import_module
from typing import TYPE_CHECKING

import assoc_hull.study  # else its first import would bind this name again
import assoc_hull.surface  # likewise

if TYPE_CHECKING:
    from assoc_hull.analysis.derivatives.hydrostatic_derivatives import hydrostatic_derivatives
    from assoc_hull.analysis.fairness.line_fairness import fairness
    from assoc_hull.analysis.form.curve_transform import curve_transform
    from assoc_hull.analysis.form.floating_shape import Screw
    from assoc_hull.analysis.form.form_parameters import form_parameters
    from assoc_hull.analysis.hydrostatics.floating_body import Appendage
    from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatic_table, hydrostatics
    from assoc_hull.analysis.hydrostatics.immersion import immersion
    from assoc_hull.analysis.panels.hull_panels import panels
    from assoc_hull.analysis.stability.cross_curves import cross_curves
    from assoc_hull.analysis.stability.equilibrium import equilibrium
    from assoc_hull.analysis.stability.flooding import FloodingPoint
    from assoc_hull.analysis.stability.stability_report import stability
    from assoc_hull.creation.design import Design
    from assoc_hull.creation.form_curve import FormCurve
    from assoc_hull.creation.form_definitions import course, design_waterline, sectional_area
    from assoc_hull.errors import (
        AssocHullError,
        BadInputError,
        FileBusyError,
        ForeignPointError,
        FreedomError,
        NoMeetingError,
        OutOfRangeError,
        PointRoleError,
        RefusedEditError,
        RingError,
        StaleHullError,
        UnknownNameError,
        UnreachableError,
    )
    from assoc_hull.geometry.curves import PointKind
    from assoc_hull.geometry.patches.spline_surface import SplineSurface
    from assoc_hull.geometry.plane import Plane
    from assoc_hull.hull import Hull
    from assoc_hull.model.form_definition import FormDefinition
    from assoc_hull.model.kinds import BoundaryKind
    from assoc_hull.model.line_source import LineSource
    from assoc_hull.model.objects import Crossing, Curve, Group, Line, Point
    from assoc_hull.model.tables import Association, Ends, Particulars
    from assoc_hull.plating import plates, read_surfaces
    from assoc_hull.production import production_arcs
    from assoc_hull.shell import HullSurface, surface
    from assoc_hull.shifts import shift_sections, swing
    from assoc_hull.sources import create, examples, open, read, read_classical
    from assoc_hull.studies import Study, study
    from assoc_hull.study.sampling import sample
    from assoc_hull.surface.cells.closed_mesh import closed_mesh
    from assoc_hull.surface.plates.hull_seams import HullSeams
    from assoc_hull.surface.regions.curvature_regions import curvature_regions
    from assoc_hull.tolerance import Tolerances
    from assoc_hull.variants import vary, vary_by
    from assoc_hull.variation.comparing.comparison import compare
    from assoc_hull.variation.parameters.parameter_measures import measure
    from assoc_hull.variation.sensitivities import sensitivities

__all__ = [
    "Appendage",
    "AssocHullError",
    "Association",
    "BadInputError",
    "BoundaryKind",
    "Crossing",
    "Curve",
    "Design",
    "Ends",
    "FileBusyError",
    "FloodingPoint",
    "ForeignPointError",
    "FormCurve",
    "FormDefinition",
    "FreedomError",
    "Group",
    "Hull",
    "HullSeams",
    "HullSurface",
    "Line",
    "LineSource",
    "NoMeetingError",
    "OutOfRangeError",
    "Particulars",
    "Plane",
    "Point",
    "PointKind",
    "PointRoleError",
    "RefusedEditError",
    "RingError",
    "Screw",
    "SplineSurface",
    "StaleHullError",
    "Study",
    "Tolerances",
    "UnknownNameError",
    "UnreachableError",
    "__version__",
    "closed_mesh",
    "compare",
    "course",
    "create",
    "cross_curves",
    "curvature_regions",
    "curve_transform",
    "design_waterline",
    "equilibrium",
    "examples",
    "fairness",
    "form_parameters",
    "hydrostatic_derivatives",
    "hydrostatic_table",
    "hydrostatics",
    "immersion",
    "measure",
    "open",
    "panels",
    "plates",
    "production_arcs",
    "read",
    "read_classical",
    "read_surfaces",
    "sample",
    "sectional_area",
    "sensitivities",
    "shift_sections",
    "stability",
    "study",
    "surface",
    "swing",
    "vary",
    "vary_by",
]

__version__ = "0.1.0"

_HOMES = {
    "analysis.derivatives.hydrostatic_derivatives": ("hydrostatic_derivatives",),
    "analysis.fairness.line_fairness": ("fairness",),
    "analysis.form.curve_transform": ("curve_transform",),
    "analysis.form.floating_shape": ("Screw",),
    "analysis.form.form_parameters": ("form_parameters",),
    "analysis.hydrostatics.floating_body": ("Appendage",),
    "analysis.hydrostatics.hull_hydrostatics": (
        "hydrostatic_table",
        "hydrostatics",
    ),
    "analysis.hydrostatics.immersion": ("immersion",),
    "analysis.panels.hull_panels": ("panels",),
    "analysis.stability.cross_curves": ("cross_curves",),
    "analysis.stability.equilibrium": ("equilibrium",),
    "analysis.stability.flooding": ("FloodingPoint",),
    "analysis.stability.stability_report": ("stability",),
    "creation.design": ("Design",),
    "creation.form_curve": ("FormCurve",),
    "creation.form_definitions": (
        "course",
        "design_waterline",
        "sectional_area",
    ),
    "errors": (
        "AssocHullError",
        "BadInputError",
        "FileBusyError",
        "ForeignPointError",
        "FreedomError",
        "NoMeetingError",
        "OutOfRangeError",
        "PointRoleError",
        "RefusedEditError",
        "RingError",
        "StaleHullError",
        "UnknownNameError",
        "UnreachableError",
    ),
    "geometry.curves": ("PointKind",),
    "geometry.patches.spline_surface": ("SplineSurface",),
    "geometry.plane": ("Plane",),
    "hull": ("Hull",),
    "model.form_definition": ("FormDefinition",),
    "model.kinds": ("BoundaryKind",),
    "model.line_source": ("LineSource",),
    "model.objects": (
        "Crossing",
        "Curve",
        "Group",
        "Line",
        "Point",
    ),
    "model.tables": (
        "Association",
        "Ends",
        "Particulars",
    ),
    "plating": (
        "plates",
        "read_surfaces",
    ),
    "production": ("production_arcs",),
    "shell": (
        "HullSurface",
        "surface",
    ),
    "shifts": (
        "shift_sections",
        "swing",
    ),
    "sources": (
        "create",
        "examples",
        "open",
        "read",
        "read_classical",
    ),
    "studies": (
        "Study",
        "study",
    ),
    "study.sampling": ("sample",),
    "surface.cells.closed_mesh": ("closed_mesh",),
    "surface.plates.hull_seams": ("HullSeams",),
    "surface.regions.curvature_regions": ("curvature_regions",),
    "tolerance": ("Tolerances",),
    "variants": (
        "vary",
        "vary_by",
    ),
    "variation.comparing.comparison": ("compare",),
    "variation.parameters.parameter_measures": ("measure",),
    "variation.sensitivities": ("sensitivities",),
}
"""Modules and what is public of them."""

if not TYPE_CHECKING:
    # What only lofts and cuts does not wait for the modules of whole hulls.
    _home = {name: module for module, names in _HOMES.items() for name in names}
    del assoc_hull, study, surface  # the subpackages; below the names mean other things

    def __getattr__(name: str) -> object:
        """Import a public name when it is first used."""
        if name not in _home:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        found = getattr(import_module(f"{__name__}.{_home[name]}"), name)
        globals()[name] = found
        return found

    def __dir__() -> list[str]:
        """Name what is public, whether it has been used or not."""
        return sorted({*globals(), *__all__})
