"""Pieces that scenarios are made of: arms, curves, bases, controllers, projectiles, motions."""
