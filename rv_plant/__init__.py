"""The reducer: geometry, contacts, equilibrium."""
