"""`python -m pymlt` is `pymlt`."""

import sys

from .cli import main

sys.exit(main())
