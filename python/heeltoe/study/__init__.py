"""Many runs of one dam: tables, spreads, maps of overturning, studies with their plan, their store and what they say."""
