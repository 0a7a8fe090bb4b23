"""Programs that Python runs in, such as Blender, bring libraries of their own."""

import shutil
import subprocess
import sys

import pytest

RENDER = """
import ctypes, sys
ctypes.CDLL(sys.argv[1], ctypes.RTLD_GLOBAL)
import pymlt as mlt
scene = mlt.load_dict(mlt.scenes.cornell_box(), size=(8, 8))
assert mlt.render(scene, "path", spp=1).mean() > 0
"""


@pytest.mark.skipif(not shutil.which("cc"), reason="needs a C compiler")
@pytest.mark.parametrize("function", ["rtcNewDevice", "rtcNewGeometry"])
def test_embree_is_our_own_whatever_the_program_has(tmp_path, function):
    """A library that all of a process sees has a function of that name, and ends the process."""
    source, library = tmp_path / "other.c", tmp_path / "libother.so"
    source.write_text(f"#include <stdlib.h>\nvoid {function}(void) {{ _Exit(3); }}\n")
    subprocess.run(["cc", "-shared", "-fPIC", "-o", library, source], check=True)
    done = subprocess.run([sys.executable, "-c", RENDER, library], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
