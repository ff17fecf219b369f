"""Bullet's source: the files that closest points of convex hulls need, from PyPI's source distribution of pybullet.

pip fetches it once, 80 MB. What is needed, 1 MB, is kept in the user's cache; nothing of it is in this repository.
"""

from __future__ import annotations

import hashlib
import shutil
import subprocess
import sys
import tarfile
import tempfile
from collections.abc import Callable
from pathlib import Path

from ..errors import HostError

__all__ = [
    "BULLET", "DEFINES", "FILES", "LICENCE", "SHAPES", "VERSION", "find_bullet_sources", "has_bullet_sources",
]  # fmt: skip

BULLET = "pybullet==3.2.7"
"""Bullet 3.26. Another version may round otherwise, and then the library's bits are no longer PyBullet's."""
ARCHIVE = "pybullet-3.2.7.tar.gz"
SHA_256 = "042879db8d101ac7590dee475fc6aded508b85fe1273fdbbfde1d88bd200e14f"
"""Of the archive, the same on every mirror."""
DEFINES = ("BT_USE_DOUBLE_PRECISION",)
"""As PyBullet is compiled; without it Bullet calculates with 32 bits."""
VERSION = "Bullet 3.26"

SHAPES = (
    "BulletCollision/CollisionShapes/btCollisionShape",
    "BulletCollision/CollisionShapes/btConvexHullShape",
    "BulletCollision/CollisionShapes/btConvexInternalShape",
    "BulletCollision/CollisionShapes/btConvexPolyhedron",
    "BulletCollision/CollisionShapes/btConvexShape",
    "BulletCollision/CollisionShapes/btPolyhedralConvexShape",
    "BulletCollision/CollisionShapes/btSphereShape",
    "BulletCollision/NarrowPhaseCollision/btGjkEpa2",
    "BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver",
    "BulletCollision/NarrowPhaseCollision/btGjkPairDetector",
    "BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver",
    "LinearMath/btAlignedAllocator",
    "LinearMath/btConvexHullComputer",
    "LinearMath/btGeometryUtil",
)
"""The files to compile, without `.cpp`; each has a header of its name."""
_HEADERS = (
    "BulletCollision/BroadphaseCollision/btBroadphaseProxy",
    "BulletCollision/CollisionShapes/btBoxShape",
    "BulletCollision/CollisionShapes/btCapsuleShape",
    "BulletCollision/CollisionShapes/btCollisionMargin",
    "BulletCollision/CollisionShapes/btConeShape",
    "BulletCollision/CollisionShapes/btConvexPointCloudShape",
    "BulletCollision/CollisionShapes/btCylinderShape",
    "BulletCollision/CollisionShapes/btTriangleShape",
    "BulletCollision/NarrowPhaseCollision/btConvexPenetrationDepthSolver",
    "BulletCollision/NarrowPhaseCollision/btDiscreteCollisionDetectorInterface",
    "BulletCollision/NarrowPhaseCollision/btSimplexSolverInterface",
    "LinearMath/btAabbUtil2",
    "LinearMath/btAlignedObjectArray",
    "LinearMath/btGrahamScan2dConvexHull",
    "LinearMath/btHashMap",
    "LinearMath/btMatrix3x3",
    "LinearMath/btMinMax",
    "LinearMath/btQuadWord",
    "LinearMath/btQuaternion",
    "LinearMath/btScalar",
    "LinearMath/btSerializer",
    "LinearMath/btTransform",
    "LinearMath/btVector3",
)
FOLDER = "bullet-3.26"
LICENCE = "LICENSE.txt"
FILES = (
    LICENCE,
    *(f"{name}.cpp" for name in SHAPES),
    *(f"{name}.h" for name in (*SHAPES, *_HEADERS)),
)
"""What is kept, as paths below the folder."""

Fetch = Callable[[Path], None]


def find_bullet_sources(cache: Path, fetch: Fetch | None = None) -> Path:
    """Folder with Bullet's files, which is also the folder for `#include`; fetched on first use.

    cache: folder in which that folder is kept; fetch: puts the archive into a folder, by pip unless told. Raises
    HostError.
    """
    folder = cache / FOLDER
    if not is_complete(folder):
        with tempfile.TemporaryDirectory() as aside:
            try:
                (fetch or _fetch_by_pip)(Path(aside))
            except OSError as error:
                raise HostError(_describe_failure(folder, str(error))) from None
            _unpack(Path(aside, ARCHIVE), folder)
    return folder


def has_bullet_sources(cache: Path) -> bool:
    """Whether they are kept there already."""
    return is_complete(cache / FOLDER)


def is_complete(folder: Path) -> bool:
    """Whether all files are there."""
    return all((folder / name).is_file() for name in FILES)


def _fetch_by_pip(folder: Path) -> None:
    """Let this Python's pip fetch the archive; its own settings for a mirror or a proxy hold. Raises OSError."""
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--no-binary", "pybullet"]
    command += ["--disable-pip-version-check", "--dest", str(folder), BULLET]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        lines = [line for line in (done.stderr or done.stdout).splitlines() if line.strip()]
        errors = [line for line in lines if line.lower().startswith("error")] or lines[-1:]
        raise OSError(" ".join(" ".join(errors).split())[:300])


def _describe_failure(folder: Path, said: str) -> str:
    return (
        f"Bullet's source cannot be fetched: pip downloads it as the source distribution of {BULLET} and failed "
        f"({said}); see that `{sys.executable or 'python'} -m pip` works and reaches its index, or copy {folder} from "
        "a machine that has it"
    )


def _unpack(archive: Path, folder: Path) -> None:
    """Put the files of the archive into the folder, all or none. Raises HostError."""
    if not archive.is_file() or hashlib.sha256(archive.read_bytes()).hexdigest() != SHA_256:
        raise HostError(
            f"Bullet's source cannot be used: what pip fetched for {BULLET} is not {ARCHIVE} with the SHA-256 "
            f"{SHA_256[:12]}...; clear pip's cache (`python -m pip cache remove pybullet`) or see what index it uses"
        )
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".bullet-", dir=folder.parent) as aside:
            _extract(archive, Path(aside, "whole"))
            if folder.exists() and not is_complete(folder):
                shutil.rmtree(folder)
            if not folder.exists():
                Path(aside, "whole").rename(folder)
    except OSError as error:
        if not is_complete(folder):  # else another process was faster
            raise HostError(
                f"cannot write to {folder}: {error.strerror or error}; make its folder writable, or room on the disk"
            ) from None


def _extract(archive: Path, whole: Path) -> None:
    root = ARCHIVE.removesuffix(".tar.gz")
    places = {f"{root}/{LICENCE}": LICENCE} | {f"{root}/src/{name}": name for name in FILES if name != LICENCE}
    with tarfile.open(archive) as packed:
        for member in packed:
            content = packed.extractfile(member) if member.name in places else None
            if content is not None:
                place = whole / places[member.name]
                place.parent.mkdir(parents=True, exist_ok=True)
                place.write_bytes(content.read())
