"""Scenes of other programs (glTF 2.0, pbrt, USD) and materials of MaterialX, as scene dicts."""
