"""From linear light to what a display or another program shows: tone curves, files, denoising."""
