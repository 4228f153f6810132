"""Small localization algorithms; see the scripts for the nodes around them."""
