"""``python -m heeltoe`` is the command ``heeltoe``."""

from heeltoe.cli import main

main()
