# What `assoc_hull.study` offers, for type checkers and editors; at run time `assoc_hull`
# fills the package on first use, as some of these names stand above it.
from typing import TypeAlias

from assoc_hull.hull.hull import Hull
from assoc_hull.hull.results import Study as _Study
from assoc_hull.study.sampling import sample as sample

Study: TypeAlias = _Study[Hull]
