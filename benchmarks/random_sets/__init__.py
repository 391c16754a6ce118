"""Random legal parameters of every topology: each set converges and is in balance, or is refused with a fault that is true."""
