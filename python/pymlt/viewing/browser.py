"""What viser leaves to scripts of the page: its title, and which tab of the panel is open."""

from __future__ import annotations

import json
from typing import Any


def set_title(client: Any, title: str) -> None:
    """The name of the page in the browser."""
    _run(client, f"document.title = {json.dumps(title)};")


def open_tab(client: Any, name: str) -> None:
    """As if Enter were pressed on its name: a click that a script makes does nothing there."""
    tabs = "document.querySelectorAll('[role=tab]')"
    wanted = f"tab => tab.innerText.trim() === {json.dumps(name)}"
    enter = "new KeyboardEvent('keydown', {key: 'Enter', bubbles: true})"
    _run(client, f"[...{tabs}].filter({wanted}).forEach(tab => tab.dispatchEvent({enter}));")


def _run(client: Any, script: str) -> None:
    from viser._messages import RunJavascriptMessage

    client.gui._websock_interface.queue_message(RunJavascriptMessage(script))
