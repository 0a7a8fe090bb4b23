"""Brings the tables of flags in command-line.md up to date with what the commands take.

Run it after one has changed (python docs/make_command_line.py); a test compares the page with what
this makes.
"""

import re
from pathlib import Path

from pymlt.cli import COMMANDS
from pymlt.cli.common import FLAGS, Parser

PAGE = Path(__file__).with_name("command-line.md")


def table(command: str) -> str:
    parser = Parser(add_help=False)
    COMMANDS[command].add_arguments(parser)
    lines = ["| flag | |", "|---|---|"]
    for action in parser._actions:
        if action.option_strings:
            spelling = f"{', '.join(action.option_strings)} {action.metavar or ''}".strip()
            shared = command != "render" or action.dest in FLAGS
            only = "" if shared else " (`pymlt` only)"
            lines.append(
                f"| `{spelling}` | {(action.help % {}).replace('|', chr(92) + '|')}{only} |"
            )
    return "\n".join(lines)


def page(text: str) -> str:
    """The page with fresh tables between the marks."""
    return re.sub(
        r"(<!-- flags: (\w+) -->\n).*?(<!-- end -->)",
        lambda m: f"{m[1]}{table(m[2])}\n{m[3]}",
        text,
        flags=re.DOTALL,
    )


if __name__ == "__main__":
    PAGE.write_text(page(PAGE.read_text()))
