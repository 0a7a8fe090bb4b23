"""The words of a pbrt-v4 file (https://pbrt.org/fileformat-v4), and lists of parameters."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

from ... import _core
from .. import limits

PATTERN = re.compile(r'\s+|#[^\n]*|"((?:[^"\\\n]++|\\.)*+)"|([\[\]])|([^\s"\[\]#]+)|(.)')
#: The same without three or more numbers in a row, for a fast look at the words.
NO_NUMBERS = re.compile(r'(?:[-+.\d][^\s"\[\]#]*\s+){3,}+|' + PATTERN.pattern)
NUMBERS = {"integer": 1, "float": 1, "point2": 2, "vector2": 2, "point3": 3, "vector3": 3}
NUMBERS |= {"normal3": 3, "point": 3, "vector": 3, "normal": 3, "rgb": 3, "blackbody": 1}
NUMBERS |= {"color": 3, "xyz": 3}  #: of pbrt-v3


class Token(NamedTuple):
    """A word, and where it stands."""

    text: str
    quoted: bool
    file: Path
    line: int

    @property
    def place(self) -> str:
        return f"{self.file}:{self.line}"

    def error(self, message: str) -> _core.SceneError:
        return _core.SceneError(f"{self.place}: {message}")


class Parameter(NamedTuple):
    """A value with the type that the file gives it."""

    kind: str  #: "float", "rgb", "texture", ...
    values: list[Any]  #: floats, texts or booleans


def tokens(path: Path, text: str, pattern: re.Pattern[str]) -> Iterator[Token]:
    """The words of a file. Raises SceneError."""
    line = 1
    for match in pattern.finditer(text):
        quoted, bracket, word, other = match.groups()
        token = Token(quoted or bracket or word or "", quoted is not None, path, line)
        if other:
            raise token.error(f"{other!r} begins nothing that ends on this line")
        if len(token.text) > limits.NAME:
            raise token.error(f"a word has more than {limits.NAME} characters")
        if quoted is not None or bracket or word:
            yield token
        line += match[0].count("\n")


class Words:
    """The words of a file with the files that it includes, one after the other."""

    def __init__(self, path: Path, pattern: re.Pattern[str] = PATTERN):
        self._root = path.parent
        self._pattern = pattern
        self._open: list[Iterator[Token]] = []
        self._paths: list[Path] = []  #: of those that are open
        self._included = -1
        self._size = 0
        self._next: Token | None = None
        self._begin(path)

    def include(self, name: Token) -> None:
        """Goes on with another file; names are relative to the first one."""
        path = self._root / name.text
        if path.resolve() in self._paths:
            raise name.error(f"{name.text!r} is being read already: the files include each other")
        if len(self._open) > limits.INCLUDES_DEEP:
            raise name.error(f"files include each other more than {limits.INCLUDES_DEEP} deep")
        if self._included >= limits.INCLUDES:
            raise name.error(f"there are more than {limits.INCLUDES} includes")
        self._begin(path)
        if self._size > limits.TEXT:
            raise name.error(f"the files have more than {limits.TEXT} bytes together")

    def _begin(self, path: Path) -> None:
        """Opens a file, which may be compressed (.gz)."""
        content = limits.read_file(path, limits.TEXT)
        self._included += 1
        self._size += len(content)
        self._paths.append(path.resolve())
        self._open.append(tokens(path, _decoded(content), self._pattern))

    def peek(self) -> Token | None:
        """The next word, which stays; None at the end."""
        while self._next is None and self._open:
            self._next = next(self._open[-1], None)
            if self._next is None:
                self._open.pop()
                self._paths.pop()
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
        """This number of numbers, in brackets or not."""
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
        return {
            name: _parameter(kind, declared, values)
            for declared, kind, name, values in self.declarations()
        }

    def declarations(self) -> Iterator[tuple[Token, str, str, Iterator[Token]]]:
        """The same, as words: the declaration, its type and its name, and the values."""
        while (token := self.peek()) is not None and token.quoted:
            self.take()
            kind, _, name = token.text.partition(" ")
            if not name.strip():
                raise token.error(f"{token.text!r} should be a type and a name")
            values = self._list(token)
            yield token, kind, name.strip(), values
            for _ in values:  # those that nobody has asked for
                pass

    def _list(self, declared: Token) -> Iterator[Token]:
        """The words between brackets, or the one without."""
        token = self.take(declared)
        if token.text != "[" or token.quoted:
            yield token
            return
        while (token := self.take(declared)).text != "]" or token.quoted:
            yield token


def _parameter(kind: str, declared: Token, given: Iterator[Token]) -> Parameter:
    values: list[Any] = []
    numeric = kind in NUMBERS
    for token in given:
        numeric = numeric or (kind == "spectrum" and not token.quoted)
        values.append(to_number(token) if numeric else token.text)
    if numeric:
        if len(values) % NUMBERS.get(kind, 2):
            raise declared.error(f"{declared.text!r} has {len(values)} numbers")
    elif kind == "bool":
        values = [text == "true" for text in values]
    if not values and kind not in NUMBERS:
        raise declared.error(f"{declared.text!r} has no value")
    return Parameter(kind, values)


def _decoded(content: bytes) -> str:
    """The text without a byte order mark, its lines ended by newlines."""
    text = content.decode("utf-8-sig", "replace")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def to_number(token: Token) -> float:
    """Raises SceneError for anything else."""
    try:
        number = float(token.text)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise token.error(f"{token.text!r} is not a number")
    return number
