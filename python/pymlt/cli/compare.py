"""`pymlt compare`: how far an image is from a reference."""

from __future__ import annotations

import json
import math

from .. import _core
from ..diagnostics.comparison import comparison_figure
from ..diagnostics.metrics import compare
from .common import FLAGS, emit, reader, say
from .display import add_display_flags, exposure
from .figures import check_figure_file, save_figure

HELP = "Print how far an image is from a reference."
RELATIVE = ("relmse", "relmse_trimmed", "relmse_median", "relmse_p90")
METRICS = ("mse", "rmse", *RELATIVE, "mape", "bias_z", "flip")


def add_arguments(command) -> None:
    command.add_argument("image", metavar="A")
    command.add_argument("reference", metavar="B")
    command.add_argument("--json", action="store_true", help="print JSON")
    command.add_argument(
        "--picture",
        metavar="FILE",
        help="draw both, their difference, their relative error and FLIP, such as picture.png",
    )
    add_display_flags(command)
    command.add_argument(
        "--fail-above",
        metavar="METRIC=VALUE",
        action="append",
        default=[],
        type=reader(limit),
        help="exit with 1 if the metric (for bias_z: its size) is above; may be repeated",
    )


def limit(text: str) -> tuple[str, float]:
    name, value = FLAGS["defines"].read(text)
    if name not in METRICS:
        raise _core.UsageError(f"unknown metric {name!r}{_core.suggestion(name, list(METRICS))}")
    try:
        return name, float(value)
    except ValueError:
        raise _core.UsageError(f"{value!r} is not a number") from None


def run(args) -> int:
    if args.picture:
        check_figure_file(args.picture)
    wanted = {name for name, _ in args.fail_above}
    metrics = compare(args.image, args.reference, flip=True if "flip" in wanted else None)
    if args.json:
        finite = {k: v if math.isfinite(v) else None for k, v in metrics.items()}
        emit(json.dumps(finite, indent=2))
    else:
        emit("\n".join(f"{name:15} {value:.6g}" for name, value in metrics.items()))
    above = [(n, limit) for n, limit in args.fail_above if not abs(metrics[n]) <= limit]
    for name, limit in above:
        say(f"{name} is {metrics[name]:.6g}, above {limit:g}")
    unknown = math.isnan(metrics["mse"])
    if unknown:
        say("the images have pixels that are no numbers, so their errors are none either")
    code = draw(args) if args.picture else 0
    return code or (1 if above or unknown else 0)


def draw(args) -> int:
    figure = comparison_figure(
        args.image, args.reference, exposure=exposure(args), tonemap=args.tonemap
    )
    return save_figure(figure, args.picture)
