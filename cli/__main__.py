"""``python -m cli``."""

import sys

from cli.entry import main

sys.exit(main())
