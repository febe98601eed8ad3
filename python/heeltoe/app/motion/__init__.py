"""The page of the ground motion: what a record holds, and the motion that a case is shaken by."""
