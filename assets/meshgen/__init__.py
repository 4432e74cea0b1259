"""Generators of the bundled meshes (used by make_meshes.py)."""
