"""System Structure and Parameterization (SSP 1.0): packages read and written."""
