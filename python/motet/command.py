"""The command `motet`, which the wheel puts on the path."""

from __future__ import annotations

import sys

from . import _motet


def main() -> int:
    """Runs the command line of this process, and returns its exit status."""
    return _motet.command(sys.argv)
