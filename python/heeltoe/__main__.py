"""``python -m heeltoe`` is the command ``heeltoe``."""

from heeltoe.cli.main import main

main()
