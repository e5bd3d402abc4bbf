"""The command line as ``python -m assoc_hull.cli``."""

import sys

from assoc_hull.cli import main

__all__: list[str] = []

if __name__ == "__main__":
    sys.exit(main())
