"""A process may end while threads of its own are inside the renderer."""

import subprocess
import sys

import pytest

# While the interpreter shuts down, Late.__del__ waits until the daemon thread is back from the
# renderer and has asked for the interpreter's lock.
PROGRAM = """
import sys, threading, time
import pymlt as mlt
import pymlt._core as core
import tiny

scene = mlt.load_dict(tiny.scene(), size=(400, 300))
job = mlt.start(scene, "path", spp=16)
job.wait()
back = threading.Event()

class Late:
    def __del__(self, sleep=time.sleep):
        sleep(0.5)

sys.late = Late()

def calls():
    inside.set()
    while True:
        {call}

inside = threading.Event()
threading.Thread(target=calls, daemon=True).start()
inside.wait()
time.sleep(0.05)
print("the end")
"""


@pytest.mark.parametrize(
    "call",
    [
        "job.image",
        "mlt.load_dict(tiny.scene())",
        "mlt.start(scene, 'path', spp=1e9).wait(0.01)",
        "mlt.audit(mlt.Lens(), scene, paths=20000)",
    ],
)
def test_a_program_may_end_while_a_daemon_thread_is_in_the_renderer(call, repository):
    run = subprocess.run(
        [sys.executable, "-c", PROGRAM.format(call=call)],
        cwd=repository / "tests/python",
        capture_output=True,
        text=True,
        timeout=100,
    )
    assert (run.returncode, run.stdout, run.stderr) == (0, "the end\n", "")
