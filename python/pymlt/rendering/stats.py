"""What a render tells about itself: the type of `stats`, which is the content of stats.json."""

from __future__ import annotations

from typing import NotRequired, TypedDict


class Seconds(TypedDict):
    """Wall times."""

    load: float
    bootstrap: float
    render: float


class Rays(TypedDict):
    """How many were traced."""

    intersect: int
    occluded: int


class Disagreement(TypedDict):
    """A place of which one of the independent groups has seen nearly everything."""

    x: int
    y: int
    share: float | None


class StuckChain(TypedDict):
    """A chain that has rejected many proposals in a row."""

    chain: int
    rejections: int
    x: float | None
    y: float | None
    signature: str


class MutationStats(TypedDict):
    """How a mutation has done for paths of one length."""

    name: str
    length: int
    proposed: int
    generated: int
    accepted: int
    mean_acceptance: float | None
    image_distance: float | None
    rays: int
    failed_walks: int
    failed_returns: int
    weight: float | None
    step_size: float | None


class Stats(TypedDict):
    """None stands for what is not known; what may be left out is left out by `merge`."""

    seed: int | list[str]  #: of a merged image a list
    size: list[int]  #: width, height
    spp_done: float
    renders: NotRequired[int]  #: how many were merged
    version: NotRequired[str]
    integrator: NotRequired[str]
    seconds: NotRequired[Seconds]
    rays: NotRequired[Rays]
    ended_by: NotRequired[str]
    groups: NotRequired[int]
    error: NotRequired[float | None]
    denoised_error: NotRequired[float]  #: of the denoised image, with `denoise=True`
    denoised_flicker: NotRequired[float]  #: of its change from the frame before, in a shot
    block_error: NotRequired[float | None]
    pixels_carrying_error: NotRequired[float | None]
    disagreements: NotRequired[list[Disagreement]]
    b: NotRequired[float | None]
    b_error: NotRequired[float | None]
    level_error: NotRequired[float | None]
    independent_share: NotRequired[float | None]
    independent: NotRequired[str]
    independent_samples: NotRequired[int]
    samples_carrying_half: NotRequired[int]
    tours: NotRequired[int]
    longest_tour: NotRequired[int]
    tours_waiting: NotRequired[float]
    invalid_samples: NotRequired[int]
    stuck: NotRequired[list[StuckChain]]
    mutations: NotRequired[list[MutationStats]]
    fireflies_removed: NotRequired[float]  #: share of the light, with `fireflies="groups"`
    warnings: NotRequired[list[str]]
