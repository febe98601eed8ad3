"""Many runs of one dam: tables, spreads, maps of overturning, and studies with their plan and their store."""
