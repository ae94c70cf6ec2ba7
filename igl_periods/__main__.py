# PYTHON_ARGCOMPLETE_OK
"""``python -m igl_periods``: the command ``igl-periods``."""

import sys

from .cli import main

if __name__ == "__main__":
    sys.exit(main())
