"""Other people's importers run the units, and their numbers are held against this project's: the page docs/importers.md."""
