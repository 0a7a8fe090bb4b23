"""Universal Scene Description (OpenUSD), read by usd-core."""

from .stage import read_usd

__all__ = ["read_usd"]
