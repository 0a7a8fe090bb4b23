"""Scenes of other programs: glTF 2.0, pbrt and USD, as the dict that `load_dict` takes."""
