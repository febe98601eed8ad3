"""How far a result moves with step, mesh and shaking, and whether a vibration grows."""
