"""Friction laws in the flexible model: what the contacts of a crack have been through, by the names of the contract."""
