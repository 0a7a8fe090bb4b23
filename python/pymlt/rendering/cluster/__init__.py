"""Rendering on many machines: a dask.distributed cluster runs the units, this process the rest.

This process keeps the whole state of the render. It prepares it (bootstrap), and then sends tasks,
"take these strands from here to there", which any worker can run, any number of times with the same
result; so dask redoes elsewhere what a lost worker held. Each result is merged once. The pixels
have the same bits as those of one machine with the same seed and samples.
"""
