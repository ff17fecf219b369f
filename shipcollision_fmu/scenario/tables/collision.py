"""[collision]: the parameters of the collision FMU, and the report of indicative damage."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, WithJsonSchema, field_validator

from ...collision.checks import MAXIMUM_FRICTION
from ...collision.responses import RESPONSES
from ...ship.tables.table import Pair, Table

__all__ = ["Collision", "DamageTable"]


class DamageTable(Table):
    """damage: indicative damage is reported with each collision, by the formulae of results/damage.py."""

    t_eq: float = Field(gt=0, le=2, description="the plate thickness of decks and bottoms of both ships, summed [m]")
    half_angle_deg: float = Field(
        gt=0, lt=90, description="the half angle of the striking bow in plan [deg], e.g. 30.0"
    )
    shells: list[Pair] = Field(default=[], description="[[height, thickness], ...] of side shells torn open [m]")

    @field_validator("shells")
    @classmethod
    def _check_shells(cls, shells: list[Pair]) -> list[Pair]:
        for height, thickness in shells:
            if not (0.0 < height <= 50.0 and 0.0 < thickness <= 0.1):
                raise ValueError(f"damage: shell {[height, thickness]} must be a height and a thickness in metres")
        return shells


class Collision(Table):
    """[collision]: parameters of the collision FMU; a key that is left out keeps the FMU's start value."""

    friction: float | None = Field(
        default=None, ge=0, le=MAXIMUM_FRICTION, description="Coulomb's coefficient of friction [1], e.g. 0.3"
    )
    restitution: float | None = Field(
        default=None, ge=0, le=1, description="the coefficient of restitution [1], 0 for plastic, 1 for elastic"
    )
    response: Annotated[str, WithJsonSchema({"type": "string", "enum": list(RESPONSES)})] | None = Field(
        default=None, description="the contact solver"
    )
    substep: float | None = Field(
        default=None, gt=0, description="the internal step of the collision FMU [s], e.g. 0.01"
    )
    feedback: Literal["ledger", "force", "state", "none"] | None = Field(
        default=None,
        description='how the ships take up the impulses; "state" is refused: ShipManoeuvring has no input for post.*',
    )
    minimum_separation_time: float | None = Field(
        default=None, gt=0, description="the time without contact that ends a collision [s], e.g. 10.0"
    )
    clearance_range: float | None = Field(default=None, gt=0, description="the cap of the clearance [m], e.g. 200.0")
    damage: DamageTable | None = Field(default=None, description="{t_eq = 0.1, half_angle_deg = 30.0}; absent: none")

    @field_validator("response")
    @classmethod
    def _check_response(cls, response: str | None) -> str | None:
        if response is not None and response not in RESPONSES:
            raise ValueError(f"[collision] response = {response!r} is not offered: take one of {', '.join(RESPONSES)}")
        return response

    @field_validator("feedback")
    @classmethod
    def _check_feedback(cls, feedback: str | None) -> str | None:
        if feedback == "state":
            raise ValueError(
                '[collision] feedback = "state" needs ships that adopt post.*, for which ShipManoeuvring has no input: '
                "take ledger, force or none"
            )
        return feedback
