"""Learning again at once, without a run: while a person ranks, and to see what would change if."""
