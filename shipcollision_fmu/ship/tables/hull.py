"""[hull] of a ship file: the shape for contact and pictures."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator

from .table import ESTIMATED, NotNegative, Positive, Table, Vector

__all__ = ["HullTable"]

Axis = Literal["+x", "-x", "+y", "-y", "+z", "-z"]

MESH_KEYS = frozenset(
    {"file", "unit", "scale", "forward", "up", "origin", "weld", "fill_holes", "convex_hull", "max_parts"}
)
"""Keys of [hull] that go with shape = "mesh" only."""


class HullTable(Table):
    """[hull]: the shape that touches other ships. ship/hull/hull.py has a drawing."""

    shape: Literal["parametric", "box", "mesh"] = Field(
        description='"parametric", "box" or "mesh"; without it, "parametric"', json_schema_extra=ESTIMATED
    )
    depth: Positive = Field(description="the depth, keel to deck [m]", json_schema_extra=ESTIMATED)
    bow_length: NotNegative = Field(
        default=0.0, description="the length of the bow from its shoulder to the stem [m]", json_schema_extra=ESTIMATED
    )
    bow_exponent: Annotated[float, Field(ge=1.0, le=10.0)] = Field(
        default=2.0, description="p of the deck line y = B/2 (1 - s^p); from 1, a wedge, to 10, almost blunt"
    )
    stem_rake_deg: Annotated[float, Field(ge=0.0, le=60.0)] = Field(
        default=0.0, description="the stem's rake from the vertical [deg], top forward"
    )
    stern_length: NotNegative = Field(
        default=0.0, description="the length over which the stern narrows [m]", json_schema_extra=ESTIMATED
    )
    stern_exponent: Annotated[float, Field(ge=1.0, le=10.0)] = Field(
        default=2.0, description="p of the stern's deck line; as bow_exponent"
    )
    transom_fraction: Annotated[float, Field(gt=0.0, le=1.0)] = Field(default=0.5, description="transom breadth / B")
    flare_deg: Annotated[float, Field(ge=0.0, le=60.0)] = Field(
        default=0.0, description="the bow's flare above the waterline [deg] from the vertical"
    )
    bilge: NotNegative = Field(default=0.0, description="the height and breadth of the chamfer at the keel [m]")
    trim_x: float = Field(default=0.0, description="the shift of the whole hull forward of CO [m]")
    file: Annotated[str, Field(min_length=1)] | None = Field(
        default=None, description="the hull's .obj, .stl, .dae, .glb or .gltf file, relative to the ship file"
    )
    unit: Literal["m", "cm", "mm", "ft", "in"] | None = Field(
        default=None, description="the unit of length of the mesh file; without it, what a DAE file states, else m"
    )
    scale: Positive | None = Field(default=None, description="metres per unit of the mesh file, instead of unit")
    forward: Axis = Field(default="+x", description="the mesh file's axis that points to the bow")
    up: Axis | None = Field(
        default=None,
        description="the mesh file's axis that points up; without it, what a DAE file states, +y in glTF, else +z",
    )
    origin: Vector = Field(
        default=[0.0, 0.0, 0.0], validate_default=True, description="CO in the mesh file's coordinates and unit"
    )
    weld: Positive | None = Field(
        default=None,
        description="the distance [m] within which vertices of open edges are joined; without it, 1e-5 of the length",
    )
    fill_holes: bool = Field(default=False, description="whether holes of the mesh, such as an open deck, are closed")
    convex_hull: bool = Field(default=False, description="whether the mesh's convex hull is taken instead of the mesh")
    max_parts: Annotated[int, Field(ge=1, le=64)] = Field(
        default=16, description="the most convex parts that the mesh is cut into"
    )

    @model_validator(mode="after")
    def _check_mesh_keys(self) -> HullTable:
        if self.shape != "mesh":
            if others := sorted(self.model_fields_set & MESH_KEYS):
                raise ValueError(f'[hull] shape = "{self.shape}" has no {", ".join(others)}: only "mesh" has')
            return self
        if others := sorted(self.model_fields_set - MESH_KEYS - {"shape", "depth"}):
            raise ValueError(f'[hull] shape = "mesh" has no {", ".join(others)}: the file has the whole shape')
        if self.file is None:
            raise ValueError(
                '[hull] file is missing: shape = "mesh" needs the name of a mesh file (.obj, .stl, .dae, .glb)'
            )
        if self.scale is not None and self.unit is not None:
            raise ValueError(f'[hull] unit = "{self.unit}" and scale = {self.scale} are two units: remove one')
        if self.up is not None and self.forward[1] == self.up[1]:
            raise ValueError(
                f'[hull] forward = "{self.forward}" and up = "{self.up}" lie along one axis: name two different ones'
            )
        return self

    @model_validator(mode="after")
    def _check_shape(self) -> HullTable:
        if self.shape == "mesh":
            return self
        if self.shape == "box":
            others = sorted(self.model_fields_set - {"shape", "depth"})
            if others:
                raise ValueError(
                    f'[hull] shape = "box" has no {", ".join(others)}: give depth only, or shape = "parametric"'
                )
        else:
            problems = [
                f'[hull] {key} = {getattr(self, key)} m must be greater than 0 with shape = "parametric": '
                f"it is {type(self).model_fields[key].description}; without the key, it is estimated"
                for key in ("bow_length", "stern_length")
                if getattr(self, key) <= 0.0
            ]
            if problems:
                raise ValueError("\n".join(problems))
        return self
