"""A campaign proposed from files as a bench writes them.

Each guess carries its reason in words and says whether it is sure.  ``propose.propose`` makes them all, ``write.campaign_text`` writes
them down as campaign.toml; nothing here prints or asks.
"""
