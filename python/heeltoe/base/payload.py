"""Objects that are written or sent as JSON, and that nothing reads again on the way."""

#: By the names of their keys. Whoever reads a value says first what it is.
Json = dict[str, object]
