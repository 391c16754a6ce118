"""Fifty scenarios through every flavour of the units: the same bits, or by how much they differ."""
