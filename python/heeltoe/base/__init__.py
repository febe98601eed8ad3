"""What every room stands on: arrays, a cache, files written whole, how a thing shows itself."""
