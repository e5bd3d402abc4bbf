# What `assoc_hull.study` offers, for type checkers and editors; at run time `assoc_hull`
# fills the package on first use, as some of these names stand above it.
from typing import TypeAlias

from assoc_hull.hull.hull import Hull
from assoc_hull.hull.studies import Study as _Study
from assoc_hull.study.design import grid as grid
from assoc_hull.study.design import sample as sample
from assoc_hull.study.pareto import pareto_front as pareto_front

Study: TypeAlias = _Study[Hull]
