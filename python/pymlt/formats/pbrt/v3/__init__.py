"""Files of pbrt-v3 (Pharr, Jakob & Humphreys 2016; https://pbrt.org/fileformat-v3)."""
