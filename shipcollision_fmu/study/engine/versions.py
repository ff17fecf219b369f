"""describe_other_version(): the refusal of a scheduler or a worker with another version of this package."""

from __future__ import annotations

__all__ = ["DISTRIBUTION", "describe_other_version"]

DISTRIBUTION = "shipcollision-fmu"


def describe_other_version(name: str, version: str | None, client: str) -> str:
    """The refusal of a member of a cluster that has another version of this package than the client, or none."""
    has = f"{DISTRIBUTION} {version}" if version else f"no {DISTRIBUTION}"
    return (
        f"{name} has {has}, the client has {client}: run `python -m pip install '{DISTRIBUTION}[study]=={client}'` on "
        "every machine of the cluster, and start it again"
    )
