"""`pymlt lab`: every script of the gallery runs and leaves a figure."""

import sys

import pytest

from pymlt import cli
from pymlt.lab import gallery

matplotlib = pytest.importorskip("matplotlib", reason="matplotlib is not installed")


@pytest.fixture(autouse=True)
def no_window(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    matplotlib.use("agg")


@pytest.mark.parametrize("name", gallery.names())
def test_every_script_draws_its_figure(name, tmp_path):
    assert cli.main(["lab", name, "-o", "figure.png"]) == 0
    from matplotlib import image, pyplot

    pixels = image.imread("figure.png")
    assert min(pixels.shape[:2]) > 300
    assert pixels[..., :3].std() > 0.01
    assert not pyplot.get_fignums()


def test_the_two_state_table_is_printed(capsys):
    cli.main(["lab", "two_states", "-o", "figure.pdf"])
    said = capsys.readouterr()
    assert "a -> b         9    0.5000    0.1111    0.5000" in said.out
    assert said.err.splitlines()[0] == "pymlt: drawing two_states: Two states"


def test_the_list_names_each_script_with_its_topic(capsys):
    assert cli.main(["lab", "--list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == gallery.names()
    assert "parabola        Two mutations and their mixture" in lines


def test_without_a_window_the_figure_is_saved(capsys, tmp_path):
    assert cli.main(["lab", "two_states"]) == 0
    assert (tmp_path / "two_states.png").exists()
    assert "two_states.png" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["parabolla"], "did you mean 'parabola'"),
        ([], "needs --list or the name"),
        (["--list", "parabola"], "needs --list or the name"),
        (["parabola", "-o", "figure.xyz"], "cannot be saved as 'xyz'"),
        (["parabola", "-o", "nowhere/figure.png"], "nowhere"),
    ],
)
def test_mistakes_are_one_line(arguments, message, capsys):
    assert cli.main(["lab", *arguments]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1


def test_without_matplotlib_it_says_what_to_install(capsys, monkeypatch):
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.delitem(sys.modules, "matplotlib.pyplot", raising=False)
    assert cli.main(["lab", "parabola"]) == 2
    assert "pip install 'matplotlib>=" in capsys.readouterr().err
