"""The model as it stands, fitted with its nuisances: what every later step starts from."""
