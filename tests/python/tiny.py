"""A scene small enough to render in a moment, as XML and as the dict that means the same."""

from pathlib import Path

XML = """\
<scene version="3.0.0">
  <default name="res" value="16"/>
  <default name="depth" value="4"/>
  <integrator type="path"><integer name="max_depth" value="$depth"/></integrator>
  <sensor type="perspective">
    <float name="fov" value="40"/>
    <transform name="to_world">
      <lookat origin="0, 1, 4" target="0, 0.5, 0" up="0, 1, 0"/>
    </transform>
    <film type="hdrfilm">
      <integer name="width" value="$res"/>
      <integer name="height" value="12"/>
      <string name="component_format" value="float32"/>
      <rfilter type="box"/>
    </film>
    <sampler type="independent"><integer name="sample_count" value="4"/></sampler>
  </sensor>
  <bsdf type="diffuse" id="clay"><rgb name="reflectance" value="0.7, 0.4, 0.2"/></bsdf>
  <shape type="rectangle">
    <transform name="to_world">
      <rotate x="1" angle="-90"/>
      <scale value="3"/>
    </transform>
    <ref id="clay"/>
  </shape>
  <shape type="sphere">
    <point name="center" x="0" y="0.6" z="0"/>
    <float name="radius" value="0.6"/>
    <bsdf type="dielectric"/>
  </shape>
  <shape type="rectangle">
    <transform name="to_world">
      <rotate x="1" angle="90"/>
      <translate x="0" y="3" z="0"/>
    </transform>
    <emitter type="area"><rgb name="radiance" value="5, 6, 7"/></emitter>
  </shape>
</scene>
"""


def scene() -> dict:
    import pymlt as mlt

    T = mlt.Transform
    return {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 4},
        "sensor": {
            "type": "perspective",
            "fov": 40.0,
            "to_world": T.look_at(origin=[0, 1, 4], target=[0, 0.5, 0], up=[0, 1, 0]),
            "film": {
                "type": "hdrfilm",
                "width": 16,
                "height": 12,
                "component_format": "float32",
                "rfilter": {"type": "box"},
            },
            "sampler": {"type": "independent", "sample_count": 4},
        },
        "clay": {"type": "diffuse", "reflectance": {"type": "rgb", "value": [0.7, 0.4, 0.2]}},
        "floor": {
            "type": "rectangle",
            "to_world": T().scale(3).rotate([1, 0, 0], -90),
            "bsdf": {"type": "ref", "id": "clay"},
        },
        "ball": {
            "type": "sphere",
            "center": [0, 0.6, 0],
            "radius": 0.6,
            "bsdf": {"type": "dielectric"},
        },
        "lamp": {
            "type": "rectangle",
            "to_world": T().translate(0, 3, 0).rotate([1, 0, 0], 90),
            "emitter": {"type": "area", "radiance": {"type": "rgb", "value": [5.0, 6.0, 7.0]}},
        },
    }


def of_cpp(name: str) -> str:
    """The path of a scene of the C++ tests."""
    return str(Path(__file__).resolve().parents[1] / "scenes" / f"{name}.xml")
