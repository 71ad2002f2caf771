"""Comparisons over many worlds: places, who beats whom, and the table of the paper."""
