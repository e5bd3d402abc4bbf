"""Formulas and curves of the classical papers, for use on their own.

Biarcs, arc chains, elastica, chord splines, conics, waterlines of pieces, conformal sections,
polynomial hulls, least squares, Lackenby's shift. Whole hulls by classical definitions are read by
`assoc_hull.creation.read_classical`.
"""

from assoc_hull.creation.classical.lewis_hull import LewisHull
from assoc_hull.creation.classical.middle_body import MiddleBody, Midship
from assoc_hull.geometry.classical.arc_fit import ArcFit, fit_arcs
from assoc_hull.geometry.classical.biarc_chain import (
    BiarcChain,
    BiarcTangents,
    TangentForm,
    biarc_chain,
    biarc_tangents,
)
from assoc_hull.geometry.classical.biarcs import BiarcRule, Biarcs, biarcs, free_biarcs
from assoc_hull.geometry.classical.camber import Camber
from assoc_hull.geometry.classical.chord_spline import ChordSpline, chord_splines
from assoc_hull.geometry.classical.circular_arcs import (
    PlaneArcs,
    TrueCircle,
    circle_by_tangent,
    circle_through,
    fitted_circle,
    tangent_curvature,
)
from assoc_hull.geometry.classical.combined_waterline import (
    Quintic,
    WaterlineRegion,
    WaterlineRegions,
    combined_waterline,
    fit_quintic,
    joined_pieces,
)
from assoc_hull.geometry.classical.conformal_sections import (
    ConformalSections,
    fit_conformal,
    lewis_sections,
)
from assoc_hull.geometry.classical.elastica import Elastica, fit_elastica
from assoc_hull.geometry.classical.lackenby_shift import lackenby_shift, one_minus_prismatic
from assoc_hull.geometry.classical.linear_least_squares import (
    LinearFit,
    OrthogonalFit,
    bounded_fit,
    held_fit,
    linear_fit,
    orthogonal_fit,
)
from assoc_hull.geometry.classical.pieced_curve import (
    FormulaPiece,
    PiecedCurve,
    PieceJoin,
    circle_piece,
    conic,
    conic_coefficients,
    cubic_conic,
    cubic_conic_coefficients,
    fit_cubic_conic,
)
from assoc_hull.geometry.classical.polynomial_hulls import (
    DraftFunctions,
    PolynomialHull,
    SeriesHull,
    chapman_parabola,
    fit_polynomial_hull,
    fit_series,
    fit_series_hull,
    form_polynomial,
    product_hull,
    series_columns,
    taylor_quintic,
)
from assoc_hull.geometry.classical.smooth_offsets import SmoothedTable, smooth_offsets, smooth_table
from assoc_hull.geometry.classical.truncated_power_spline import TruncatedPower
from assoc_hull.variation.shifts.lackenby import HalfBody, half_bodies, lackenby_changes

__all__ = [
    "ArcFit",
    "BiarcChain",
    "BiarcRule",
    "BiarcTangents",
    "Biarcs",
    "Camber",
    "ChordSpline",
    "ConformalSections",
    "DraftFunctions",
    "Elastica",
    "FormulaPiece",
    "HalfBody",
    "LewisHull",
    "LinearFit",
    "MiddleBody",
    "Midship",
    "OrthogonalFit",
    "PieceJoin",
    "PiecedCurve",
    "PlaneArcs",
    "PolynomialHull",
    "Quintic",
    "SeriesHull",
    "SmoothedTable",
    "TangentForm",
    "TrueCircle",
    "TruncatedPower",
    "WaterlineRegion",
    "WaterlineRegions",
    "biarc_chain",
    "biarc_tangents",
    "biarcs",
    "bounded_fit",
    "chapman_parabola",
    "chord_splines",
    "circle_by_tangent",
    "circle_piece",
    "circle_through",
    "combined_waterline",
    "conic",
    "conic_coefficients",
    "cubic_conic",
    "cubic_conic_coefficients",
    "fit_arcs",
    "fit_conformal",
    "fit_cubic_conic",
    "fit_elastica",
    "fit_polynomial_hull",
    "fit_quintic",
    "fit_series",
    "fit_series_hull",
    "fitted_circle",
    "form_polynomial",
    "free_biarcs",
    "half_bodies",
    "held_fit",
    "joined_pieces",
    "lackenby_changes",
    "lackenby_shift",
    "lewis_sections",
    "linear_fit",
    "one_minus_prismatic",
    "orthogonal_fit",
    "product_hull",
    "series_columns",
    "smooth_offsets",
    "smooth_table",
    "tangent_curvature",
    "taylor_quintic",
]
