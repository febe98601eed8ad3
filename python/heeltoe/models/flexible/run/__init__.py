"""One run of the elastic dam: its shaking, its cost, what its friction law remembers."""
