"""The page of the case: its fields as they were typed, what is wrong with them, and a drawing that can be dragged."""
