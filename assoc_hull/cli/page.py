"""The command that shows a hull in the browser, to be faired by hand."""

from __future__ import annotations

import argparse
import sys
import webbrowser

from assoc_hull.cli.arguments import Commands, add_command, add_hull, add_json
from assoc_hull.cli.output import emit

__all__ = ["add_page"]


def add_page(commands: Commands) -> None:
    """Add ``page``."""
    parser = add_command(
        commands, "page", _page,
        """assoc-hull page ship.hull
        assoc-hull page ship.hull --port 8123 --no-browser --stay
        assoc-hull page ship.hull --author anna --json""",
    )  # fmt: skip
    add_hull(parser)
    parser.add_argument(
        "--port", type=int, default=0, metavar="N", help="port of 127.0.0.1 (default: a free one)"
    )
    parser.add_argument(
        "--no-browser", action="store_true", help="print the address, and open no browser"
    )
    parser.add_argument(
        "--author", metavar="NAME", help="who signs edits (default: the name of the user)"
    )
    parser.add_argument(
        "--stay", action="store_true",
        help="serve on when the last page has been closed for a minute; Ctrl+C ends it",
    )  # fmt: skip
    add_json(parser)


def _page(arguments: argparse.Namespace) -> int:
    from assoc_hull.edit.garbage_collection import freeze_loaded_objects
    from assoc_hull.page import PageServer

    with PageServer(arguments.hull, port=arguments.port, author=arguments.author) as server:
        path = server.hull.path
        kept = "every edit is kept in it" if path else "edits stay in memory, and go with the page"
        facts = {"address": server.address, "hull": str(arguments.hull), "kept": path is not None}
        # A full collection beside a drag looks at what came since. Ctrl+C within a finalizer would
        # be lost: nobody ends what has not told its address.
        freeze_loaded_objects()
        emit(arguments, facts, f"{server.address}\n{arguments.hull}: {kept}")
        sys.stdout.flush()  # whoever reads it through a pipe is waiting for the address
        if not arguments.no_browser:
            webbrowser.open(server.address)
        server.wait(stay=arguments.stay)
    return 0
