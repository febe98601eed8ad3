"""The one door to the compiled kernels: what they take and return, by name. SI units, per metre of dam."""
