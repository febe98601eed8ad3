"""Units in and out: what people write to SI, and SI to what people read."""
