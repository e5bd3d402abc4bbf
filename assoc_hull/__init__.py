"""Associative ship hull forms: lines that follow one another when one is changed.

What starts from one hull is a method of `Hull`; what these methods take and give, and what starts
from several hulls or from none, stands in the packages named in `__all__`.

Examples
--------
>>> import assoc_hull as ah
>>> hull = ah.examples.wigley()
>>> hull["WL 2.5 x ST 7"].free
('y',)
"""

from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from assoc_hull import classical, creation, errors, form, hydro, plot, study, surface, variation
    from assoc_hull.errors import AssocHullError
    from assoc_hull.geometry.curves import PointKind
    from assoc_hull.geometry.plane import Plane
    from assoc_hull.hull.hull import Hull
    from assoc_hull.hull.sources import create, examples, open, read
    from assoc_hull.io.offsets.doctor import doctor
    from assoc_hull.model.kinds import BoundaryKind
    from assoc_hull.model.line_source import LineSource
    from assoc_hull.model.objects import Crossing, Curve, Group, Line, Point
    from assoc_hull.model.tables import Association, Ends, Particulars
    from assoc_hull.page.widget import widget
    from assoc_hull.tolerance import Tolerances

__all__ = [
    "AssocHullError",
    "Association",
    "BoundaryKind",
    "Crossing",
    "Curve",
    "Ends",
    "Group",
    "Hull",
    "Line",
    "LineSource",
    "Particulars",
    "Plane",
    "Point",
    "PointKind",
    "Tolerances",
    "__version__",
    "classical",
    "create",
    "creation",
    "doctor",
    "errors",
    "examples",
    "form",
    "hydro",
    "open",
    "plot",
    "read",
    "study",
    "surface",
    "variation",
    "widget",
]

__version__ = "0.1.0"

_PUBLIC: dict[str, dict[str, tuple[str, ...]]] = {
    "": {
        "errors": ("AssocHullError",),
        "geometry.curves": ("PointKind",),
        "geometry.plane": ("Plane",),
        "hull.hull": ("Hull",),
        "hull.sources": (
            "create",
            "examples",
            "open",
            "read",
        ),
        "io.offsets.doctor": ("doctor",),
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
        "page.widget": ("widget",),
        "tolerance": ("Tolerances",),
    },
    "variation": {
        "hull.variants": (
            "Jumboised",
            "Shifted",
            "Variation",
        ),
        "variation.comparing.comparison": (
            "HullComparison",
            "compare",
        ),
        "variation.direct.least_change": (
            "Basis",
            "CurveTarget",
            "SurfaceTarget",
            "pull_curve",
            "pull_surface",
        ),
        "variation.direct.pull_curve_through": (
            "HeldPlace",
            "pass_through",
            "pull_through",
        ),
        "variation.fields.batch_displacements": ("FieldPlan",),
        "variation.fields.bounded_functions": (
            "BlendChain",
            "Ramp",
        ),
        "variation.fields.field": ("AffinePiece", "Boundary", "StackedField"),
        "variation.fields.image_intersections": (
            "intersect_images",
            "plane_source",
        ),
        "variation.fields.layers": (
            "AdditiveLayer",
            "CornerLayer",
            "DeadriseLayer",
            "FieldLayer",
        ),
        "variation.fields.space_map": ("VariationMap",),
        "variation.jumboise_hull": ("JumboiseReport",),
        "variation.parameters.field_layout": ("Layout",),
        "variation.parameters.measurement": ("Measures",),
        "variation.sensitivities": ("Sensitivities",),
        "variation.shifts.shift_hull": ("ShiftReport",),
        "variation.shifts.shift_terms": ("Terminals",),
        "variation.vary": ("VariationReport",),
    },
    "creation": {
        "creation.design": ("Design",),
        "creation.design_reading": (
            "CurveResidual",
            "DesignReading",
        ),
        "creation.form_curve": ("FormCurve",),
        "creation.six_numbers": ("DesignNote",),
        "creation.form_definitions": (
            "course",
            "design_waterline",
            "sectional_area",
        ),
        "hull.sources": (
            "create",
            "read_classical",
        ),
        "model.form_definition": ("FormDefinition",),
    },
    "surface": {
        "geometry.patches.spline_surface": ("SplineSurface",),
        "hull.results": (
            "HullPlates",
            "HullSurface",
            "Plates",
            "ProductionArcs",
            "plates",
        ),
        "hull.sources": ("read_surfaces",),
        "surface.cells.closed_mesh": ("ClosedMesh",),
        "surface.plating.development": ("Development",),
        "surface.plating.hull_seams": ("HullSeams",),
        "surface.plating.surface_plates": ("Seams",),
        "surface.regions.curvature_regions": ("curvature_regions",),
        "surface.regions.result": ("RegionResult",),
    },
    "study": {
        "hull.studies": ("Study",),
        "study.pareto": ("pareto_front",),
        "study.design": ("grid", "sample"),
    },
}
"""What each public package offers: modules, and the names that are public of them."""

_MOVED = {
    "Appendage": "assoc_hull.hydro.Appendage",
    "BadInputError": "assoc_hull.errors.BadInputError",
    "Design": "assoc_hull.creation.Design",
    "FileBusyError": "assoc_hull.errors.FileBusyError",
    "HullBusyError": "assoc_hull.errors.HullBusyError",
    "FloodingPoint": "assoc_hull.hydro.FloodingPoint",
    "ForeignPointError": "assoc_hull.errors.ForeignPointError",
    "FormCurve": "assoc_hull.creation.FormCurve",
    "FormDefinition": "assoc_hull.creation.FormDefinition",
    "FreedomError": "assoc_hull.errors.FreedomError",
    "HullSeams": "assoc_hull.surface.HullSeams",
    "HullSurface": "assoc_hull.surface.HullSurface",
    "NoMeetingError": "assoc_hull.errors.NoMeetingError",
    "OutOfRangeError": "assoc_hull.errors.OutOfRangeError",
    "PointRoleError": "assoc_hull.errors.PointRoleError",
    "RefusedEditError": "assoc_hull.errors.RefusedEditError",
    "RingError": "assoc_hull.errors.RingError",
    "Screw": "assoc_hull.form.Screw",
    "SplineSurface": "assoc_hull.surface.SplineSurface",
    "StaleHullError": "assoc_hull.errors.StaleHullError",
    "Study": "assoc_hull.study.Study",
    "UnknownNameError": "assoc_hull.errors.UnknownNameError",
    "UnreachableError": "assoc_hull.errors.UnreachableError",
    "closed_mesh": "hull.mesh(...)",
    "compare": "hull.compare(variant), or assoc_hull.variation.compare(parent, variant)",
    "course": "assoc_hull.creation.course",
    "cross_curves": "hull.cross_curves(...)",
    "curvature_regions": "assoc_hull.surface.curvature_regions",
    "curve_transform": "hull.curve_transform(...)",
    "design_waterline": "assoc_hull.creation.design_waterline",
    "equilibrium": "hull.equilibrium(...)",
    "fairness": "hull.fairness(...), or assoc_hull.form.fairness(curve)",
    "form_parameters": "hull.form_parameters(...)",
    "hydrostatic_derivatives": "hull.hydrostatic_derivatives(...)",
    "hydrostatic_table": "hull.hydrostatic_table(...)",
    "hydrostatics": "hull.hydrostatics(...)",
    "immersion": "hull.immersion(...)",
    "measure": "hull.measure(...)",
    "panels": "hull.panels(...)",
    "plates": "hull.plates(seams), or assoc_hull.surface.plates(surfaces)",
    "production_arcs": "hull.production_arcs(...)",
    "read_classical": "assoc_hull.creation.read_classical",
    "read_surfaces": "assoc_hull.surface.read_surfaces",
    "sample": "assoc_hull.study.sample",
    "sectional_area": "assoc_hull.creation.sectional_area",
    "sensitivities": "hull.sensitivities(...)",
    "shift_sections": "hull.shift_sections(...)",
    "stability": "hull.stability(...)",
    "swing": "hull.swing(...)",
    "vary": "hull.vary(...)",
    "vary_by": "hull.vary_by(...)",
}
"""Names that version 0.1 had here, and what to write in their place."""

_CALLED = {"study": "hull.study(...)", "surface": "hull.surface(...)"}
"""Packages whose names were functions once."""

_FACES = ("classical", "errors", "form", "hydro", "plot")


class _PublicPackage(ModuleType):
    """A package whose public names are imported when they are first used."""

    __all__: list[str]

    def __getattr__(self, name: str) -> object:
        package = self.__name__.partition(".")[2]
        for module, names in _PUBLIC[package].items():
            if name in names:
                found = getattr(import_module(f"{__name__}.{module}"), name)
                setattr(self, name, found)
                return found
        if not package and name in _FACES:
            return import_module(f"{__name__}.{name}")
        if not package and name in _MOVED:
            raise AttributeError(f"{__name__}.{name} is {_MOVED[name]} now")
        raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")

    def __dir__(self) -> list[str]:
        # What is public, for the tab key; machinery and inner packages are importable unseen.
        return sorted({*(name for name in super().__dir__() if name[:2] == "__"), *self.__all__})


class _FormerFunction(_PublicPackage):
    """A package whose name was that of a function in version 0.1."""

    def __call__(self, *_: object, **__: object) -> object:
        remedy = _CALLED[self.__name__.partition(".")[2]]
        raise TypeError(f"{self.__name__} is a package: {remedy} is what it was")


for _package, _homes in _PUBLIC.items():
    # Empty packages: what only lofts and cuts does not wait for the modules of whole hulls.
    _module = import_module(f"{__name__}.{_package}".rstrip("."))
    _module.__class__ = _FormerFunction if _package in _CALLED else _PublicPackage
    if _package:
        vars(_module)["__all__"] = sorted(name for names in _homes.values() for name in names)
del _package, _homes, _module
