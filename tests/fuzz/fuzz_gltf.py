"""glTF: text, or binary if it begins so."""

import copy
import json
import random
from typing import Any

from foreign import fuzz, survive

NUMBERS = (-1, 0, 1, 2, 3, 5121, 5126, 2**40, 1e300, -1e-300)
VALUES = (*NUMBERS, True, None, "0", "", [], {}, [0], [1] * 16)


def read(content: bytes) -> None:
    survive(content, ".glb" if content.startswith(b"glTF") else ".gltf")


def mutated(content: bytes, most: int, seed: int) -> bytes:
    """With another value somewhere in it, if it is JSON; half of the time with other bytes."""
    import atheris

    chance = random.Random(seed)
    try:
        scene = json.loads(content)
        change(scene, chance)
        text = json.dumps(scene, separators=(",", ":")).encode()
    except (ValueError, RecursionError):
        text = content
    if text == content or len(text) > most or chance.random() < 0.5:
        return atheris.Mutate(content, most)
    return text


def change(value: Any, chance: random.Random) -> None:
    """Replaces, removes or copies something below a value."""
    places = places_of(value)
    if not places:
        return
    parent, key = chance.choice(places)
    other, from_key = chance.choice(places)
    match chance.randrange(4):
        case 0:
            del parent[key]
        case 1:
            parent[key] = copy.deepcopy(other[from_key])
        case _:
            parent[key] = copy.deepcopy(chance.choice(VALUES))


def places_of(value: Any) -> list[tuple[Any, Any]]:
    """The keys of all lists and dicts in it."""
    keys = list(value) if isinstance(value, dict) else []
    keys = list(range(len(value))) if isinstance(value, list) else keys
    return [place for key in keys for place in [(value, key), *places_of(value[key])]]


if __name__ == "__main__":
    fuzz(read, custom_mutator=mutated)
