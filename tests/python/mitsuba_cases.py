"""The scenes that are compared with Mitsuba 3, and the files that hold what it made of them."""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from conftest import shared_root
from same_image import ALL, Blocks

FOLDER = Path(__file__).parent
SIZE = (32, 24)
REFERENCE_RUNS = 64

# Mitsuba 3 takes the diffuse reflectance of the inside of a smooth coating from a fit: up to 0.12 %
# in what a plastic reflects diffusely, for the indices used here. Ours is integrated.
COATING = 0.0015


@dataclass(frozen=True)
class Case:
    name: str
    file: str  #: below tests/python/scenes, or below the external scenes
    defines: dict[str, str] = field(default_factory=dict)
    shared: bool = False
    spp: int = 32  #: of one run of the test
    reference_spp: int = 1024  #: of one run of the reference
    systematic: float = 0.0

    @property
    def path(self) -> Path:
        return (shared_root() if self.shared else FOLDER) / "scenes" / self.file

    def text(self) -> str:
        """The scene as XML in one piece, at the size of the references."""
        return _at_size(_read(self.path, self.defines))

    def digest(self) -> str:
        """Changes with the scene, so that an outdated reference is noticed."""
        text = self.text() + repr(sorted(self.defines.items()))
        return hashlib.sha256(re.sub(r"\s+", " ", text).encode()).hexdigest()[:16]

    @property
    def reference(self) -> Path:
        return FOLDER / "references" / f"{self.name}.npz"


def _read(path: Path, defines: dict[str, str]) -> str:
    """The file with its <include>d files in place."""
    text = path.read_text()
    values = dict(re.findall(r'<default name="(\w+)" value="([^"]*)"', text)) | defines

    def included(match):
        name = re.sub(r"\$(\w+)", lambda m: values[m[1]], match[1])
        inner = _read(path.parent / name, defines)
        return re.sub(r"<\?xml.*?\?>|</?scene[^>]*>", "", inner)

    return re.sub(r'<include filename="([^"]*)"\s*/>', included, text)


def _at_size(text: str) -> str:
    """The film (if the scene has one, and no crop window) gets the size of the references."""
    if "crop_" in text:
        return text
    for name, value in zip(("width", "height"), SIZE, strict=True):
        text = re.sub(rf'(<integer name="{name}" value=)"[^"]*"', rf'\1"{value}"', text)
    return text


def read_reference(case: Case) -> Blocks:
    with np.load(case.reference) as stored:
        assert stored["digest"] == case.digest(), (
            f"{case.reference.name} was made from another version of the scene: "
            "run tests/python/references/make_references.py"
        )
        mean, error = stored["mean"].astype(float), stored["error"].astype(float)
        return Blocks(ALL, mean, error, REFERENCE_RUNS)


def _stage(name: str, **defines) -> Case:
    options = {k: defines.pop(k) for k in ("spp", "systematic") if k in defines}
    return Case(name, "stage.xml", defines, **options)


def _stages():
    for material in ("diffuse", "conductor", "dielectric", "null"):
        yield _stage(f"material-{material}", material=material)
    yield _stage("material-twosided", material="twosided", object="back")
    for distribution in ("ggx", "beckmann"):
        for material in ("roughconductor", "roughdielectric"):
            name = f"{material}-{distribution}"
            yield _stage(f"material-{name}", material=name)
        name = f"roughplastic-{distribution}"
        yield _stage(f"material-{name}", material=name, systematic=COATING)
    for material in ("plastic", "plastic-nonlinear"):
        yield _stage(f"material-{material}", material=material, systematic=COATING)
    for thing in (
        "sphere",
        "turned-sphere",
        "rectangle",
        "cube",
        "ply",
        "flat",
        "obj",
        "serialized",
    ):
        yield _stage(f"bitmap-on-{thing}", material="bitmap", object=thing)
    for thing in ("sphere", "rectangle", "cube", "ply"):
        yield _stage(f"checkerboard-on-{thing}", material="checkerboard", object=thing)
    lights = ("area", "constant", "point", "directional", "envmap", "textured", "spectrum")
    for light in (*lights, "sphere", "mesh"):
        noisy = {"spp": 128} if light in ("spectrum", "mesh") else {}
        yield _stage(f"light-{light}", light=light, **noisy)
    for light in ("area", "envmap", "sphere"):
        gloss = "roughconductor-ggx"
        yield _stage(f"gloss-under-{light}", light=light, material=gloss, spp=96)
    for camera in ("focal", "diagonal", "thinlens", "crop"):
        yield _stage(f"camera-{camera}", camera=camera)
    for filter in ("tent", "gaussian", "mitchell", "catmullrom", "lanczos"):
        yield _stage(f"filter-{filter}", filter=filter)


def _shared(name: str, **options) -> Case:
    return Case(name, f"{name}/scene.xml", shared=True, **options)


STAGES = list(_stages())
BOXES = [
    Case("mitsuba-cornell-box", "mitsuba-cornell-box.xml", spp=256, reference_spp=2048),
    Case("glass-ball", "glass-ball.xml", spp=256, reference_spp=2048),
]
SHARED = [
    _shared("cornell-box", spp=256, reference_spp=2048),
    _shared("veach-mi", spp=1600),
    _shared("matpreview", spp=64, systematic=COATING),
]
BIDIR = _shared("veach-bidir", spp=384, reference_spp=4096)  # too noisy by path tracing alone
CASES = {case.name: case for case in [*STAGES, *BOXES, *SHARED, BIDIR]}
