"""Scenes of other programs: glTF 2.0 and pbrt-v4, as the dict that `load_dict` takes."""
