"""Brings the table of flags in command-line.md up to date with cpp/app/flags.cpp.

Run it after one has changed (python docs/make_command_line.py); a test compares the page with what
this makes.
"""

import re
from pathlib import Path

from pymlt import _core

PAGE = Path(__file__).with_name("command-line.md")


def table() -> str:
    lines = ["| flag | |", "|---|---|"]
    for flag in _core.render_flags():
        if flag.spelling.startswith("-"):
            spelling = f"{flag.spelling.replace(',', ', ')} {flag.metavar}".strip()
            lines.append(f"| `{spelling}` | {flag.help.replace('|', chr(92) + '|')} |")
    return "\n".join(lines)


def page(text: str) -> str:
    """The page with a fresh table between the marks."""
    return re.sub(
        r"(<!-- flags -->\n).*?(<!-- end -->)",
        lambda m: f"{m[1]}{table()}\n{m[2]}",
        text,
        flags=re.DOTALL,
    )


if __name__ == "__main__":
    PAGE.write_text(page(PAGE.read_text()))
