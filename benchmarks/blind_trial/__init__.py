"""The blind trial: campaigns with a sealed hidden truth, put through the diagnosis and scored."""
