"""The reference cases as small programs: reference, ours, deviation, verdict.

A case is a function that yields rows. It runs through the same calls a user makes wherever the case file can express
it. ``python -m validation`` in the folder of the project prints the tables; the tests assert them.
"""
