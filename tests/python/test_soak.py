"""The soak's script, for a few rounds: it is to work on the day when somebody lets it run."""

import subprocess
import sys


def test_a_few_rounds_of_the_soak_find_nothing(repository):
    script = repository / "tests" / "soak.py"
    done = subprocess.run(
        [sys.executable, script, "--seed", "3", "--rounds", "6", "--hours", "0.01", "--no-cluster"],
        capture_output=True,
        text=True,
        timeout=250,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "seed 3: {" in done.stdout
