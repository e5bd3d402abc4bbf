# What `assoc_hull.surface` offers, for type checkers and editors; at run time `assoc_hull`
# fills the package on first use, as some of these names stand above it.
from assoc_hull.geometry.patches.spline_surface import SplineSurface as SplineSurface
from assoc_hull.hull.results import HullPlates as HullPlates
from assoc_hull.hull.results import HullSurface as HullSurface
from assoc_hull.hull.results import Plates as Plates
from assoc_hull.hull.results import ProductionArcs as ProductionArcs
from assoc_hull.hull.results import plates as plates
from assoc_hull.hull.sources import read_surfaces as read_surfaces
from assoc_hull.surface.cells.closed_mesh import ClosedMesh as ClosedMesh
from assoc_hull.surface.plating.development import Development as Development
from assoc_hull.surface.plating.hull_seams import HullSeams as HullSeams
from assoc_hull.surface.plating.surface_plates import Seams as Seams
from assoc_hull.surface.regions.curvature_regions import curvature_regions as curvature_regions
from assoc_hull.surface.regions.result import RegionResult as RegionResult
