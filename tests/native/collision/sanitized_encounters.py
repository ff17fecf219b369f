"""Random encounters by a native library that was compiled under sanitizers.

Arguments: the library, the first seed, and the one after the last. The interpreter needs the sanitizers' own libraries
from its start on (LD_PRELOAD).
"""

from __future__ import annotations

import ctypes
import random
import sys

from tests.collision import conftest
from tests.collision.test_random_encounters import encounter

H = 0.2


def main() -> None:
    """Sail them, and print how many there were, and in how many of them ships touched."""
    library, first, last = sys.argv[1], *map(int, sys.argv[2:4])
    conftest.load_kernels = lambda: ctypes.CDLL(library)  # type: ignore[attr-defined]  # what the world asks for
    touched = 0
    for seed in range(first, last):
        names, starts, parameters = encounter(random.Random(seed))
        duration, plane = parameters.pop("time"), parameters["degrees_of_freedom"] == 3
        law = "straight" if seed % 2 else "kirchhoff" if plane else "free"
        more = {"coasting": law, **parameters, "response": "pgs"}
        world = conftest.World(names, starts, language="native", **more)
        while world.t < duration and all(abs(ship.attitude[0]) < 1.0 for ship in world.model.outputs.ships):
            world.step(H)
        touched += world.model.outputs.collision_count > 0
        world.model.close()
    print(f"{last - first} encounters, {touched} with contact")  # noqa: T201


if __name__ == "__main__":
    main()
