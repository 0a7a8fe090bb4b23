from collections.abc import Callable, Iterator, Sequence
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike

from .algorithms.mutation import Mutation
from .metropolis import Start

__version__: str

class Error(Exception): ...
class SceneError(Error, ValueError): ...
class UsageError(Error, ValueError): ...
class FileError(Error, OSError): ...
class RenderError(Error, RuntimeError): ...

class Scene:
    """An immutable world, as load_file, load_string or load_dict made it."""

    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def half(self) -> bool: ...
    @property
    def hash(self) -> str:
        """Of the description and of the files that it names, wherever they lie."""

    def with_wavelengths(self, band: tuple[float, float] | None = None) -> Scene:
        """The same scene, with spectral films: light has wavelengths instead of R, G and B.

        With a `band` of wavelengths, as in (400, 430), the image shows the mean radiance in it,
        per nm, as a grey.
        """

    @overload
    def with_sensor(self, sensor: int | Part) -> Scene:
        """The same scene, seen by another of its sensors."""

    @overload
    def with_sensor(self, sensor: dict[str, Any]) -> Scene:
        """The same scene, seen by a sensor that is not in it, a dict with its film inside.

        Raises SceneError for one that is wrong.
        """

    def animations(self) -> list[tuple[float, float]]:
        """From when to when anything moves or changes.

        The times of keys that follow each other and differ, of transforms and of colours.
        """

    def parameters(self) -> dict[str, Any]:
        """What can be changed, by name, with its current value."""

    def updated(self, values: dict[str, Any]) -> Scene:
        """The scene with other values of some of its parameters.

        `values` maps names such as "camera.to_world" to values as a scene dict has them. What stays
        the same is shared with this scene, which does not change. Raises UsageError for a name that
        the scene does not have, SceneError for a value that does not fit.
        """

    class Part:
        """A plug-in of a scene."""

        @property
        def name(self) -> str:
            """What its parameters begin with: its id, or one that was given to it."""

        @property
        def type(self) -> str:
            """The name of its plug-in, such as "sphere"."""

        @property
        def index(self) -> int:
            """Its place in the list; of a sensor, what `sensor=` means by it."""

        @property
        def parameters(self) -> dict[str, Any]:
            """What can be changed, without its own name, with the values of now."""

        def __index__(self) -> int: ...

    class ShapePart(Part):
        """A shape or an instance of a scene."""

        @property
        def material(self) -> str:
            """The name of its BSDF; empty for instances."""

        @property
        def bbox(self) -> tuple[np.ndarray, np.ndarray]:
            """The lowest and the highest coordinates, two arrays (3,), at all times."""

        @property
        def emits(self) -> bool:
            """Whether it is a lamp."""

    def shapes(self) -> list[ShapePart]:
        """Its shapes and instances, without parts of groups, in the order that `triangles` and
        LightPath.vertices have."""

    def emitters(self) -> list[Part]:
        """Its lights, those of shapes among them."""

    def sensors(self) -> list[Part]:
        """Its sensors, any of which may be given to `render` as `sensor`."""

    def bbox(self) -> tuple[np.ndarray, np.ndarray]:
        """The lowest and the highest coordinates of all shapes, two arrays (3,), at all times."""

    def triangles(self) -> list[dict[str, Any]]:
        """The shapes as triangles, to be drawn: a list of dicts with shape (as
        LightPath.vertices counts them), positions (n, 3), faces (m, 3), albedo (RGB, at one point)
        and emits. A shape that is an equation is a grid of 32 x 32 cells; one that moves is where
        it is at time 0."""

    def info(self) -> dict: ...
    def _repr_html_(self) -> str:
        """A quick render, for notebooks; see `pymlt.rendering.preview`."""

    def trace_path(
        self,
        *,
        pixel: tuple[int, int],
        seed: int = 0,
        max_depth: int = 10,
        strict_normals: bool = False,
    ) -> LightPath:
        """A light path through the pixel (x, y), found by path tracing (s = 0 or s = 1).

        Samples are taken until one finds light.
        """

    def sample_path(
        self,
        *,
        seed: int = 0,
        max_depth: int = 10,
        strict_normals: bool = False,
    ) -> LightPath:
        """A light path anywhere on the image, by any technique of bidirectional path tracing."""

    def propose(
        self,
        path: LightPath,
        mutation: Mutation | str,
        *,
        seed: int = 0,
        count: int = 100,
        max_depth: int = 10,
        near_specular: float = 0.1,
    ) -> list[LightPath]:
        """What a mutation, alone, would make of a path in `count` tries.

        Those that found a path are returned, each with its `acceptance`.
        """

    def path_target(
        self,
        *,
        max_depth: int = 8,
        hide_emitters: bool = False,
        strict_normals: bool = False,
        near_specular: float = 0.1,
        paths: str | None = None,
        weight: Callable[[LightPath], float] | ArrayLike | None = None,
        power: float = 1.0,
    ) -> _MetropolisModule.PathTarget:
        """L* of the paths of this scene as a target for `metropolis.run`, with mutations as its
        moves; or another target: L*^power, times a weight, of some paths alone.

        `paths` is a regular expression for signatures, such as "LS+DE" for caustics (smooth
        surfaces below the roughness near_specular count as S). `weight` is a function of a
        LightPath that is nowhere negative, or an array (height, width) by the pixels of the image.
        `power` below 1 makes bright paths rarer. Raises UsageError for a factor that makes no
        sense.
        """

    @overload
    def intersect(
        self, start: Vertex, direction: ArrayLike, time: float | None = None
    ) -> Vertex | None: ...
    @overload
    def intersect(
        self, start: ArrayLike, direction: ArrayLike, time: float = 0.0
    ) -> Vertex | dict[str, np.ndarray] | None:
        """The surface that a ray meets first, as a (smooth) vertex; None if it meets none.

        For arrays (n, 3) of points and directions: a dict of arrays with n rows: distance,
        position, geo_normal, sh_normal, uv, shape_index and prim_index; NaN, an infinite distance
        and -1 for rays that meet nothing.
        """

    def camera_rays(self, raster: ArrayLike, time: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
        """Rays from the middle of the lens through raster positions (n, 2), in pixels.

        Two arrays (n, 3), starts and unit directions, as `intersect` takes them.
        """

    def visible(self, a: Vertex, b: Vertex, time: float | None = None) -> bool:
        """Whether nothing stands between two vertices; by default at the time of the first."""

    def scatter(
        self,
        vertex: Vertex,
        direction: ArrayLike,
        u: ArrayLike,
    ) -> tuple[Vertex, np.ndarray] | None:
        """Samples the BSDF of a surface vertex for light or a camera in `direction`.

        u: three random numbers. Returns the vertex with the lobe that was chosen, and a direction.
        """

    def camera_direction(self, vertex: Vertex, raster: ArrayLike) -> np.ndarray | None:
        """The direction that leaves the lens at the last vertex of a path for a raster position."""

    @property
    def raster_area(self) -> float:
        """Of the image with the border that its filter needs, in square pixels."""

class Vertex:
    """A vertex of a light path; it belongs to the scene of its path."""

    @property
    def kind(self) -> Literal["light", "surface", "camera"]: ...
    @property
    def position(self) -> np.ndarray:
        """Where it is; at infinity, the direction towards it."""

    @property
    def normal(self) -> np.ndarray: ...
    @property
    def shading_normal(self) -> np.ndarray: ...
    @property
    def uv(self) -> tuple[float, float]: ...
    @property
    def lobe(self) -> Literal["smooth", "reflection", "transmission"]:
        """How it scatters: smooth, or by which delta."""

    @property
    def delta(self) -> bool:
        """Whether it scatters in one direction only."""

    @property
    def infinite(self) -> bool: ...
    @property
    def shape(self) -> int:
        """Which shape of the scene it is on; -1: none."""

    def direction_to(self, other: Vertex) -> np.ndarray:
        """The unit direction in which another vertex is seen."""

class LightPath:
    """A light path: x_0 on a light ... x_k on the camera's lens, whichever way it was made."""

    @property
    def signature(self) -> str:
        """Heckbert's notation, light to camera: L, a D or S for each surface, E."""

    def signature_with(self, near_specular: float) -> str:
        """The same, where a surface below this roughness counts as S."""

    @property
    def vertices(self) -> np.ndarray:
        """A structured array: kind, position, normal, shading_normal, uv, lobe, infinite, shape,
        primitive, emitter. At infinity, position is the direction towards the vertex."""

    @property
    def edges(self) -> int:
        """k"""

    @property
    def time(self) -> float: ...
    @property
    def wavelengths(self) -> np.ndarray | None:
        """Its four wavelengths in nm, each about a quarter of what the eye sees apart; None in
        scenes that are not spectral. If it is dispersed, the first one alone counts."""

    @property
    def dispersed(self) -> bool:
        """Whether it is refracted by an index that depends on the wavelength."""

    @property
    def raster(self) -> tuple[float, float]:
        """Where it meets the image, in pixels from the upper left corner."""

    @property
    def technique(self) -> tuple[int, int] | None:
        """(s, t) that found it, or None."""

    @property
    def estimate(self) -> np.ndarray | None:
        """What it brought to the image: RGB of its contribution over its density, weighted."""

    @property
    def acceptance(self) -> float | None:
        """Of a proposal: the probability of accepting it."""

    def contribution(self) -> np.ndarray:
        """f(x), RGB (Veach 1997, eq. 8.7), without visibility."""

    def densities(self, sample_direct: bool = True) -> np.ndarray:
        """p_{s,t}(x) in the product-area measure, for s = 0 ... k + 1."""

    def weights(
        self,
        heuristic: Literal["balance", "power", "maximum"] = "power",
        sample_direct: bool = True,
    ) -> np.ndarray:
        """The weights of multiple importance sampling, for s = 0 ... k + 1."""

    def __len__(self) -> int: ...
    @overload
    def __getitem__(self, i: int) -> Vertex:
        """Vertex i, counted from the light."""

    @overload
    def __getitem__(self, i: slice) -> list[Vertex]: ...
    def __iter__(self) -> Iterator[Vertex]: ...
    def with_vertices(self, vertices: Sequence[Vertex]) -> LightPath:
        """Another path of the same scene and time, through these vertices."""

    @property
    def scene(self) -> Scene: ...
    @property
    def G(self) -> np.ndarray:  # noqa: N802
        """G(x_i, x_{i+1}) for i = 0 ... k - 1 (Veach 1997, eq. 8.2), without visibility."""

    @property
    def from_light(self) -> np.ndarray:
        """Density of each x_i when a walk from the light makes it, per unit of area."""

    @property
    def from_camera(self) -> np.ndarray:
        """Density of each x_i when a walk from the camera makes it, per unit of area."""

class _MetropolisModule:
    """`_core.lab`, the C++ side of pymlt.lab.metropolis: a module."""

    class Move:
        """A built-in move."""

    class Target:
        """A built-in target."""

        def values(self, points: np.ndarray) -> np.ndarray:
            """At each row of an array."""

    class PathTarget:
        """L*(x), the brightness that a light path brings to the image."""

        def __call__(self, path: LightPath) -> float:
            """L*(x); 0 if light cannot take the path."""

        def bootstrap(
            self,
            candidates: int = 10000,
            *,
            chains: int = 1,
            seed: int = 0,
        ) -> Start:
            """Paths to start chains from without start-up bias, with b, the integral of L*."""

        def metropolis_chains(
            self,
            moves: list[tuple[Mutation, float]],
            x0: LightPath | list[LightPath],
            chains: int | None,
            seed: int,
        ) -> tuple[Any, str]: ...

    class Chains:
        """Chains of numbers, of any Python objects, or of light paths."""

        def advance(self, steps: int, expected_values: bool) -> dict[str, Any]: ...

    class BitGenerator:
        """The random stream of a chain, as numpy's bit generators are."""

        @property
        def capsule(self) -> Any: ...
        @property
        def lock(self) -> Any: ...

    @staticmethod
    def random_walk(size: list[float], shape: str) -> Move: ...
    @staticmethod
    def adaptive_walk(
        size: list[float],
        shape: str,
        goal: float,
        rate: float,
        decay: float,
    ) -> Move: ...
    @staticmethod
    def uniform(low: list[float], high: list[float]) -> Move: ...
    @staticmethod
    def discrete(matrix: list[list[float]]) -> Move: ...
    @staticmethod
    def parabola() -> Target: ...
    @staticmethod
    def table(values: list[float]) -> Target: ...
    @staticmethod
    def image(pixels: np.ndarray) -> Target: ...
    @staticmethod
    def normals(
        means: list[list[float]],
        deviations: list[float],
        weights: list[float],
    ) -> Target: ...
    @staticmethod
    def number_chains(
        target: Any,
        moves: list[tuple[Any, float]],
        starts: np.ndarray,
        form: str,
        seed: int,
        vectorized: bool,
    ) -> Chains: ...
    @staticmethod
    def object_chains(
        target: Any,
        moves: list[tuple[Any, float]],
        starts: list[Any],
        seed: int,
    ) -> Chains: ...
    @staticmethod
    def resample(
        weights: np.ndarray,
        chains: int,
        seed: int,
    ) -> tuple[float, float, list[int]]: ...
    @staticmethod
    def acceptance(forward: float, backward: float) -> float: ...

metropolis: _MetropolisModule

class Integrator:
    @property
    def settings(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...

class CheckpointFile:
    def __init__(self, path: str, every: float, overwrite: bool) -> None: ...

class Job:
    def __init__(
        self,
        scene: Scene,
        integrator: Integrator,
        spp: float | None,
        time: float | None,
        error: float | None,
        seed: int,
        threads: int,
        checkpoint: CheckpointFile,
        aovs: str | None,
        alpha: bool,
    ) -> None: ...
    @property
    def has_alpha(self) -> bool: ...
    @property
    def ended(self) -> bool: ...
    @property
    def cancelled(self) -> bool: ...
    @property
    def progress(self) -> float: ...
    @property
    def spp_done(self) -> float: ...
    def judge_by(self, error: Callable[[], float]) -> None: ...
    def start(self) -> None: ...
    def wait(self, seconds: float) -> bool: ...
    def cancel(self) -> None: ...
    def checkpoint(self, path: str, overwrite: bool) -> None: ...
    def save(self) -> bytes: ...
    def load(self, state: bytes) -> None: ...
    def extend(self, spp: float | None, time: float | None, error: float | None) -> None: ...
    def groups(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]: ...
    def image(self) -> np.ndarray: ...
    def replay(
        self,
        pixel: tuple[int, int],
        sample: int,
    ) -> tuple[tuple[float, float], np.ndarray, list[LightPath]]: ...
    def halves(
        self, layer: int = -1
    ) -> tuple[tuple[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]] | None: ...
    def flicker(
        self,
        before: Job,
        layer: int = -1,
        layer_before: int = -1,
        factor_before: float = 1,
    ) -> float | None: ...
    def relative_error(self, layer: int = -1) -> float | None: ...
    @property
    def light_groups(self) -> list[str]: ...
    def light(self) -> dict[str, np.ndarray]: ...
    def layers(self) -> dict[str, np.ndarray]: ...
    def stats(self) -> str: ...
    def metadata(self) -> dict[str, str]: ...
    def attach(self, executor: object) -> None: ...
    @property
    def stopping(self) -> bool: ...
    @property
    def interrupted(self) -> bool: ...
    @property
    def units_done(self) -> int: ...
    @property
    def units_per_cycle(self) -> int: ...
    @property
    def task_count(self) -> int: ...
    def position(self, task: int) -> int: ...
    def skip(self, task: int, to: int) -> bool: ...
    def split(self, task: int) -> bool: ...
    def task(self, task: int, to: int) -> bytes: ...
    def merge(self, task: int, result: bytes) -> None: ...

class Helper:
    def __init__(self, scene: Scene, integrator: Integrator) -> None: ...
    def run(self, task: bytes, threads: int) -> bytes: ...
    def cancel(self) -> None: ...

class Checkpoint:
    def __init__(self, path: str) -> None: ...
    @property
    def integrator(self) -> Integrator: ...
    @property
    def seed(self) -> int: ...
    @property
    def built_in(
        self,
    ) -> tuple[str, dict[str, str], tuple[int, int] | None, int | None, str] | None: ...
    def load_scene(self, moved_to: str) -> Scene: ...
    def check(self, scene: Scene) -> None: ...
    def resume(self, job: Job) -> None: ...

class AuditReport:
    @property
    def verdict(self) -> Literal["nothing found", "wrong", "inconclusive"]: ...
    @property
    def reason(self) -> str: ...
    @property
    def b(self) -> float: ...
    @property
    def samples(self) -> int: ...
    @property
    def effective_samples(self) -> float: ...
    @property
    def steps(self) -> int: ...
    @property
    def accepted(self) -> int: ...
    @property
    def invalid(self) -> int: ...
    @property
    def tests(self) -> list[tuple[str, bool, float, float, float, float, float]]: ...
    @property
    def limits(self) -> list[tuple[int, bool, float]]: ...
    def text(self, most: int) -> str: ...

def mutations() -> list[dict]: ...
def audit(
    scene: Scene,
    mixture: list[tuple[Mutation | str, float]],
    max_depth: int,
    hide_emitters: bool,
    strict_normals: bool,
    near_specular: float,
    paths: int,
    most_paths: int,
    seed: int,
    threads: int,
    significance: float,
) -> AuditReport: ...

class Flag:
    """A flag of `pymlt render` and mlt-render."""

    @property
    def name(self) -> str: ...
    @property
    def spelling(self) -> str:
        """Such as -o,--output; or a name without a dash."""

    @property
    def metavar(self) -> str: ...
    @property
    def help(self) -> str: ...
    @property
    def has_value(self) -> bool: ...
    @property
    def required(self) -> bool: ...
    @property
    def repeatable(self) -> bool: ...
    @property
    def is_file(self) -> bool: ...
    def read(self, text: str) -> str | int | float | tuple[int, int] | tuple[str, str]:
        """What a text means as its value."""

def render_flags() -> list[Flag]: ...
def check_files(given: dict[str, list[str]]) -> None: ...
def check_flags(given: set[str]) -> None:
    """Raises UsageError if the flags with these names make no sense together."""

def families() -> list[str]: ...
def names(family: str) -> list[str]: ...
def schema(family: str, name: str) -> dict: ...
def suggestion(word: str, candidates: list[str]) -> str: ...
def load_file(
    path: str,
    defines: dict[str, str],
    size: tuple[int, int] | None,
    lenient: bool | None,
    sensor: int | None,
    filter: str,
) -> Scene: ...
def load_string(
    xml: str,
    directory: str,
    defines: dict[str, str],
    size: tuple[int, int] | None,
    lenient: bool | None,
    sensor: int | None,
    filter: str,
) -> Scene: ...
def load_dict(
    dict: dict,
    size: tuple[int, int] | None,
    sensor: int | None,
    filter: str,
    built_in: str = "",
    defines: dict[str, str] = {},
) -> Scene: ...
def integrator_by_name(
    scene: Scene,
    name: str,
    assignments: list[tuple[str, str]],
) -> Integrator: ...
def integrator_from_dict(dict: dict) -> Integrator: ...
def with_mutations(
    integrator: Integrator,
    scene: Scene,
    mutations: list[tuple[Mutation, float]],
) -> Integrator: ...
def with_light_layers(
    integrator: Integrator,
    groups: bool,
    classes: list[tuple[str, str]],
    exposures: bool = False,
) -> Integrator: ...
def alpha_problem(path: str) -> str: ...
def read_image(path: str, layer: str = "") -> np.ndarray: ...
def decode_image(bytes: bytes, name: str) -> np.ndarray: ...
def encode_jpeg(image: np.ndarray, exposure: float = 0.0) -> bytes:
    """A JPEG file of linear pixels: 8 bits, sRGB, full resolution of the colours.

    Raises UsageError for an image that JPEG cannot hold, such as one with alpha.
    """

def fitting_exposure(image: np.ndarray) -> float: ...
def is_known_image(path: str) -> bool: ...
def read_file(path: str, largest: int) -> bytes: ...
def read_metadata(path: str) -> dict[str, str]: ...
def write_image(
    path: str,
    image: np.ndarray,
    layers: dict[str, np.ndarray],
    metadata: dict[str, str],
    half: bool,
    exposure: float,
) -> None: ...
def save_image(
    path: str,
    image: np.ndarray,
    layers: dict[str, np.ndarray],
    metadata: dict[str, str],
    half: bool,
    exposure: float,
) -> tuple[str, str]: ...
def save_text(path: str, text: str | bytes) -> tuple[str, str]: ...
def check_image_writable(path: str) -> None: ...
def check_file_writable(path: str) -> None: ...
