"""`python -m shipcollision_fmu` is the command `shipcollision`."""

from .cli import main

main()
