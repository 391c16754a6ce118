"""The co-simulation master."""

from orchestrator.master.connections import Connection
from orchestrator.master.loops import LoopSettings
from orchestrator.master.master import Master
from orchestrator.master.step_control import StepControl

__all__ = ["Connection", "LoopSettings", "Master", "StepControl"]
