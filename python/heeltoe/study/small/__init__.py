"""Many runs of one dam that are kept whole: tables, spreads, maps of overturning, static checks."""
