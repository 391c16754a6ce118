"""From compiled kernel to FMU: knows FMI, knows no physics."""
