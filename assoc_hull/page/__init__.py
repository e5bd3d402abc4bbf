"""The fairing page: a hull is shown and faired by hand in a browser, served on this machine only.

`serve` is called with a hull or the name of its file; the command `assoc-hull page` does just that.
"""

from assoc_hull.page.server import PageServer, serve

__all__ = ["PageServer", "serve"]
