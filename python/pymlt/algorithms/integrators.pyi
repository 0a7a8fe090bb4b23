# Made by `python -m pymlt._stubs`. Do not edit.
from collections.abc import Sequence
from typing import Any, Literal

from .integrator import Integrator
from .mutation import Mutation

def class_name(plugin: str) -> str: ...
def integrator_schema(plugin: str) -> dict[str, Any]: ...

class Aov(Integrator):
    """What the camera sees first, without light: the image is the first of its layers. Around
    another integrator it adds its layers to that one's image.

    Parameters
    ----------
    aovs : string, default 'albedo'
        Layers, each with a name or without: albedo:albedo, nn:sh_normal, ...
    """

    aovs: str
    def __init__(
        self,
        *,
        aovs: str = "albedo",
    ) -> None: ...

class BDPT(Integrator):
    """Bidirectional path tracing with every technique (s, t) and multiple importance sampling
    (Veach & Guibas 1994; Veach 1997, ch. 10). One spp is a camera and a light path per pixel.

    Parameters
    ----------
    max_depth : integer, default -1
        Edges of the longest path: 1 shows the lights alone, 2 adds direct light, -1 stands for
        4096, which is also the most.
    rr_depth : integer, default 5
        Depth from which on Russian roulette may end a path.
    hide_emitters : boolean, default False
        Leave out lights that the camera sees directly.
    strict_normals : boolean, default False
        Refuse directions that the geometric and the shading normal see on different sides.
    waves : boolean, default True
        Trace many paths side by side where that is possible (cpp/wave); else one by one, by the
        code that defines them (cpp/path). Both make the same image.
    light_groups : boolean, default False
        Keep the light of each lamp as a layer: `light.` with its id. They add up to the image,
        and each has a layer of its error, such as `error.light.lamp`.
    exposure_layers : boolean, default False
        Keep the light of each of the sensor's `exposures` as a layer, such as `exposure.1`,
        with a layer of its error. They add up to the image.
    light_layers : string, default ''
        Keep the light of classes of paths as layers: `caustics=LS+DE lit=L(D|M)E`, names with
        regular expressions over the letters of a path from the light to the eye: L, S for each
        mirror or smooth glass, D for any other surface, M in a medium, E. Samples are then
        taken one by one.
    light_image : boolean, default True
        Use techniques that connect light paths to the lens (t <= 1).
    sample_direct : boolean, default True
        Technique s = 1 chooses the light as seen from the point to be lit.
    heuristic : string, default 'power'
        How techniques are combined (Veach 1997, sec. 9.2). One of: balance, power, maximum.
    techniques : boolean, default False
        Keep the image of each technique, raw and weighted; needs a max_depth of 16 or less.
    manifolds : boolean, default False
        Find lights across chains of mirrors and glass, too (specular manifold sampling,
        Zeltner, Georgiev & Jakob 2020), where other techniques find them too rarely.
    through_boundaries : boolean, default True
        In media with rough boundaries that refract, such as wax and skin, light is also sampled
        through these. Samples are then taken one by one.
    """

    max_depth: int
    rr_depth: int
    hide_emitters: bool
    strict_normals: bool
    waves: bool
    light_groups: bool
    exposure_layers: bool
    light_layers: str
    light_image: bool
    sample_direct: bool
    heuristic: Literal["balance", "power", "maximum"]
    techniques: bool
    manifolds: bool
    through_boundaries: bool
    def __init__(
        self,
        *,
        max_depth: int = -1,
        rr_depth: int = 5,
        hide_emitters: bool = False,
        strict_normals: bool = False,
        waves: bool = True,
        light_groups: bool = False,
        exposure_layers: bool = False,
        light_layers: str = "",
        light_image: bool = True,
        sample_direct: bool = True,
        heuristic: Literal["balance", "power", "maximum"] = "power",
        techniques: bool = False,
        manifolds: bool = False,
        through_boundaries: bool = True,
    ) -> None: ...

class Depth(Integrator):
    """The distance from the camera to the surface that it sees first, or 0."""

    def __init__(
        self,
    ) -> None: ...

class Direct(Integrator):
    """Direct light: one reflection at the most, sampled from lights and BSDFs (Veach 1997, sec.
    9.2). One spp is one camera ray per pixel.

    Parameters
    ----------
    shading_samples : integer, default 1
        Sets both of the numbers below.
    emitter_samples : integer
        Samples of lights per camera ray (default: shading_samples).
    bsdf_samples : integer
        Samples of the BSDF per camera ray (default: shading_samples).
    hide_emitters : boolean, default False
        Leave out lights that the camera sees directly.
    strict_normals : boolean, default False
        Refuse directions that the geometric and the shading normal see on different sides.
    waves : boolean, default True
        Trace many paths side by side where that is possible (cpp/wave); else one by one, by the
        code that defines them (cpp/path). Both make the same image.
    light_groups : boolean, default False
        Keep the light of each lamp as a layer: `light.` with its id. They add up to the image,
        and each has a layer of its error, such as `error.light.lamp`.
    exposure_layers : boolean, default False
        Keep the light of each of the sensor's `exposures` as a layer, such as `exposure.1`,
        with a layer of its error. They add up to the image.
    light_layers : string, default ''
        Keep the light of classes of paths as layers: `caustics=LS+DE lit=L(D|M)E`, names with
        regular expressions over the letters of a path from the light to the eye: L, S for each
        mirror or smooth glass, D for any other surface, M in a medium, E. Samples are then
        taken one by one.
    """

    shading_samples: int
    emitter_samples: int | None
    bsdf_samples: int | None
    hide_emitters: bool
    strict_normals: bool
    waves: bool
    light_groups: bool
    exposure_layers: bool
    light_layers: str
    def __init__(
        self,
        *,
        shading_samples: int = 1,
        emitter_samples: int | None = None,
        bsdf_samples: int | None = None,
        hide_emitters: bool = False,
        strict_normals: bool = False,
        waves: bool = True,
        light_groups: bool = False,
        exposure_layers: bool = False,
        light_layers: str = "",
    ) -> None: ...

class ERPT(Integrator):
    """Energy redistribution path tracing (Cline et al. 2005): short chains from the paths of
    bidirectional path tracing, moved by the perturbations of mlt. One spp is one mutation per
    pixel.

    Parameters
    ----------
    max_depth : integer, default -1
        Edges of the longest path: 1 shows the lights alone, 2 adds direct light, -1 stands for
        4096, which is also the most.
    rr_depth : integer, default 5
        Depth from which on Russian roulette may end a path.
    hide_emitters : boolean, default False
        Leave out lights that the camera sees directly.
    strict_normals : boolean, default False
        Refuse directions that the geometric and the shading normal see on different sides.
    waves : boolean, default True
        Trace many paths side by side where that is possible (cpp/wave); else one by one, by the
        code that defines them (cpp/path). Both make the same image.
    light_groups : boolean, default False
        Keep the light of each lamp as a layer: `light.` with its id. They add up to the image,
        and each has a layer of its error, such as `error.light.lamp`.
    exposure_layers : boolean, default False
        Keep the light of each of the sensor's `exposures` as a layer, such as `exposure.1`,
        with a layer of its error. They add up to the image.
    light_layers : string, default ''
        Keep the light of classes of paths as layers: `caustics=LS+DE lit=L(D|M)E`, names with
        regular expressions over the letters of a path from the light to the eye: L, S for each
        mirror or smooth glass, D for any other surface, M in a medium, E. Samples are then
        taken one by one.
    luminance_samples : integer, default 50000
        Paths drawn before the render, from which the division of its time is found.
    chains : integer, default 128
        Number of Markov chains, each of which starts over and over. It hardly matters, but no
        more threads than chains have work.
    lens_perturbation : boolean, default True
        Use the lens perturbation of paths (L|D)DS*E and LS*E (Veach 1997, sec. 11.3.3.1).
    lens_weight : float, default 0.3
        Weight of the lens mutation among those that suit a path.
    lens_smallest_pixels : float, default 0.1
        Smallest move on the image, in pixels.
    lens_largest_share : float, default 0.1
        Largest move on the image, as a share of its diagonal.
    caustic_perturbation : boolean, default True
        Use the caustic perturbation of paths (L|D)S*DE (Veach 1997, sec. 11.3.3.2).
    caustic_weight : float, default 0.2
        Weight of the caustic mutation among those that suit a path.
    caustic_smallest_pixels : float, default 0.1
        Smallest move on the image, in pixels.
    caustic_largest_share : float, default 0.1
        Largest move on the image, as a share of its diagonal.
    caustic_anisotropic : boolean, default True
        Turn the direction by an ellipse whose image is round, not by a circle.
    multi_chain_perturbation : boolean, default True
        Use the multi-chain perturbation of paths (L|D)(DS+)+DS*E and L(S+D)+S*E (Veach 1997,
        sec. 11.3.3.3).
    multi_chain_weight : float, default 0.2
        Weight of the multi_chain mutation among those that suit a path.
    multi_chain_smallest_pixels : float, default 0.1
        Smallest move on the image, in pixels.
    multi_chain_largest_share : float, default 0.1
        Largest move on the image, as a share of its diagonal.
    manifold_perturbation : boolean, default True
        Use the manifold perturbation of what is lit through specular chains (Jakob & Marschner
        2012, sec. 5).
    manifold_weight : float, default 0.2
        Weight of the manifold mutation among those that suit a path.
    manifold_smallest_pixels : float, default 0.1
        Smallest move on the image, in pixels.
    manifold_largest_share : float, default 0.1
        Largest move on the image, as a share of its diagonal.
    translucent_perturbation : boolean, default True
        Use the perturbation of the image position that keeps directions and distances in media
        and behind rough glass (after Gruson et al. 2018).
    translucent_weight : float, default 0.2
        Weight of the translucent mutation among those that suit a path.
    translucent_smallest_pixels : float, default 0.1
        Smallest move on the image, in pixels.
    translucent_largest_share : float, default 0.1
        Largest move on the image, as a share of its diagonal.
    near_specular : float, default 0.1
        Smooth vertices below this roughness count as specular in perturbations.
    tours : float, default 0.1
        Tours per sample of bidirectional path tracing, in the mean. The fewer, the more samples
        they start from.
    tour_length : float, default 100.0
        Mutations of each tour, in the mean.
    """

    max_depth: int
    rr_depth: int
    hide_emitters: bool
    strict_normals: bool
    waves: bool
    light_groups: bool
    exposure_layers: bool
    light_layers: str
    luminance_samples: int
    chains: int
    lens_perturbation: bool
    lens_weight: float
    lens_smallest_pixels: float
    lens_largest_share: float
    caustic_perturbation: bool
    caustic_weight: float
    caustic_smallest_pixels: float
    caustic_largest_share: float
    caustic_anisotropic: bool
    multi_chain_perturbation: bool
    multi_chain_weight: float
    multi_chain_smallest_pixels: float
    multi_chain_largest_share: float
    manifold_perturbation: bool
    manifold_weight: float
    manifold_smallest_pixels: float
    manifold_largest_share: float
    translucent_perturbation: bool
    translucent_weight: float
    translucent_smallest_pixels: float
    translucent_largest_share: float
    near_specular: float
    tours: float
    tour_length: float
    def __init__(
        self,
        *,
        max_depth: int = -1,
        rr_depth: int = 5,
        hide_emitters: bool = False,
        strict_normals: bool = False,
        waves: bool = True,
        light_groups: bool = False,
        exposure_layers: bool = False,
        light_layers: str = "",
        luminance_samples: int = 50000,
        chains: int = 128,
        lens_perturbation: bool = True,
        lens_weight: float = 0.3,
        lens_smallest_pixels: float = 0.1,
        lens_largest_share: float = 0.1,
        caustic_perturbation: bool = True,
        caustic_weight: float = 0.2,
        caustic_smallest_pixels: float = 0.1,
        caustic_largest_share: float = 0.1,
        caustic_anisotropic: bool = True,
        multi_chain_perturbation: bool = True,
        multi_chain_weight: float = 0.2,
        multi_chain_smallest_pixels: float = 0.1,
        multi_chain_largest_share: float = 0.1,
        manifold_perturbation: bool = True,
        manifold_weight: float = 0.2,
        manifold_smallest_pixels: float = 0.1,
        manifold_largest_share: float = 0.1,
        translucent_perturbation: bool = True,
        translucent_weight: float = 0.2,
        translucent_smallest_pixels: float = 0.1,
        translucent_largest_share: float = 0.1,
        near_specular: float = 0.1,
        tours: float = 0.1,
        tour_length: float = 100.0,
    ) -> None: ...

class MLT(Integrator):
    """Metropolis light transport in path space with Veach's mutations (Veach & Guibas 1997). One
    spp is one mutation per pixel.

    Parameters
    ----------
    max_depth : integer, default -1
        Edges of the longest path: 1 shows the lights alone, 2 adds direct light, -1 stands for
        4096, which is also the most.
    rr_depth : integer, default 5
        Depth from which on Russian roulette may end a path.
    hide_emitters : boolean, default False
        Leave out lights that the camera sees directly.
    strict_normals : boolean, default False
        Refuse directions that the geometric and the shading normal see on different sides.
    waves : boolean, default True
        Trace many paths side by side where that is possible (cpp/wave); else one by one, by the
        code that defines them (cpp/path). Both make the same image.
    light_groups : boolean, default False
        Keep the light of each lamp as a layer: `light.` with its id. They add up to the image,
        and each has a layer of its error, such as `error.light.lamp`.
    exposure_layers : boolean, default False
        Keep the light of each of the sensor's `exposures` as a layer, such as `exposure.1`,
        with a layer of its error. They add up to the image.
    light_layers : string, default ''
        Keep the light of classes of paths as layers: `caustics=LS+DE lit=L(D|M)E`, names with
        regular expressions over the letters of a path from the light to the eye: L, S for each
        mirror or smooth glass, D for any other surface, M in a medium, E. Samples are then
        taken one by one.
    luminance_samples : integer, default 50000
        Paths drawn before the render, from which the division of its time is found.
    chains : integer, default 128
        Number of Markov chains, each of which starts over and over. It hardly matters, but no
        more threads than chains have work.
    independent_share : float
        Share of the time for samples that are independent of the chains, 0 to 1. They show what
        they are good at, and tell the brightness b. By default the first samples tell the best
        one; 1: there are no chains.
    parts : boolean, default False
        Keep what chains and samples show of the image as layers `chains` and `samples`.
    bidirectional_mutation : boolean, default True
        Use the bidirectional mutation, which replaces any piece of the path (Veach 1997, sec.
        11.3.1).
    bidirectional_weight : float, default 0.3
        Weight of the bidirectional mutation among those that suit a path.
    lens_perturbation : boolean, default True
        Use the lens perturbation of paths (L|D)DS*E and LS*E (Veach 1997, sec. 11.3.3.1).
    lens_weight : float, default 0.3
        Weight of the lens mutation among those that suit a path.
    lens_smallest_pixels : float, default 0.1
        Smallest move on the image, in pixels.
    lens_largest_share : float, default 0.1
        Largest move on the image, as a share of its diagonal.
    caustic_perturbation : boolean, default True
        Use the caustic perturbation of paths (L|D)S*DE (Veach 1997, sec. 11.3.3.2).
    caustic_weight : float, default 0.2
        Weight of the caustic mutation among those that suit a path.
    caustic_smallest_pixels : float, default 0.1
        Smallest move on the image, in pixels.
    caustic_largest_share : float, default 0.1
        Largest move on the image, as a share of its diagonal.
    caustic_anisotropic : boolean, default True
        Turn the direction by an ellipse whose image is round, not by a circle.
    multi_chain_perturbation : boolean, default True
        Use the multi-chain perturbation of paths (L|D)(DS+)+DS*E and L(S+D)+S*E (Veach 1997,
        sec. 11.3.3.3).
    multi_chain_weight : float, default 0.2
        Weight of the multi_chain mutation among those that suit a path.
    multi_chain_smallest_pixels : float, default 0.1
        Smallest move on the image, in pixels.
    multi_chain_largest_share : float, default 0.1
        Largest move on the image, as a share of its diagonal.
    lens_subpath_mutation : boolean, default True
        Use the lens subpath mutation, which draws a fresh camera end (Veach 1997, sec. 11.3.4).
    lens_subpath_weight : float, default 0.1
        Weight of the lens_subpath mutation among those that suit a path.
    multiplexed_perturbation : boolean, default False
        Use the small step in primary sample space, by a technique that can make the path (Otsu
        et al. 2017).
    multiplexed_weight : float, default 0.1
        Weight of the multiplexed mutation among those that suit a path.
    multiplexed_step_size : float, default 0.015625
        Largest move of a number in [0, 1).
    manifold_perturbation : boolean, default True
        Use the manifold perturbation of what is lit through specular chains (Jakob & Marschner
        2012, sec. 5).
    manifold_weight : float, default 0.2
        Weight of the manifold mutation among those that suit a path.
    manifold_smallest_pixels : float, default 0.1
        Smallest move on the image, in pixels.
    manifold_largest_share : float, default 0.1
        Largest move on the image, as a share of its diagonal.
    propagation_mutation : boolean, default True
        Use the propagation of vertices in media along their edges (Pauly et al. 2000, sec.
        4.2).
    propagation_weight : float, default 0.2
        Weight of the propagation mutation among those that suit a path.
    propagation_smallest_move : float, default 0.001
        Smallest change of the logarithm of the distance.
    propagation_largest_move : float, default 1.0
        Largest change of the logarithm of the distance.
    translucent_perturbation : boolean, default True
        Use the perturbation of the image position that keeps directions and distances in media
        and behind rough glass (after Gruson et al. 2018).
    translucent_weight : float, default 0.2
        Weight of the translucent mutation among those that suit a path.
    translucent_smallest_pixels : float, default 0.1
        Smallest move on the image, in pixels.
    translucent_largest_share : float, default 0.1
        Largest move on the image, as a share of its diagonal.
    wavelength_mutation : boolean, default True
        Use the another wavelength for the same path; dispersive chains are found again.
    wavelength_weight : float, default 0.2
        Weight of the wavelength mutation among those that suit a path.
    wavelength_smallest_step : float, default 0.0005
        Smallest step, as a share of the visible range in the measure of what the eye sees, or
        of a band.
    wavelength_largest_step : float, default 0.1
        Largest step, likewise.
    near_specular : float, default 0.1
        Smooth vertices below this roughness count as specular in perturbations.
    adaptive : boolean, default True
        Let pilot chains find the weights and step sizes of the mutations; by default only if no
        weight is given, and never for a step size that is given.
    two_stage : boolean, default True
        Divide the target by a coarse image, so that dark regions get their share.
    manifolds : boolean, default True
        Tours start from lights found across chains of mirrors and glass, too (specular manifold
        sampling, Zeltner, Georgiev & Jakob 2020), where other samples find them too rarely.
    delayed_rejection : boolean, default False
        Let a smaller step follow where a perturbation's proposal was rejected.
    independent : string, default 'auto'
        What the independent samples are: those of bidirectional path tracing, or of path
        tracing, which are cheaper; by default, those with less noise in the end. One of: auto,
        bdpt, path.
    spark : float, default 1.0
        A tour, the mutations from one start of a chain, waits before it leaves more light in a
        pixel than this many times what pixels have received in the mean by then (up to three
        times as much where nearly all light is left to tours). 0: none waits; the image is then
        right in the mean from the start, but may have sparks.
    patience : float
        Replaced by `spark`; it is refused.
    direct_samples : integer, default -1
        Render light of at most one reflection apart with this many samples per pixel; 0 leaves
        it out, -1 leaves it to the chains.
    mutations : list of mutations
        Those that take part, such as [(Bidirectional(), 0.4), (Lens(), 0.6)], in place of the
        parameters for each; others are off, and so is `adaptive` unless it is given.
    """

    max_depth: int
    rr_depth: int
    hide_emitters: bool
    strict_normals: bool
    waves: bool
    light_groups: bool
    exposure_layers: bool
    light_layers: str
    luminance_samples: int
    chains: int
    independent_share: float | None
    parts: bool
    bidirectional_mutation: bool
    bidirectional_weight: float
    lens_perturbation: bool
    lens_weight: float
    lens_smallest_pixels: float
    lens_largest_share: float
    caustic_perturbation: bool
    caustic_weight: float
    caustic_smallest_pixels: float
    caustic_largest_share: float
    caustic_anisotropic: bool
    multi_chain_perturbation: bool
    multi_chain_weight: float
    multi_chain_smallest_pixels: float
    multi_chain_largest_share: float
    lens_subpath_mutation: bool
    lens_subpath_weight: float
    multiplexed_perturbation: bool
    multiplexed_weight: float
    multiplexed_step_size: float
    manifold_perturbation: bool
    manifold_weight: float
    manifold_smallest_pixels: float
    manifold_largest_share: float
    propagation_mutation: bool
    propagation_weight: float
    propagation_smallest_move: float
    propagation_largest_move: float
    translucent_perturbation: bool
    translucent_weight: float
    translucent_smallest_pixels: float
    translucent_largest_share: float
    wavelength_mutation: bool
    wavelength_weight: float
    wavelength_smallest_step: float
    wavelength_largest_step: float
    near_specular: float
    adaptive: bool
    two_stage: bool
    manifolds: bool
    delayed_rejection: bool
    independent: Literal["auto", "bdpt", "path"]
    spark: float
    patience: float | None
    direct_samples: int
    mutations: Sequence[Mutation | tuple[Mutation, float]] | None
    def __init__(
        self,
        *,
        max_depth: int = -1,
        rr_depth: int = 5,
        hide_emitters: bool = False,
        strict_normals: bool = False,
        waves: bool = True,
        light_groups: bool = False,
        exposure_layers: bool = False,
        light_layers: str = "",
        luminance_samples: int = 50000,
        chains: int = 128,
        independent_share: float | None = None,
        parts: bool = False,
        bidirectional_mutation: bool = True,
        bidirectional_weight: float = 0.3,
        lens_perturbation: bool = True,
        lens_weight: float = 0.3,
        lens_smallest_pixels: float = 0.1,
        lens_largest_share: float = 0.1,
        caustic_perturbation: bool = True,
        caustic_weight: float = 0.2,
        caustic_smallest_pixels: float = 0.1,
        caustic_largest_share: float = 0.1,
        caustic_anisotropic: bool = True,
        multi_chain_perturbation: bool = True,
        multi_chain_weight: float = 0.2,
        multi_chain_smallest_pixels: float = 0.1,
        multi_chain_largest_share: float = 0.1,
        lens_subpath_mutation: bool = True,
        lens_subpath_weight: float = 0.1,
        multiplexed_perturbation: bool = False,
        multiplexed_weight: float = 0.1,
        multiplexed_step_size: float = 0.015625,
        manifold_perturbation: bool = True,
        manifold_weight: float = 0.2,
        manifold_smallest_pixels: float = 0.1,
        manifold_largest_share: float = 0.1,
        propagation_mutation: bool = True,
        propagation_weight: float = 0.2,
        propagation_smallest_move: float = 0.001,
        propagation_largest_move: float = 1.0,
        translucent_perturbation: bool = True,
        translucent_weight: float = 0.2,
        translucent_smallest_pixels: float = 0.1,
        translucent_largest_share: float = 0.1,
        wavelength_mutation: bool = True,
        wavelength_weight: float = 0.2,
        wavelength_smallest_step: float = 0.0005,
        wavelength_largest_step: float = 0.1,
        near_specular: float = 0.1,
        adaptive: bool = True,
        two_stage: bool = True,
        manifolds: bool = True,
        delayed_rejection: bool = False,
        independent: Literal["auto", "bdpt", "path"] = "auto",
        spark: float = 1.0,
        patience: float | None = None,
        direct_samples: int = -1,
        mutations: Sequence[Mutation | tuple[Mutation, float]] | None = None,
    ) -> None: ...

class MMLT(Integrator):
    """Multiplexed Metropolis light transport (Hachisuka et al. 2014): mutates the random numbers
    of one path and the technique (s, t) that makes it. One spp is one mutation per pixel.

    Parameters
    ----------
    max_depth : integer, default -1
        Edges of the longest path: 1 shows the lights alone, 2 adds direct light, -1 stands for
        4096, which is also the most.
    rr_depth : integer, default 5
        Depth from which on Russian roulette may end a path.
    hide_emitters : boolean, default False
        Leave out lights that the camera sees directly.
    strict_normals : boolean, default False
        Refuse directions that the geometric and the shading normal see on different sides.
    waves : boolean, default True
        Trace many paths side by side where that is possible (cpp/wave); else one by one, by the
        code that defines them (cpp/path). Both make the same image.
    light_groups : boolean, default False
        Keep the light of each lamp as a layer: `light.` with its id. They add up to the image,
        and each has a layer of its error, such as `error.light.lamp`.
    exposure_layers : boolean, default False
        Keep the light of each of the sensor's `exposures` as a layer, such as `exposure.1`,
        with a layer of its error. They add up to the image.
    light_layers : string, default ''
        Keep the light of classes of paths as layers: `caustics=LS+DE lit=L(D|M)E`, names with
        regular expressions over the letters of a path from the light to the eye: L, S for each
        mirror or smooth glass, D for any other surface, M in a medium, E. Samples are then
        taken one by one.
    luminance_samples : integer, default 50000
        Paths drawn to start the chains from; as many are drawn before, to divide the time.
    chains : integer, default 128
        Number of Markov chains, whatever the budget. The fewer there are, the longer each is,
        and the farther it gets from where it started; but one that stands still leaves a
        brighter spot, and no more threads than chains have work.
    independent_share : float
        Share of the time for samples that are independent of the chains, 0 to 1. They show what
        they are good at, and tell the brightness b. By default the first samples tell the best
        one; 1: there are no chains.
    parts : boolean, default False
        Keep what chains and samples show of the image as layers `chains` and `samples`.
    p_large : float, default 0.3
        Probability of a large step, which draws a new path independently.
    small_step : string, default 'kelemen'
        How a small step moves a number: `kelemen` by 1/16 of the step size up to all of it, or
        `gaussian`. One of: kelemen, gaussian.
    step_size : float
        The largest move of a small step, by default 1/32, or the standard deviation of a
        Gaussian one, by default 0.01.
    delayed_rejection : boolean, default False
        Let a small step follow a large one that was rejected.
    p_technique : float, default 0.1
        Probability of a small step that also draws another technique for the same length.
    """

    max_depth: int
    rr_depth: int
    hide_emitters: bool
    strict_normals: bool
    waves: bool
    light_groups: bool
    exposure_layers: bool
    light_layers: str
    luminance_samples: int
    chains: int
    independent_share: float | None
    parts: bool
    p_large: float
    small_step: Literal["kelemen", "gaussian"]
    step_size: float | None
    delayed_rejection: bool
    p_technique: float
    def __init__(
        self,
        *,
        max_depth: int = -1,
        rr_depth: int = 5,
        hide_emitters: bool = False,
        strict_normals: bool = False,
        waves: bool = True,
        light_groups: bool = False,
        exposure_layers: bool = False,
        light_layers: str = "",
        luminance_samples: int = 50000,
        chains: int = 128,
        independent_share: float | None = None,
        parts: bool = False,
        p_large: float = 0.3,
        small_step: Literal["kelemen", "gaussian"] = "kelemen",
        step_size: float | None = None,
        delayed_rejection: bool = False,
        p_technique: float = 0.1,
    ) -> None: ...

class Path(Integrator):
    """Path tracing from the camera with next-event estimation and multiple importance sampling
    (Kajiya 1986; Veach & Guibas 1995). One spp is one camera path per pixel.

    Parameters
    ----------
    max_depth : integer, default -1
        Edges of the longest path: 1 shows the lights alone, 2 adds direct light, -1 stands for
        4096, which is also the most.
    rr_depth : integer, default 5
        Depth from which on Russian roulette may end a path.
    hide_emitters : boolean, default False
        Leave out lights that the camera sees directly.
    strict_normals : boolean, default False
        Refuse directions that the geometric and the shading normal see on different sides.
    waves : boolean, default True
        Trace many paths side by side where that is possible (cpp/wave); else one by one, by the
        code that defines them (cpp/path). Both make the same image.
    equiangular : boolean, default False
        In media, light is also gathered where a ray passes near a lamp (Kulla & Fajardo 2012).
        That pays where lamps stand in thin fog. Samples are then taken one by one.
    through_boundaries : boolean, default True
        In media with rough boundaries that refract, such as wax and skin, light is also sampled
        through these. Samples are then taken one by one.
    light_groups : boolean, default False
        Keep the light of each lamp as a layer: `light.` with its id. They add up to the image,
        and each has a layer of its error, such as `error.light.lamp`.
    exposure_layers : boolean, default False
        Keep the light of each of the sensor's `exposures` as a layer, such as `exposure.1`,
        with a layer of its error. They add up to the image.
    light_layers : string, default ''
        Keep the light of classes of paths as layers: `caustics=LS+DE lit=L(D|M)E`, names with
        regular expressions over the letters of a path from the light to the eye: L, S for each
        mirror or smooth glass, D for any other surface, M in a medium, E. Samples are then
        taken one by one.
    """

    max_depth: int
    rr_depth: int
    hide_emitters: bool
    strict_normals: bool
    waves: bool
    equiangular: bool
    through_boundaries: bool
    light_groups: bool
    exposure_layers: bool
    light_layers: str
    def __init__(
        self,
        *,
        max_depth: int = -1,
        rr_depth: int = 5,
        hide_emitters: bool = False,
        strict_normals: bool = False,
        waves: bool = True,
        equiangular: bool = False,
        through_boundaries: bool = True,
        light_groups: bool = False,
        exposure_layers: bool = False,
        light_layers: str = "",
    ) -> None: ...

class PSSMLT(Integrator):
    """Primary-sample-space Metropolis light transport (Kelemen et al. 2002): mutates the random
    numbers of another integrator. One spp is one mutation per pixel.

    Parameters
    ----------
    max_depth : integer, default -1
        Edges of the longest path: 1 shows the lights alone, 2 adds direct light, -1 stands for
        4096, which is also the most.
    rr_depth : integer, default 5
        Depth from which on Russian roulette may end a path.
    hide_emitters : boolean, default False
        Leave out lights that the camera sees directly.
    strict_normals : boolean, default False
        Refuse directions that the geometric and the shading normal see on different sides.
    waves : boolean, default True
        Trace many paths side by side where that is possible (cpp/wave); else one by one, by the
        code that defines them (cpp/path). Both make the same image.
    light_groups : boolean, default False
        Keep the light of each lamp as a layer: `light.` with its id. They add up to the image,
        and each has a layer of its error, such as `error.light.lamp`.
    exposure_layers : boolean, default False
        Keep the light of each of the sensor's `exposures` as a layer, such as `exposure.1`,
        with a layer of its error. They add up to the image.
    light_layers : string, default ''
        Keep the light of classes of paths as layers: `caustics=LS+DE lit=L(D|M)E`, names with
        regular expressions over the letters of a path from the light to the eye: L, S for each
        mirror or smooth glass, D for any other surface, M in a medium, E. Samples are then
        taken one by one.
    luminance_samples : integer, default 50000
        Paths drawn to start the chains from; as many are drawn before, to divide the time.
    chains : integer, default 256
        Number of Markov chains, whatever the budget. The fewer there are, the longer each is,
        and the farther it gets from where it started; but one that stands still leaves a
        brighter spot, and no more threads than chains have work.
    independent_share : float
        Share of the time for samples that are independent of the chains, 0 to 1. They show what
        they are good at, and tell the brightness b. By default the first samples tell the best
        one; 1: there are no chains.
    parts : boolean, default False
        Keep what chains and samples show of the image as layers `chains` and `samples`.
    p_large : float, default 0.3
        Probability of a large step, which draws a new path independently.
    small_step : string, default 'kelemen'
        How a small step moves a number: `kelemen` by 1/16 of the step size up to all of it, or
        `gaussian`. One of: kelemen, gaussian.
    step_size : float
        The largest move of a small step, by default 1/32, or the standard deviation of a
        Gaussian one, by default 0.01.
    delayed_rejection : boolean, default False
        Let a small step follow a large one that was rejected.
    estimator : string, default 'path'
        The integrator whose numbers are mutated: `path`, `bdpt`, or `ptracer`, which does not
        see lights directly or in mirrors. One of: path, bdpt, ptracer.
    bidirectional : boolean
        True stands for the estimator `bdpt`, as in Mitsuba 0.6.
    """

    max_depth: int
    rr_depth: int
    hide_emitters: bool
    strict_normals: bool
    waves: bool
    light_groups: bool
    exposure_layers: bool
    light_layers: str
    luminance_samples: int
    chains: int
    independent_share: float | None
    parts: bool
    p_large: float
    small_step: Literal["kelemen", "gaussian"]
    step_size: float | None
    delayed_rejection: bool
    estimator: Literal["path", "bdpt", "ptracer"]
    bidirectional: bool | None
    def __init__(
        self,
        *,
        max_depth: int = -1,
        rr_depth: int = 5,
        hide_emitters: bool = False,
        strict_normals: bool = False,
        waves: bool = True,
        light_groups: bool = False,
        exposure_layers: bool = False,
        light_layers: str = "",
        luminance_samples: int = 50000,
        chains: int = 256,
        independent_share: float | None = None,
        parts: bool = False,
        p_large: float = 0.3,
        small_step: Literal["kelemen", "gaussian"] = "kelemen",
        step_size: float | None = None,
        delayed_rejection: bool = False,
        estimator: Literal["path", "bdpt", "ptracer"] = "path",
        bidirectional: bool | None = None,
    ) -> None: ...

class PTracer(Integrator):
    """Light tracing: walks from the lights, connected to the lens at each vertex (Dutre et al.
    1993). One spp is one light path per pixel.

    Parameters
    ----------
    max_depth : integer, default -1
        Edges of the longest path: 1 shows the lights alone, 2 adds direct light, -1 stands for
        4096, which is also the most.
    rr_depth : integer, default 5
        Depth from which on Russian roulette may end a path.
    hide_emitters : boolean, default False
        Leave out lights that the camera sees directly.
    strict_normals : boolean, default False
        Refuse directions that the geometric and the shading normal see on different sides.
    waves : boolean, default True
        Trace many paths side by side where that is possible (cpp/wave); else one by one, by the
        code that defines them (cpp/path). Both make the same image.
    light_groups : boolean, default False
        Keep the light of each lamp as a layer: `light.` with its id. They add up to the image,
        and each has a layer of its error, such as `error.light.lamp`.
    exposure_layers : boolean, default False
        Keep the light of each of the sensor's `exposures` as a layer, such as `exposure.1`,
        with a layer of its error. They add up to the image.
    light_layers : string, default ''
        Keep the light of classes of paths as layers: `caustics=LS+DE lit=L(D|M)E`, names with
        regular expressions over the letters of a path from the light to the eye: L, S for each
        mirror or smooth glass, D for any other surface, M in a medium, E. Samples are then
        taken one by one.
    """

    max_depth: int
    rr_depth: int
    hide_emitters: bool
    strict_normals: bool
    waves: bool
    light_groups: bool
    exposure_layers: bool
    light_layers: str
    def __init__(
        self,
        *,
        max_depth: int = -1,
        rr_depth: int = 5,
        hide_emitters: bool = False,
        strict_normals: bool = False,
        waves: bool = True,
        light_groups: bool = False,
        exposure_layers: bool = False,
        light_layers: str = "",
    ) -> None: ...

class RJMLT(Integrator):
    """Reversible jump Metropolis light transport (Bitterli et al. 2018): as mmlt, but a step that
    changes the technique keeps the path. One spp is one mutation per pixel.

    Parameters
    ----------
    max_depth : integer, default -1
        Edges of the longest path: 1 shows the lights alone, 2 adds direct light, -1 stands for
        4096, which is also the most.
    rr_depth : integer, default 5
        Depth from which on Russian roulette may end a path.
    hide_emitters : boolean, default False
        Leave out lights that the camera sees directly.
    strict_normals : boolean, default False
        Refuse directions that the geometric and the shading normal see on different sides.
    waves : boolean, default True
        Trace many paths side by side where that is possible (cpp/wave); else one by one, by the
        code that defines them (cpp/path). Both make the same image.
    light_groups : boolean, default False
        Keep the light of each lamp as a layer: `light.` with its id. They add up to the image,
        and each has a layer of its error, such as `error.light.lamp`.
    exposure_layers : boolean, default False
        Keep the light of each of the sensor's `exposures` as a layer, such as `exposure.1`,
        with a layer of its error. They add up to the image.
    light_layers : string, default ''
        Keep the light of classes of paths as layers: `caustics=LS+DE lit=L(D|M)E`, names with
        regular expressions over the letters of a path from the light to the eye: L, S for each
        mirror or smooth glass, D for any other surface, M in a medium, E. Samples are then
        taken one by one.
    luminance_samples : integer, default 50000
        Paths drawn to start the chains from; as many are drawn before, to divide the time.
    chains : integer, default 128
        Number of Markov chains, whatever the budget. The fewer there are, the longer each is,
        and the farther it gets from where it started; but one that stands still leaves a
        brighter spot, and no more threads than chains have work.
    independent_share : float
        Share of the time for samples that are independent of the chains, 0 to 1. They show what
        they are good at, and tell the brightness b. By default the first samples tell the best
        one; 1: there are no chains.
    parts : boolean, default False
        Keep what chains and samples show of the image as layers `chains` and `samples`.
    p_large : float, default 0.3
        Probability of a large step, which draws a new path independently.
    small_step : string, default 'kelemen'
        How a small step moves a number: `kelemen` by 1/16 of the step size up to all of it, or
        `gaussian`. One of: kelemen, gaussian.
    step_size : float
        The largest move of a small step, by default 1/32, or the standard deviation of a
        Gaussian one, by default 0.01.
    delayed_rejection : boolean, default False
        Let a small step follow a large one that was rejected.
    p_technique : float, default 0.1
        Probability of a step that changes the technique, not the path.
    """

    max_depth: int
    rr_depth: int
    hide_emitters: bool
    strict_normals: bool
    waves: bool
    light_groups: bool
    exposure_layers: bool
    light_layers: str
    luminance_samples: int
    chains: int
    independent_share: float | None
    parts: bool
    p_large: float
    small_step: Literal["kelemen", "gaussian"]
    step_size: float | None
    delayed_rejection: bool
    p_technique: float
    def __init__(
        self,
        *,
        max_depth: int = -1,
        rr_depth: int = 5,
        hide_emitters: bool = False,
        strict_normals: bool = False,
        waves: bool = True,
        light_groups: bool = False,
        exposure_layers: bool = False,
        light_layers: str = "",
        luminance_samples: int = 50000,
        chains: int = 128,
        independent_share: float | None = None,
        parts: bool = False,
        p_large: float = 0.3,
        small_step: Literal["kelemen", "gaussian"] = "kelemen",
        step_size: float | None = None,
        delayed_rejection: bool = False,
        p_technique: float = 0.1,
    ) -> None: ...

__all__ = [
    "BDPT",
    "ERPT",
    "MLT",
    "MMLT",
    "PSSMLT",
    "RJMLT",
    "Aov",
    "Depth",
    "Direct",
    "PTracer",
    "Path",
]
