"""Worlds: drawn from a seed, named after what generated them, open to whoever has the link."""
