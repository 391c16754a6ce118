"""The loop of model against measurement in a browser: thin over the same functions as the commands."""
