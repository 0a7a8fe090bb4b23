"""What a mutation is, so that one can be written in Python."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .parameters import WithParameters

if TYPE_CHECKING:
    import numpy as np

    from .._core import LightPath


class Mutation:
    """A way of changing a light path. Subclass it to write one in Python.

    It may be audited, join the mixture of an `MLT`, and move chains of `metropolis.run` whose
    target is `scene.path_target()`. All chains and threads share the object, so its methods must
    not change it. They are called from one thread at a time.

    suitability(x)
        The weight with which it takes part in the choice among mutations: 1, or 0 where it cannot
        act on x. Acceptance accounts for it.
    propose(x, rng)
        Returns another path y, made by `x.with_vertices(...)`, or None if it finds none. `rng` is a
        `numpy.random.Generator` on the random stream of the chain; draw from nothing else, and
        renders depend on their seed alone; `mlt.audit` looks at that, too. Visibility is tested
        afterwards: a path that light cannot take is rejected, and so is one that breaks the law of
        reflection or refraction at a delta vertex.
    density(x, y)
        q(x -> y), the density with which `propose` makes y of x, given that this mutation was
        chosen, in the product-area measure of the vertices that y has and x has not: the product
        over these vertices of a density per unit of area (in the units of the scene; per steradian
        for a vertex at infinity, and for a vertex that follows a delta vertex the coefficient of
        that delta), as `y.from_light` and `y.from_camera` are. It is also asked for q(y -> x), and
        must be 0 where `propose` could not have made the path. A constant factor cancels, but not
        one that depends on the paths.

    The contract is that of the C++ side (cpp/mutation/mutation.h; Veach 1997, sec. 11.2).
    """

    _built_in = False

    @property
    def name(self) -> str:
        """As in `stats`: the name of the class."""
        return type(self).__name__

    def suitability(self, x: LightPath) -> float:
        return 1.0

    def propose(self, x: LightPath, rng: np.random.Generator) -> LightPath | None:
        raise NotImplementedError(f"{type(self).__name__} needs a method propose(x, rng)")

    def density(self, x: LightPath, y: LightPath) -> float:
        raise NotImplementedError(f"{type(self).__name__} needs a method density(x, y)")

    def __repr__(self) -> str:
        return f"{type(self).__name__}()"


class BuiltIn(WithParameters, Mutation):
    """A mutation of the C++ side, with the parameters of its own."""

    _built_in = True
    _name: str
    _switch: str  # the parameters of the integrator that turn it on ...
    _weight_name: str  # ... and give it its weight
    _weight: float

    @property
    def name(self) -> str:
        """As in `stats` and in the parameters of the integrator."""
        return self._name

    @classmethod
    def full_names(cls) -> dict[str, str]:
        """The parameters of the integrator that stand for its own: "lens_largest_share"."""
        return {own: f"{cls._name}_{own}" for own in cls._defaults}

    @classmethod
    def of(cls, parameters: dict) -> BuiltIn:
        """The one that these parameters of the integrator describe."""
        names = cls.full_names()
        return cls(**{own: parameters[name] for own, name in names.items() if name in parameters})

    def __hash__(self) -> int:
        return hash(type(self))
