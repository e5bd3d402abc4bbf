# What `assoc_hull.variation` offers, for type checkers and editors; at run time `assoc_hull`
# fills the package on first use, as some of these names stand above it.
from typing import TypeAlias

from assoc_hull.hull.hull import Hull
from assoc_hull.hull.variants import Jumboised as _Jumboised
from assoc_hull.hull.variants import Shifted as _Shifted
from assoc_hull.hull.variants import Variation as _Variation
from assoc_hull.variation.comparing.comparison import HullComparison as HullComparison
from assoc_hull.variation.comparing.comparison import compare as compare
from assoc_hull.variation.direct.least_change import Basis as Basis
from assoc_hull.variation.direct.least_change import CurveTarget as CurveTarget
from assoc_hull.variation.direct.least_change import SurfaceTarget as SurfaceTarget
from assoc_hull.variation.direct.least_change import pull_curve as pull_curve
from assoc_hull.variation.direct.least_change import pull_surface as pull_surface
from assoc_hull.variation.direct.pull_curve_through import HeldPlace as HeldPlace
from assoc_hull.variation.direct.pull_curve_through import pass_through as pass_through
from assoc_hull.variation.direct.pull_curve_through import pull_through as pull_through
from assoc_hull.variation.fields.batch_displacements import FieldPlan as FieldPlan
from assoc_hull.variation.fields.bounded_functions import BlendChain as BlendChain
from assoc_hull.variation.fields.bounded_functions import Ramp as Ramp
from assoc_hull.variation.fields.field import AffinePiece as AffinePiece
from assoc_hull.variation.fields.field import Boundary as Boundary
from assoc_hull.variation.fields.field import StackedField as StackedField
from assoc_hull.variation.fields.image_intersections import intersect_images as intersect_images
from assoc_hull.variation.fields.image_intersections import plane_source as plane_source
from assoc_hull.variation.fields.layers import AdditiveLayer as AdditiveLayer
from assoc_hull.variation.fields.layers import CornerLayer as CornerLayer
from assoc_hull.variation.fields.layers import DeadriseLayer as DeadriseLayer
from assoc_hull.variation.fields.layers import FieldLayer as FieldLayer
from assoc_hull.variation.fields.space_map import VariationMap as VariationMap
from assoc_hull.variation.jumboise_hull import JumboiseReport as JumboiseReport
from assoc_hull.variation.parameters.field_layout import Layout as Layout
from assoc_hull.variation.parameters.measurement import Measures as Measures
from assoc_hull.variation.sensitivities import Sensitivities as Sensitivities
from assoc_hull.variation.shifts.shift_hull import ShiftReport as ShiftReport
from assoc_hull.variation.shifts.shift_terms import Terminals as Terminals
from assoc_hull.variation.vary import VariationReport as VariationReport

Jumboised: TypeAlias = _Jumboised[Hull]
Shifted: TypeAlias = _Shifted[Hull]
Variation: TypeAlias = _Variation[Hull]
