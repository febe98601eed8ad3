"""The page of the studies: what a form asks for as a study file, its runs, its answers, its export."""
