"""What viser leaves to scripts of the page: its title, and which tab of the panel is open."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any


def set_title(client: Any, title: str) -> None:
    """The name of the page in the browser."""
    _run(client, f"document.title = {json.dumps(title)};")


def open_tab(client: Any, name: str) -> None:
    """As if its name were clicked, in a narrow window, and Enter pressed there, in a wide one: in
    each the other does nothing if a script does it.
    """
    tabs = "document.querySelectorAll('[role=tab]')"
    wanted = f"tab => tab.innerText.trim() === {json.dumps(name)}"
    enter = "tab.dispatchEvent(new KeyboardEvent('keydown', {key: 'Enter', bubbles: true}))"
    _run(client, f"[...{tabs}].filter({wanted}).forEach(tab => {{ tab.click(); {enter}; }});")


def follow_tab(client: Any, name: str, tell: Callable[[bool], object]) -> None:
    """Tell whether a tab is open, soon after that changes; until told, it counts as open.

    Only the page knows. There a script ticks a checkbox, which is not displayed, as the tab is.
    """
    box = client.gui.add_checkbox(f"{name} is open", True)
    uuid = box._impl.uuid
    hidden = f'div:has(> .mantine-Flex-root input[id="{uuid}"]) {{ display: none }}'
    client.gui.add_html(f"<style>{hidden}</style>")
    box.on_update(lambda _: tell(box.value))
    _run(client, FOLLOW % (json.dumps(uuid), json.dumps(name)))


# By the clock, so that a tick which the page or viser has undone is set again.
FOLLOW = """setInterval(() => {
    const box = document.getElementById(%s);
    const tabs = [...document.querySelectorAll('[role=tab]')];
    const tab = tabs.find(tab => tab.textContent.trim() === %s);
    if (box && tab && box.checked !== (tab.ariaSelected === 'true')) box.click();
}, 200);"""


def _run(client: Any, script: str) -> None:
    from viser._messages import RunJavascriptMessage

    client.gui._websock_interface.queue_message(RunJavascriptMessage(script))
