# What `assoc_hull.creation` offers, for type checkers and editors; at run time `assoc_hull`
# fills the package on first use, as some of these names stand above it.
from assoc_hull.creation.design import Design as Design
from assoc_hull.creation.design_reading import CurveResidual as CurveResidual
from assoc_hull.creation.design_reading import DesignReading as DesignReading
from assoc_hull.creation.form_curve import FormCurve as FormCurve
from assoc_hull.creation.form_definitions import course as course
from assoc_hull.creation.form_definitions import design_waterline as design_waterline
from assoc_hull.creation.form_definitions import sectional_area as sectional_area
from assoc_hull.creation.six_numbers import DesignNote as DesignNote
from assoc_hull.hull.sources import create as create
from assoc_hull.hull.sources import read_classical as read_classical
from assoc_hull.model.form_definition import FormDefinition as FormDefinition
