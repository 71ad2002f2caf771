"""Demonstrations: attempts as they were played, simulated again here and never taken at their word."""
