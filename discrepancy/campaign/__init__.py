"""Measurement campaigns: folders of data files with a campaign.toml that says what they are."""
