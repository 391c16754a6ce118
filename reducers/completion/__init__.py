"""A reducer of which little is known: a whole reducer file from ratio, tooth numbers, rated torque and a few measures."""
