"""The co-simulation master."""

from orchestrator.master.master import SCHEMES, Master

__all__ = ["SCHEMES", "Master"]
