"""Units in and out: from written quantities to SI, and back to text."""
