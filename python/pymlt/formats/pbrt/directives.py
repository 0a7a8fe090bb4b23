"""The directives of a pbrt file, one method for each: blocks, transforms, and other files."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from ... import _core
from .. import limits
from ..imported import Imported
from ..missing import ABSENT
from .motion import ACTIVE
from .params import Params
from .spectrum_files import with_files
from .state import ATTRIBUTES, TRANSFORMS, State
from .tokens import Parameter, Token, Words
from .version import foreign

if TYPE_CHECKING:
    import numpy as np

BEGIN = ("AttributeBegin", "TransformBegin")
END = ("AttributeEnd", "TransformEnd")
_VALUES = ("true", "false")


class Directives:
    """One file, with those that it includes, while it is read."""

    version = 4

    def __init__(self, path: Path, made: Imported):
        import numpy as np

        self._folder = path.parent
        self._made = made
        self._words = Words(path)
        self._state = State([np.eye(4), np.eye(4)])
        self._saved: list[State] = []
        self._spaces: dict[str, list[np.ndarray]] = {}
        self._times = (0.0, 1.0)  #: of the two transforms
        self._last: Token | None = None

    def read(self) -> None:
        while self._words.peek() is not None:
            self._last = directive = self._words.take()
            self._made.place = directive.place
            try:
                self._directive(directive)
            except (_core.SceneError, _core.FileError) as error:
                if str(error).endswith(ABSENT):
                    self._made.missing.setdefault(str(error), directive.place)
                    continue
                if re.match(r".*:\d+: ", str(error)):
                    raise
                raise type(error)(f"{directive.place}: {error}") from None
            except _core.Error:
                raise
            except limits.CONTRADICTIONS as error:
                raise directive.error(f"{directive.text} makes no sense: {error!s:.200}") from None
        if self._saved and self._last is not None:
            raise self._last.error("an AttributeBegin has no AttributeEnd")
        self._made.place = ""

    def _directive(self, directive: Token) -> None:
        name = directive.text
        method = getattr(self, f"_on_{re.sub('(?<!^)(?=[A-Z])', '_', name).lower()}", None)
        if directive.quoted:
            raise directive.error(f"a directive is expected, not {name!r}")
        if name in TRANSFORMS:
            self._state.transform(directive, self._words)
        elif name in BEGIN:
            self._begin(directive)
        elif name in END:
            self._end(directive)
        elif method is not None:
            method(directive)
        else:
            self._leave_out(directive)

    def _params(self, directive: Token) -> Params:
        kind = self._words.text(directive)
        return self._given(directive, kind, self._words.parameters())

    def _typed(self, directive: Token, what: str) -> Params:
        """The parameters of a directive that gives its kind as one of them."""
        given = self._words.parameters()
        kind = given.pop("type", None)
        if kind is None:
            raise directive.error(f'{what} needs a "string type"')
        return self._given(directive, kind.values[0], given)

    def _given(self, directive: Token, kind: str, given: dict[str, Parameter]) -> Params:
        for name in foreign(self.version, directive.text, kind, given):
            said = f"{name!r} is of another version, and the file is read as one of pbrt"
            self._made.warn(f"{said}-v{self.version}", directive.place)
        given, defaults = (
            with_files(found, directive, self._folder, self._made)
            for found in (given, self._defaults(directive))
        )
        return Params(directive, kind, given, self._made, defaults)

    def _defaults(self, directive: Token) -> dict[str, Parameter]:
        """What Attribute says of directives of this kind."""
        return self._state.defaults.get(ATTRIBUTES.get(directive.text, ""), {})

    def _leave_out(self, directive: Token) -> None:
        """What is not known, with all that follows up to the next directive."""
        if not directive.text[:1].isalpha():
            raise directive.error(f"a directive is expected, not {directive.text!r}")
        self._made.warn(f"{directive.text} is left out", directive.place)
        while (token := self._words.peek()) is not None:
            if not token.quoted and token.text[:1].isalpha() and token.text not in _VALUES:
                return
            self._words.take()

    def _begin(self, directive: Token) -> None:
        if len(self._saved) >= limits.NESTING:
            raise directive.error(f"blocks are nested more than {limits.NESTING} deep")
        self._saved.append(self._state.copy())

    def _end(self, directive: Token) -> None:
        if not self._saved:
            raise directive.error(f"{directive.text} ends nothing")
        saved = self._saved.pop()
        if directive.text == "TransformEnd":
            self._state.matrices, self._state.active = saved.matrices, saved.active
        else:
            self._state = saved

    def _on_attribute(self, directive: Token) -> None:
        self._state.attribute(directive, self._words)

    def _on_world_begin(self, directive: Token) -> None:
        import numpy as np

        self._state.matrices, self._state.active = [np.eye(4), np.eye(4)], ACTIVE["All"]
        self._spaces["world"] = list(self._state.matrices)

    def _on_world_end(self, directive: Token) -> None:
        """Ends files of pbrt-v3."""

    # ---- transforms, files ---------------------------------------------------------------------

    def _on_reverse_orientation(self, directive: Token) -> None:
        self._state.reversed = not self._state.reversed

    def _on_coordinate_system(self, directive: Token) -> None:
        self._spaces[self._words.text(directive)] = list(self._state.matrices)

    def _on_coord_sys_transform(self, directive: Token) -> None:
        name = self._words.text(directive)
        if name not in self._spaces:
            raise directive.error(f"there is no coordinate system {name!r}")
        self._state.matrices = list(self._spaces[name])

    def _on_active_transform(self, directive: Token) -> None:
        name = self._words.take(directive)
        if name.text not in ACTIVE:
            valid = ", ".join(ACTIVE)
            raise name.error(f"ActiveTransform {name.text!r} is not known; valid are: {valid}")
        self._state.active = ACTIVE[name.text]

    def _on_transform_times(self, directive: Token) -> None:
        start, end = self._words.numbers(2, directive)
        if not start < end:
            raise directive.error("the second of the TransformTimes should be later than the first")
        self._times = start, end

    def _on_include(self, directive: Token) -> None:
        self._words.include(self._words.take(directive))

    _on_import = _on_include
