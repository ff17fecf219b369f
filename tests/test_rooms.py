"""The rooms of the package: each imports only from the floors below it, and nothing imports in a circle.

Read from the source text by `ast`, so that imports inside functions count too. import-linter, configured in
pyproject.toml, says the same in CI; here the floors stand once more, as a newcomer would draw them.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterable, Iterator, Mapping
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import shipcollision_fmu

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

PACKAGE = Path(shipcollision_fmu.__file__).parent
NAME = PACKAGE.name

FLOORS = (
    {"cli"},
    {"live", "study"},
    {"packaging", "batch"},
    {"cosim"},
    {"encounters", "results", "compliance", "show"},
    {"scenario"},
    {"fmi"},
    {"manoeuvring", "collision"},
    {"ship"},
    {"toolchain"},
    {"files"},
    {"errors"},
)
"""From the roof down. Rooms of one floor do not import each other."""


def dotted(path: Path) -> str:
    """Name of a module, "shipcollision_fmu.ship.frames"; a package has that of its folder."""
    parts = (NAME, *path.relative_to(PACKAGE).with_suffix("").parts)
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = {dotted(path): path for path in sorted(PACKAGE.rglob("*.py"))}


def base_of(module: str, node: ast.ImportFrom) -> str:
    """The module from which a statement imports, as an absolute name."""
    if node.level == 0:
        return node.module or ""
    package = module if MODULES[module].name == "__init__.py" else module.rpartition(".")[0]
    above = package.split(".")[: len(package.split(".")) - node.level + 1]
    return ".".join([*above, *([node.module] if node.module else [])])


def walk_statements(node: ast.AST) -> Iterator[ast.AST]:
    """All statements below a node: imports are none of an expression, of which there are five times as many nodes."""
    for child in ast.iter_child_nodes(node):
        if not isinstance(child, ast.expr):
            yield child
            yield from walk_statements(child)


def imports_of(module: str) -> Iterator[str]:
    """The modules of the package that a module imports, also inside functions."""
    for node in walk_statements(ast.parse(MODULES[module].read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            base = base_of(module, node)
            names = [name if (name := f"{base}.{alias.name}") in MODULES else base for alias in node.names]
        else:
            continue
        yield from (name for name in names if name in MODULES)


GRAPH = {module: set(imports_of(module)) - {module} for module in MODULES}


def room(module: str) -> str:
    """The top-level part of the package that a module is in; "" for the package itself."""
    return module.split(".")[1] if "." in module else ""


def faults(graph: Mapping[str, Iterable[str]]) -> list[str]:
    """Imports that do not go down, in words."""
    floor = {name: level for level, names in enumerate(FLOORS) for name in names}
    return [
        f"{module} imports {target}"
        for module, targets in graph.items()
        for target in targets
        if room(module) in floor and room(target) in floor and room(module) != room(target)
        if floor[room(target)] <= floor[room(module)]
    ]


def circle(graph: Mapping[str, Iterable[str]], depth: int) -> list[str]:
    """One circle among the parts of the package that lie `depth` folders deep, [] if there is none.

    A package's own file is what its parts are imported through, so it is no part of a circle.
    """
    cut: dict[str, set[str]] = {}
    for module, targets in graph.items():
        own = ".".join(module.split(".")[: depth + 1])
        cut.setdefault(own, set()).update(".".join(t.split(".")[: depth + 1]) for t in targets)
    packages = {name for name in cut if name in MODULES and MODULES[name].name == "__init__.py"}
    leaves = {name for name in packages if name.count(".") < depth}
    plain = {a: {b for b in targets - {a} if b not in leaves} for a, targets in cut.items() if a not in leaves}
    try:
        tuple(TopologicalSorter(plain).static_order())
    except CycleError as error:
        found: list[str] = error.args[1]
        return found
    return []


def test_every_room_has_its_floor() -> None:
    rooms = {path.stem for path in PACKAGE.iterdir() if path.suffix == ".py" or (path / "__init__.py").is_file()}
    assert set().union(*FLOORS) == rooms - {"__init__", "__main__"}


def test_imports_go_down() -> None:
    assert faults(GRAPH) == []


def test_an_import_that_goes_up_is_found() -> None:
    up = {f"{NAME}.ship.frames": {f"{NAME}.fmi.names"}, f"{NAME}.show.page": {f"{NAME}.results.record"}}
    assert len(faults(up)) == 2


@pytest.mark.parametrize("name", sorted(set().union(*FLOORS) - {"files", "errors", "cli", "ship"}))
def test_the_map_of_a_room_names_what_it_imports(name: str) -> None:
    """files and errors are for all, and not named."""
    text = ast.get_docstring(ast.parse(MODULES[f"{NAME}.{name}"].read_text(encoding="utf-8"))) or ""
    used = {room(target) for module in GRAPH if room(module) == name for target in GRAPH[module]}
    assert [other for other in sorted(used - {"", name, "files", "errors"}) if other not in text] == []


@pytest.mark.parametrize("depth", [1, 2, 3])
def test_nothing_imports_in_a_circle(depth: int) -> None:
    assert circle(GRAPH, depth) == []


def test_a_circle_is_found() -> None:
    assert circle({"a.b.c": {"a.d.e"}, "a.d.f": {"a.b.g"}}, 1)
    assert not circle({"a.b.c": {"a.d.e"}, "a.d.f": {"a.b.g"}}, 2)


def test_import_linter_holds_the_same_floors() -> None:
    project = tomllib.loads((PACKAGE.parent / "pyproject.toml").read_text(encoding="utf-8"))
    contracts = project["tool"]["importlinter"]["contracts"]
    layers = next(contract["layers"] for contract in contracts if contract["type"] == "layers")
    assert [set(layer.split(" | ")) for layer in layers] == list(FLOORS)
    assert any(contract["type"] == "acyclic_siblings" for contract in contracts)
