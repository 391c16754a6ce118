"""The catalogue of effects as pages and commands: what each does, and the signature it leaves on the virtual bench."""
