"""pbrt-v4."""
