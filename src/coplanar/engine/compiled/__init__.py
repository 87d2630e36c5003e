"""NumPy batches by compiled loops over the text of the laws: imported at the first large batch, and Numba with it."""
