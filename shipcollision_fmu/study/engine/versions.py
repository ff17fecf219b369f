"""Refusals of a scheduler or a worker that lacks this package, another one that it needs, or the client's version."""

from __future__ import annotations

from ... import __version__

__all__ = ["DISTRIBUTION", "describe_missing_package", "describe_other_version"]

DISTRIBUTION = "shipcollision-fmu"


def describe_other_version(name: str, version: str | None, client: str) -> str:
    """The refusal of a member of a cluster that has another version of this package than the client, or none."""
    has = f"{DISTRIBUTION} {version}" if version else f"no {DISTRIBUTION}"
    return f"{name} has {has}, the client has {client}: {_name_remedy(client)}"


def describe_missing_package(package: str) -> str:
    """The refusal of a worker that came later and cannot import what a batch needs."""
    return f"a worker has no package {package!r}: {_name_remedy(__version__)}"


def _name_remedy(client: str) -> str:
    return (
        f"run `python -m pip install '{DISTRIBUTION}[study]=={client}'` (in a clone: '.[study]') on every machine of "
        "the cluster, and start it again"
    )
