"""Skeletons (UsdSkel): meshes get the shape that their joints and blend shapes give them."""

from __future__ import annotations

from pxr import Gf, Usd, UsdSkel

from ..imported import Imported


def pose(stage: Usd.Stage, time: Usd.TimeCode, made: Imported) -> None:
    """Bakes skins into points, in the stage in memory alone."""
    prims = Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies())
    roots = [UsdSkel.Root(prim) for prim in prims if prim.IsA(UsdSkel.Root)]
    stage.SetEditTarget(stage.GetSessionLayer())
    for root in roots:
        if root.GetPrim().IsInstanceProxy() or root.GetPrim().IsInstance():
            made.warn("skeletons of instances are left out: their meshes are as they were bound")
        else:
            UsdSkel.BakeSkinning(root, around(root, time))


def around(root: UsdSkel.Root, time: Usd.TimeCode) -> Gf.Interval:
    """From the sample of the animations before a time to the one after it: no more are baked."""
    if time.IsEarliestTime():
        return Gf.Interval.GetFullInterval()
    moment, cache = time.GetValue(), UsdSkel.Cache()
    cache.Populate(root, Usd.PrimDefaultPredicate)
    first, last = moment, moment
    for binding in cache.ComputeSkelBindings(root, Usd.PrimDefaultPredicate):
        animation = cache.GetSkelQuery(binding.GetSkeleton()).GetAnimQuery()
        if not animation:
            continue
        samples = animation.GetJointTransformTimeSamples()
        samples += animation.GetBlendShapeWeightTimeSamples()
        first = min(first, max([t for t in samples if t <= moment], default=moment))
        last = max(last, min([t for t in samples if t >= moment], default=moment))
    return Gf.Interval(first, last)
