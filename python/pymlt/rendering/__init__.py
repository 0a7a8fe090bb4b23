"""Rendering: jobs, what they leave behind, and several of them as one image."""
