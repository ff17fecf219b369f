"""One clear line from a failed validation.

pydantic reports a tree of problems. A user needs all of them at once, and of each: which key, what was wrong, its
value, the limit, the remedy. The remedy is the description of the field, so it is written once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from difflib import get_close_matches
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel, ValidationError

__all__ = ["describe_error", "describe_problems", "join_problems", "suggest", "suggest_or_list"]

MOST_SHOWN = 12
"""Problems that one line tells; a file of another kind has hundreds."""

Place = tuple[int | str, ...]

_LONGEST_VALUE = 60
"""Characters of a value that are shown; a pasted 6x6 matrix would hide the message."""


def describe_error(error: ValidationError, model: type[BaseModel]) -> str:
    """One line for the user about `error`, raised while validating data against `model`; without the file's name."""
    return join_problems(describe_problems(error, model))


def describe_problems(
    error: ValidationError, model: type[BaseModel], may_lack: Callable[[Place], bool] = lambda place: False
) -> list[str]:
    """A line for each problem. Keys that are missing where `may_lack` holds are left out.

    Unknown keys come first: a misspelt key is usually the cause of a missing one.
    """
    found = [p for p in error.errors(include_url=False) if p["type"] != "missing" or not may_lack(p["loc"])]
    found.sort(key=lambda problem: problem["type"] != "extra_forbidden")  # keeps the order of equals
    return [line for problem in found for line in _describe(problem, model).split("\n")]


def join_problems(problems: Sequence[str]) -> str:
    """The problems in one line, numbered where they are several."""
    lines = list(dict.fromkeys(problems))
    if len(lines) == 1:
        return lines[0]
    said = "; ".join(f"({number}) {line}" for number, line in enumerate(lines[:MOST_SHOWN], 1))
    more = len(lines) - MOST_SHOWN
    return f"{len(lines)} problems: {said}" + (f"; and {more} more" if more > 0 else "")


def suggest(word: str, known: Sequence[str]) -> str:
    """' did you mean X?' or nothing. The dashes of options are left out: they would make all options alike."""
    word, words = word.lower().lstrip("-"), {k.lower().lstrip("-"): k for k in known}
    near = get_close_matches(word, words, n=1, cutoff=0.6) or [k for k in words if len(word) > 2 and k.startswith(word)]
    return f" did you mean {words[near[0]]}?" if near else ""


def suggest_or_list(word: str, known: Sequence[str], otherwise: str = "") -> str:
    """' did you mean X?', or ' known: ' and all words where none is near; and what else may be done."""
    if near := suggest(word, known):
        return f"{near}{otherwise and ' Else '}{otherwise}"
    return f" known: {', '.join(known)}{otherwise and '; or '}{otherwise}"


def _describe(problem: Any, model: type[BaseModel]) -> str:
    kind, loc, value = problem["type"], problem["loc"], problem["input"]
    if kind == "extra_forbidden":
        table = next(_list_models(_find_annotation(model, loc[:-1])), model)
        known = list(table.model_fields)
        return f"{_name_place(loc)} is not a known key:{suggest_or_list(str(loc[-1]), known)}"
    what = _find_description(model, loc)
    if kind == "missing":
        return f"{_name_place(loc)} is missing: give {what or 'its value'}"
    message = problem["msg"].removeprefix("Value error, ")
    if kind == "value_error":
        if isinstance(value, dict) and len(loc) > 1 and not message.startswith("["):  # a check of a whole table
            return f"[{'.'.join(map(str, loc))}] {message}"
        return f"{_name_place(loc)}: {message}" if loc and not message.startswith("[") else message
    said = _say_plainly(kind, message, problem.get("ctx", {}))
    return f"{_name_place(loc)} = {_shorten(value)} {said}" + (f": it is {what}" if what else "")


_PLAIN = {
    "model_type": "must be a table", "model_attributes_type": "must be a table", "dict_type": "must be a table",
    "mapping_type": "must be a table",
    "float_type": "must be a number", "float_parsing": "must be a number",
    "int_type": "must be a whole number", "int_parsing": "must be a whole number",
    "int_from_float": "must be a whole number",
    "bool_type": "must be true or false", "bool_parsing": "must be true or false",
    "string_type": "must be text in quotes",
    "list_type": "must be a list in brackets", "tuple_type": "must be a list in brackets",
}  # fmt: skip
"""What a message says for pydantic's kinds of problem, in the words of a TOML file."""


def _say_plainly(kind: str, message: str, context: dict[str, Any]) -> str:
    """The rest of the sentence that begins with a key and its value; pydantic's own words where they are plain."""
    if kind in _PLAIN:
        return _PLAIN[kind]
    if kind in ("too_short", "too_long"):
        least = kind == "too_short"
        limit, given = context["min_length" if least else "max_length"], context["actual_length"]
        bound = f"at {'least' if least else 'most'} {limit} value{'' if limit == 1 else 's'}"
        return f"must have {bound}, it has {given}"
    if kind == "string_too_short":
        return "must not be empty"
    said = message.replace("Input should", "should").replace("should be", "must be").replace("should have", "must have")
    return f"{said[0].lower()}{said[1:]}"


def _shorten(value: object) -> str:
    text = repr(value)
    return text if len(text) <= _LONGEST_VALUE else text[: _LONGEST_VALUE - 3] + "..."


def _name_place(loc: tuple[int | str, ...]) -> str:
    """('added_mass', 'M_A', 2, 3) as '[added_mass] M_A[2][3]'."""
    if len(loc) == 1:
        return f"[{loc[0]}]"
    first_index = next((i for i, part in enumerate(loc) if isinstance(part, int)), len(loc))
    key = max(first_index - 1, 1)
    inner = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in loc[key:])
    return f"[{'.'.join(map(str, loc[:key]))}] {inner.removeprefix('.')}"


def _find_description(model: type[BaseModel], loc: tuple[int | str, ...]) -> str:
    named = [i for i, part in enumerate(loc) if isinstance(part, str)]
    if not named:
        return ""
    last = named[-1]
    for table in _list_models(_find_annotation(model, loc[:last])):
        field = table.model_fields.get(str(loc[last]))
        if field is not None:
            return field.description or ""
    return ""


def _find_annotation(model: Any, loc: tuple[int | str, ...]) -> Any:
    """Type annotation of what stands at `loc` below `model`, None when the path leaves the models."""
    annotation: Any = model
    for part in loc:
        annotation = next(_find_below(annotation, part), None)
    return annotation


def _find_below(annotation: Any, part: int | str) -> Iterator[Any]:
    for member in _list_members(annotation):
        if isinstance(member, type) and issubclass(member, BaseModel):
            if part in member.model_fields:
                yield member.model_fields[str(part)].annotation
        elif get_origin(member) in (dict, list, tuple):
            yield get_args(member)[-1]


def _list_members(annotation: Any) -> list[Any]:
    """A union's members, an Annotated's type, else the annotation itself."""
    if get_origin(annotation) is Annotated:
        return _list_members(get_args(annotation)[0])
    if get_origin(annotation) in (Union, UnionType):
        return [m for arg in get_args(annotation) for m in _list_members(arg)]
    return [annotation]


def _list_models(annotation: Any) -> Iterator[type[BaseModel]]:
    for member in _list_members(annotation):
        if isinstance(member, type) and issubclass(member, BaseModel):
            yield member
