"""One reader for each format of a strong-motion record: ``FORMAT``, ``matches``, ``read``."""
