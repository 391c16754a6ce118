"""The commands, one file a group; what a command computes with is loaded when it is called."""
