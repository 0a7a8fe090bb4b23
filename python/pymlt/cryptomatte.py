"""Mattes of objects and materials, from layers that follow the Cryptomatte Specification.

Layers `cryptomatte_object` and `cryptomatte_material` of a render (`aovs=`) have, for each pixel,
ids and the shares of the pixel that these cover. Files of other renderers are read as well.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Protocol

from . import _core
from .images import layer_names, read_image, read_metadata

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["matte", "names"]


class Rendered(Protocol):
    """A `Result`, or whatever has layers and says in its metadata what they are."""

    layers: dict[str, NDArray[np.float32]]
    metadata: dict[str, str]


Source = str | os.PathLike[str] | Rendered


def names(source: Source, layer: str = "") -> list[str]:
    """The names of which there are mattes, sorted.

    source
        the name of an EXR file, or a Result.
    layer
        the name of a Cryptomatte, such as "cryptomatte_material"; by default all that there are.

    Raises UsageError if there are none, FileError for a file that cannot be read.
    """
    manifests = _manifests(_metadata(source), layer)
    return sorted({name for manifest in manifests.values() for name in manifest})


def matte(source: Source, name: str, layer: str = "") -> NDArray[np.float32]:
    """How much of each pixel the object or material of this name covers.

    source, layer
        as for `names`; by default the first layer that has the name.

    Returns float32, (height, width), from 0 to 1: the sum of the coverages whose id is that of the
    name. The rest of a pixel belongs to others, or to the background. Raises UsageError for a name
    that no layer has, FileError for a file that cannot be read.
    """
    import numpy as np

    manifests = _manifests(_metadata(source), layer)
    having = [cryptomatte for cryptomatte, ids in manifests.items() if name in ids]
    if not having:
        known = ", ".join(sorted({name for ids in manifests.values() for name in ids})[:20])
        raise _core.UsageError(f"there is no matte of {name!r}; there are: {known}")
    wanted = np.uint32(int(manifests[having[0]][name], 16))
    ranks = np.concatenate(_ranks(source, having[0]), axis=2)
    ids = np.ascontiguousarray(ranks[..., 0::2]).view(np.uint32)
    return np.where(ids == wanted, ranks[..., 1::2], 0).sum(axis=2, dtype=np.float32)


def has_ids(layer: str, metadata: Mapping[str, str]) -> bool:
    """Whether a layer is one of a Cryptomatte: of its numbers there are no means."""
    return any(_is_of(layer, name) for name, _ in _described(metadata))


def _described(metadata: Mapping[str, str]) -> list[tuple[str, str]]:
    """The name of each Cryptomatte, and how its metadata begin."""
    found = (re.fullmatch(r"(cryptomatte/[^/]+/)name", key) for key in sorted(metadata))
    return [(metadata[match[0]], match[1]) for match in found if match]


def _is_of(layer: str, name: str) -> bool:
    return re.fullmatch(re.escape(name) + "[0-9]+", layer) is not None


def _metadata(source: Source) -> dict[str, str]:
    return read_metadata(source) if isinstance(source, str | os.PathLike) else source.metadata


def _manifests(metadata: dict[str, str], layer: str) -> dict[str, dict[str, str]]:
    """The ids of names, in hexadecimal digits, for each Cryptomatte or for that of this name."""
    described = dict(_described(metadata))
    if not described:
        raise _core.UsageError(
            "there is no Cryptomatte; renders with aovs='cryptomatte_object' have one"
        )
    if layer and layer not in described:
        raise _core.UsageError(
            f"there is no Cryptomatte {layer!r}; there are: {', '.join(described)}"
        )
    chosen = [layer] if layer else list(described)
    return {name: _ids(metadata.get(f"{described[name]}manifest", "{}")) for name in chosen}


def _ids(manifest: str) -> dict[str, str]:
    try:
        ids = json.loads(manifest)
        if all(0 <= int(number, 16) < 2**32 for number in ids.values()):
            return ids
    except (ValueError, TypeError, AttributeError):
        pass
    raise _core.FileError("the manifest of a Cryptomatte is not one of names and hexadecimal ids")


def _ranks(source: Source, name: str) -> list[np.ndarray]:
    """The layers with the ids and coverages of a Cryptomatte, the largest first."""
    if isinstance(source, str | os.PathLike):
        found = [layer for layer in layer_names(source) if _is_of(layer, name)]
        ranks = [read_image(source, layer) for layer in found]
    else:
        ranks = [source.layers[layer] for layer in sorted(source.layers) if _is_of(layer, name)]
    if not ranks or any(layer.shape[2] != 4 for layer in ranks):
        raise _core.UsageError(f"the layers of the Cryptomatte {name!r} are missing")
    return ranks
