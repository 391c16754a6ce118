"""The missing law without a name: curves over conditions and axes, and closed forms."""
