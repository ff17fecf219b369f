"""Runs by other hands: a finished run's folder with its ships renamed, or with its collision repeated."""

from __future__ import annotations

import csv
import json
import shutil
from pathlib import Path
from typing import Any

__all__ = ["with_many_collisions", "with_names"]


def with_names(run: Path, out: Path, names: dict[str, str]) -> Path:
    """A copy of a run in which bodies have other names."""
    shutil.copytree(run, out)

    def renamed(data: Any) -> Any:
        if isinstance(data, dict):
            return {names.get(key, key): renamed(value) for key, value in data.items()}
        if isinstance(data, list):
            return [renamed(value) for value in data]
        return names.get(data, data) if isinstance(data, str) else data

    for name in ("bodies.json", "events.json", "summary.json"):
        (out / name).write_text(json.dumps(renamed(json.loads((out / name).read_text()))) + "\n")
    for name in ("states.csv", "contacts.csv"):
        with (out / name).open(newline="") as file:
            rows = list(csv.reader(file))
        for old, new in names.items():
            rows[0] = [new + cell[len(old) :] if cell.startswith(f"{old}.") else cell for cell in rows[0]]
        with (out / name).open("w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows([names.get(cell, cell) for cell in row] for row in rows)
    return out


def with_many_collisions(run: Path, out: Path, count: int) -> Path:
    """A copy of a run whose first collision and scratch happen `count` times, evenly over the run."""
    shutil.copytree(run, out)
    events = json.loads((out / "events.json").read_text())
    with (out / "contacts.csv").open(newline="") as file:
        header, *rows = list(csv.reader(file))
    collision, scratch = events["collisions"][0], events["scratches"][0]
    end = float((out / "states.csv").read_text().rstrip().rpartition("\n")[2].split(",")[0])
    again: dict[str, list[Any]] = {"collisions": [], "scratches": []}
    repeated = [header]
    mine = [row for row in rows if row[header.index("scratch")] == str(scratch["id"])]
    for number in range(1, count + 1):
        start = round(end * number / (count + 1), 3)
        shift = start - scratch["start"]
        again["collisions"].append({**collision, "id": number, "start": start, "end": start})
        times = [min(end, time + shift) for time in scratch["time"]]
        line = {"id": number, "collision": number, "start": start, "end": times[-1], "time": times}
        again["scratches"].append({**scratch, **line})
        for row in mine:
            changed = dict(zip(header, row, strict=True)) | {"time": repr(float(row[0]) + shift)}
            repeated.append(list((changed | {"impact": str(number), "scratch": str(number)}).values()))
    (out / "events.json").write_text(json.dumps(again) + "\n")
    with (out / "contacts.csv").open("w", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows(repeated)
    return out
