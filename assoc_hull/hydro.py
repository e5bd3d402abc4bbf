"""What hydrostatics, stability and resistance of a hull take and give; verbs are methods of `Hull`.

Besides, hydrostatics of a triangulated body (`mesh_flotation`), the parameters by which
`Hull.hydrostatic_derivatives` differentiates, and the resistance of a ship without a hull
(`holtrop`).
"""

from assoc_hull.analysis.derivatives.hydrostatic_derivatives import Derivatives
from assoc_hull.analysis.derivatives.parameters import (
    DRAUGHT,
    DRAUGHT_AFT,
    DRAUGHT_FORE,
    HEEL,
    TRIM,
    Deformation,
    Moves,
    PointMove,
    Position,
    Rates,
)
from assoc_hull.analysis.hydrostatics.floating_body import Appendage, FloatingPosition
from assoc_hull.analysis.hydrostatics.mesh_flotation import mesh_flotation
from assoc_hull.analysis.hydrostatics.record import FRESH, SALT, Hydrostatics, HydrostaticTable
from assoc_hull.analysis.hydrostatics.tunnel import Tunnel
from assoc_hull.analysis.resistance.calm_water_resistance import Resistance, ResistanceInput
from assoc_hull.analysis.resistance.holtrop import holtrop
from assoc_hull.analysis.resistance.holtrop_ship import HoltropShip
from assoc_hull.analysis.stability.cross_curves import CrossCurves
from assoc_hull.analysis.stability.equilibrium import Equilibrium
from assoc_hull.analysis.stability.flooding import FloodingPoint
from assoc_hull.analysis.stability.stability_report import Stability
from assoc_hull.geometry.integrals.stations import integrate_by_simpson
from assoc_hull.geometry.surfaces.panel_mesh import PanelMesh, below_water

__all__ = [
    "DRAUGHT",
    "DRAUGHT_AFT",
    "DRAUGHT_FORE",
    "FRESH",
    "HEEL",
    "SALT",
    "TRIM",
    "Appendage",
    "CrossCurves",
    "Deformation",
    "Derivatives",
    "Equilibrium",
    "FloatingPosition",
    "FloodingPoint",
    "HoltropShip",
    "HydrostaticTable",
    "Hydrostatics",
    "Moves",
    "PanelMesh",
    "PointMove",
    "Position",
    "Rates",
    "Resistance",
    "ResistanceInput",
    "Stability",
    "Tunnel",
    "below_water",
    "holtrop",
    "integrate_by_simpson",
    "mesh_flotation",
]
