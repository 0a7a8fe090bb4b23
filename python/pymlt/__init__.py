"""pymlt: an open renderer for Metropolis light transport.

    import pymlt as mlt

    scene = mlt.load_file("scene.xml")
    image = mlt.render(scene, "pssmlt", spp=64)     # numpy float32, (height, width, 3), linear
    mlt.write_image("door.png", image)

What is heavy (numpy, tqdm, ...) is imported where it is first used, so this import is quick.
"""

from . import _interrupt as _interrupt  # isort: skip (before anything that takes time)
import importlib as _importlib
from typing import TYPE_CHECKING

from . import _processor as _processor  # isort: skip (chooses what _core is)
from . import cryptomatte, scenes
from ._core import (
    Error,
    FileError,
    LightPath,
    RenderError,
    Scene,
    SceneError,
    UsageError,
    Vertex,
    __version__,
)
from .algorithms import integrators as _integrators
from .algorithms import mutations as _mutations
from .algorithms.integrator import Integrator
from .algorithms.integrators import *  # noqa: F403 (the classes are made from the schemas)
from .algorithms.mutation import Mutation
from .algorithms.mutations import *  # noqa: F403
from .algorithms.schemas import available, describe
from .diagnostics.audit import Audit, audit
from .diagnostics.comparison import comparison_figure
from .diagnostics.metrics import compare
from .diagnostics.mixing import Convergence, convergence
from .formats.files import convert, load_materials
from .formats.loading import load
from .images import read_image, read_metadata, write_image
from .pictures.denoising import denoise
from .pictures.techniques import Technique
from .pictures.tonemapping import tonemap
from .rendering.film import write_film
from .rendering.job import Job
from .rendering.merged_shots import merge_shots
from .rendering.merging import merge
from .rendering.mixing import mix
from .rendering.preview import preview as _preview
from .rendering.result import Groups, Replay, Result
from .rendering.shot import render_shot
from .rendering.shot_result import Frame, Shot
from .rendering.start import (
    render,
    render_bands,
    render_progressive,
    replay,
    resume,
    start,
)
from .scenes.loading import load_dict, load_file, load_string
from .scenes.transforms import Transform
from .scenes.traversal import SceneParameters, traverse

if TYPE_CHECKING:
    from . import lab, race
    from .race import Program, Race, RaceResult
    from .race.equal_time import equal_time
    from .viewing import view

__all__ = [
    "Audit",
    "Convergence",
    "Error",
    "FileError",
    "Frame",
    "Groups",
    "Integrator",
    "Job",
    "LightPath",
    "Mutation",
    "Program",
    "Race",
    "RaceResult",
    "RenderError",
    "Replay",
    "Result",
    "Scene",
    "SceneError",
    "SceneParameters",
    "Shot",
    "Technique",
    "Transform",
    "UsageError",
    "Vertex",
    "__version__",
    "audit",
    "available",
    "compare",
    "comparison_figure",
    "convergence",
    "convert",
    "cryptomatte",
    "denoise",
    "describe",
    "equal_time",
    "lab",
    "load",
    "load_dict",
    "load_file",
    "load_materials",
    "load_string",
    "merge",
    "merge_shots",
    "mix",
    "race",
    "read_image",
    "read_metadata",
    "render",
    "render_bands",
    "render_progressive",
    "render_shot",
    "replay",
    "resume",
    "scenes",
    "start",
    "tonemap",
    "traverse",
    "view",
    "write_film",
    "write_image",
]
Scene._repr_html_ = _preview
__all__ += _integrators.__all__ + _mutations.__all__


_LATER = {"view": "viewing"} | dict.fromkeys(
    ("Program", "Race", "RaceResult", "equal_time"), "race"
)


if not TYPE_CHECKING:  # a type checker would take any name for one of this module

    def __getattr__(name: str):
        """What not every program needs."""
        if name in ("lab", "race"):
            return _importlib.import_module(f"{__name__}.{name}")
        if name in _LATER:
            return getattr(_importlib.import_module(f"{__name__}.{_LATER[name]}"), name)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    """For completion, with what is imported where it is first used."""
    return sorted({*globals(), *__all__})
