"""Spectra in files of their own, which parameters of both versions of pbrt name."""

from __future__ import annotations

from pathlib import Path

from ..imported import Imported
from ..limits import TEXT, read_file
from ..missing import ABSENT, is_missing
from .tokens import Parameter, Token


def with_files(
    given: dict[str, Parameter], where: Token, folder: Path, made: Imported
) -> dict[str, Parameter]:
    """The same parameters, with the pairs of each file in the place of its name."""
    return {name: _with_file(parameter, where, folder, made) for name, parameter in given.items()}


def _with_file(given: Parameter, where: Token, folder: Path, made: Imported) -> Parameter:
    """A name that ends like one of a file, as `eta.spd` does, is one, also of a missing file."""
    if given.kind != "spectrum" or not isinstance(given.values[0], str):
        return given
    path = folder / given.values[0]
    if not is_missing(path):
        return Parameter("spectrum", pairs_of(path, where))
    if not path.suffix:
        return given
    made.missing.setdefault(f"{path}: {ABSENT}", where.place)
    return Parameter("float", [1.0])


def pairs_of(path: Path, where: Token) -> list[float]:
    """The wavelengths, in nm, and values, one after the other, without what follows a #."""
    lines = read_file(path, TEXT).decode("utf-8-sig", "replace").splitlines()
    words = [word for line in lines for word in line.partition("#")[0].split()]
    try:
        values = [float(word) for word in words]
    except ValueError:
        values = []
    if not values or len(values) % 2:
        raise where.error(f"{path.name} should hold pairs of a wavelength and a value")
    return values
