"""Brings the tables of parameters in integrators.md up to date with the schemas.

Run it after one has changed (python docs/make_integrators.py); a test compares the page with what
this makes.
"""

import re
from pathlib import Path

from pymlt import _core

PAGE = Path(__file__).with_name("integrators.md")


def default_of(parameter: dict) -> str:
    value = parameter["default"]
    if isinstance(value, bool):
        return str(value).lower()
    return "" if value is None else str(value)


def table(name: str) -> str:
    lines = ["| parameter | default | |", "|---|---|---|"]
    for p in _core.schema("integrator", name)["parameters"]:
        choices = f" One of {', '.join(p['choices'])}." if p["choices"] else ""
        doc = p["doc"].replace("|", "\\|")
        lines.append(f"| `{p['name']}` | {default_of(p)} | {doc}{choices} |")
    return "\n".join(lines)


def page(text: str) -> str:
    """The page with a fresh table between each pair of marks."""
    return re.sub(
        r"(<!-- parameters: (\w+) -->\n).*?(<!-- end -->)",
        lambda m: f"{m[1]}{table(m[2])}\n{m[3]}",
        text,
        flags=re.DOTALL,
    )


if __name__ == "__main__":
    PAGE.write_text(page(PAGE.read_text()))
