"""The words of a pbrt-v4 file (https://pbrt.org/fileformat-v4), and lists of parameters."""

from __future__ import annotations

import gzip
import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from ... import _core

PATTERN = re.compile(r'\s+|#[^\n]*|"((?:[^"\\\n]|\\.)*)"|([\[\]])|([^\s"\[\]#]+)|(.)')
NUMBERS = {"integer": 1, "float": 1, "point2": 2, "vector2": 2, "point3": 3, "vector3": 3}
NUMBERS |= {"normal3": 3, "point": 3, "vector": 3, "normal": 3, "rgb": 3, "blackbody": 1}


class Token(NamedTuple):
    """A word, and where it stands."""

    text: str
    quoted: bool
    file: Path
    line: int

    def error(self, message: str) -> _core.SceneError:
        return _core.SceneError(f"{self.file}:{self.line}: {message}")


class Parameter(NamedTuple):
    """A value with the type that the file gives it."""

    kind: str  #: "float", "rgb", "texture", ...
    values: list[Any]  #: floats, texts or booleans


def tokens(path: Path) -> Iterator[Token]:
    """The words of a file, which may be compressed (.gz). Raises FileError, SceneError."""
    try:
        content = path.read_bytes()
        content = gzip.decompress(content) if path.suffix == ".gz" else content
    except (OSError, EOFError) as error:
        raise _core.FileError(f"{path}: cannot be read: {error}") from None
    line = 1
    text = content.decode("utf-8", "replace")
    for match in PATTERN.finditer(text):
        quoted, bracket, word, other = match.groups()
        token = Token(quoted or bracket or word or "", quoted is not None, path, line)
        if other:
            raise token.error(f"{other!r} begins nothing that ends on this line")
        if quoted is not None or bracket or word:
            yield token
        line += match[0].count("\n")


class Words:
    """The words of a file with the files that it includes, one after the other."""

    def __init__(self, path: Path):
        self._root = path.parent
        self._open = [tokens(path)]
        self._next: Token | None = None

    def include(self, name: Token) -> None:
        """Goes on with another file; names are relative to the first one."""
        if len(self._open) > 15:
            raise name.error("files include each other more than 15 deep")
        self._open.append(tokens(self._root / name.text))

    def peek(self) -> Token | None:
        """The next word, which stays; None at the end."""
        while self._next is None and self._open:
            self._next = next(self._open[-1], None)
            if self._next is None:
                self._open.pop()
        return self._next

    def take(self, after: Token | None = None) -> Token:
        """The next word. Raises SceneError if there is none."""
        token = self.peek()
        if token is None:
            raise after.error("the file ends here") if after else _core.SceneError("it is empty")
        self._next = None
        return token

    def text(self, after: Token) -> str:
        """A text in quotes."""
        token = self.take(after)
        if not token.quoted:
            raise token.error(f"{after.text} needs a text in quotes, not {token.text!r}")
        return token.text

    def numbers(self, count: int, after: Token) -> list[float]:
        """So many numbers, in brackets or not."""
        found: list[float] = []
        while len(found) < count:
            token = self.take(after)
            if token.text not in "[]" or token.quoted:
                found.append(to_number(token))
        closing = self.peek()
        if closing is not None and closing.text == "]" and not closing.quoted:
            self.take()
        return found

    def parameters(self) -> dict[str, Parameter]:
        """All that follows of the kind `"float radius" [ 1 ]`, by name."""
        found: dict[str, Parameter] = {}
        while (token := self.peek()) is not None and token.quoted:
            self.take()
            kind, _, name = token.text.partition(" ")
            if not name.strip():
                raise token.error(f"{token.text!r} should be a type and a name")
            found[name.strip()] = self._parameter(kind, token)
        return found

    def _parameter(self, kind: str, declared: Token) -> Parameter:
        first = self.take(declared)
        given = [first]
        if first.text == "[" and not first.quoted:
            given = []
            while (token := self.take(declared)).text != "]" or token.quoted:
                given.append(token)
        if kind in NUMBERS or (kind == "spectrum" and given and not given[0].quoted):
            values: list[Any] = [to_number(token) for token in given]
            if len(values) % NUMBERS.get(kind, 2):
                raise declared.error(f"{declared.text!r} has {len(values)} numbers")
        elif kind == "bool":
            values = [token.text == "true" for token in given]
        else:
            values = [token.text for token in given]
        if not values and kind not in NUMBERS:
            raise declared.error(f"{declared.text!r} has no value")
        return Parameter(kind, values)


def to_number(token: Token) -> float:
    """Raises SceneError for anything else."""
    try:
        number = float(token.text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise token.error(f"{token.text!r} is not a number")
    return number
