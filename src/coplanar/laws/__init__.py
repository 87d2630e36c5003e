"""The textbook: one equation per function, elementwise, no loops, no ifs, no classes.

SI units and radians; every symbol is a number or an array, and all of them broadcast.
"""
