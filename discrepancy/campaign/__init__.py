"""Measurement campaigns: folders of data files with a campaign.toml that says what they are.

``load`` reads one, ``check`` says what is missing in it, ``template`` writes an empty one.
"""
