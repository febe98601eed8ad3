"""What the user says: the dam, its crack, the water, the motion; read, checked, and answered in one sentence
where it is wrong."""
