"""Reads OpenSceneGraph's text format, written against its serialisers and not against our writer.

A node is {"class": ..., "id": ..., property: value, ...}. The value of a property is the list of words behind it, or a
list of nodes, or a node. A node that is only an id is a reference, and is replaced by what it refers to.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

Node = dict[str, Any]
_WORD = re.compile(r'"(?:[^"\\]|\\.)*"|[{}]|[^\s{}"]+')


def read(path: Path) -> Node:
    """The root node of a file."""
    lines = path.read_text().splitlines()
    assert lines[:3] == ["#Ascii Scene", "#Version 161", "#Generator OpenSceneGraph 3.6.5"]
    words = _WORD.findall("\n".join(lines[3:]))
    node, end = _node(words, 0, {})
    assert end == len(words), "something stands behind the root"
    return node


def _node(words: list[str], at: int, known: dict[str, Node]) -> tuple[Node, int]:
    kind = words[at]
    assert kind.startswith(("osg::", "osgParticle::")), kind
    assert words[at + 1 : at + 3] == ["{", "UniqueID"], words[at : at + 5]
    number, at = words[at + 3], at + 4
    node: Node = {"class": kind, "id": number}
    while words[at] != "}":
        node[words[at]], at = _value(words, at + 1, known)
    if number in known:
        assert len(node) == 2, f"{kind} {number} is written twice"
        assert known[number]["class"] == kind
        return known[number], at + 1
    known[number] = node
    return node, at + 1


def _value(words: list[str], at: int, known: dict[str, Node]) -> tuple[Any, int]:
    """Words up to the next property, which has a capital letter first and small ones; a braced block; or objects."""
    head: list[str] = []
    while words[at] not in "{}" and not (head and _is_property(words[at]) and not _continues(head)):
        head.append(words[at])
        at += 1
    if words[at] != "{":
        return head, at
    at += 1
    if words[at].startswith(("osg::", "osgParticle::")):
        nodes = []
        while words[at] != "}":
            if words[at] == "Value":  # of an attribute: its mode
                at += 2
                continue
            node, at = _node(words, at, known)
            nodes.append(node)
        if head and head[0].isdigit():
            assert len(nodes) == int(head[0]), f"{len(nodes)} instead of {head[0]}"
            return nodes, at + 1
        return nodes[0], at + 1
    block, depth = [], 1
    while depth:
        depth += {"{": 1, "}": -1}.get(words[at], 0)
        block.append(words[at])
        at += 1
    return [*head, *block[:-1]], at


def _is_property(word: str) -> bool:
    return word == "vector" or (word[0].isupper() and not word.isupper() and "_" not in word)


def _continues(head: list[str]) -> bool:
    """Front and Back stand within a material's colours."""
    return head[0] == "TRUE"


def walk(node: Node) -> Iterator[Node]:
    """A node and all its children."""
    yield node
    for child in node.get("Children", []):
        yield from walk(child)


def name(node: Node) -> str:
    """The node's name, without marks."""
    return str(node.get("Name", ['""'])[0])[1:-1].replace('\\"', '"').replace("\\\\", "\\")


def numbers(value: list[str]) -> np.ndarray:
    """Words as numbers."""
    return np.array([float(word) for word in value])


def vertices(array: Node) -> np.ndarray:
    """Rows of a Vec3Array or Vec4Array."""
    count, *rest = numbers(array["vector"])
    return rest_of(rest, int(array["class"][8]), int(count))


def rest_of(values: list[float], width: int, count: int) -> np.ndarray:
    """Numbers as rows, as many as were told."""
    rows = np.array(values).reshape(-1, width)
    assert len(rows) == count
    return rows


def path(transform: Node) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times, positions and quaternions of the animation path of a MatrixTransform."""
    animation = transform["UpdateCallback"]["AnimationPath"]
    assert animation["LoopMode"] == ["NO_LOOPING"]
    words = animation["TimeControlPointMap"]
    count = int(words[0])
    times, places, turns = [], [], []
    i = 1
    for _ in range(count):
        assert words[i] == "Time"
        times.append(float(words[i + 1]))
        assert words[i + 2 : i + 4] == ["{", "Position"]
        places.append([float(w) for w in words[i + 4 : i + 7]])
        assert words[i + 7] == "Rotation"
        turns.append([float(w) for w in words[i + 8 : i + 12]])
        assert words[i + 12 : i + 17] == ["Scale", "1", "1", "1", "}"]
        i += 17
    assert i == len(words)
    return np.array(times), np.array(places), np.array(turns)
