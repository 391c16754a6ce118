"""Measurement campaigns: folders of data files with a campaign.toml that says what they are."""

from discrepancy.campaign.check import check_campaign
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.template import write_template

__all__ = ["Campaign", "check_campaign", "load_campaign", "write_template"]
