"""Ramps: a component moves at constant acceleration until it reaches its target, then holds.

Sources: Biagiotti, Melchiorri 2008, Trajectory Planning for Automatic Machines and Robots, sec. 3.2 (trapezoids).
"""

from coplanar.engine import absolute, maximum, minimum, sqrt, where


def clamp(value, low, high):
    """The nearest number to the value within [low, high]."""
    return minimum(maximum(value, low), high)


def uniform(position, v, a, t):
    """Position x + v t + a t^2/2 and its rate v + a t."""
    return position + (v + 0.5 * a * t) * t, v + a * t


def ramp_time(v1, v2, acceleration):
    """How long from v1 to v2 at this magnitude of acceleration: |v2 - v1|/a."""
    return absolute(v2 - v1) / acceleration


def rate(v1, v2, duration):
    """Signed acceleration (v2 - v1)/T; 0 for a ramp of length 0."""
    return where(duration > 0.0, (v2 - v1) / where(duration > 0.0, duration, 1.0), 0.0)


def ramp(position, v1, v2, duration, t):
    """Position and velocity: v1 before 0, v1 + a t until T, then v2 exactly."""
    since = clamp(t, 0.0, duration)
    way, velocity = uniform(position, v1, rate(v1, v2, duration), since)
    outside = v1 * minimum(t, 0.0) + v2 * maximum(t - duration, 0.0)
    return way + outside, where(t < duration, velocity, v2)


def trapezoid_times(distance, limit, up, down):
    """Times of speeding up, cruising and slowing down, and the speed between, for a move from rest to rest.

    A way too short for the limit is a triangle of peak speed sqrt(2 d a b/(a + b)), with no cruise.
    """
    way = absolute(distance)
    triangle = sqrt(2.0 * way * (up * down / (up + down)))
    peak = minimum(limit, triangle)
    rest = way - 0.5 * peak * peak * (1.0 / up + 1.0 / down)
    cruise = where(triangle > limit, maximum(rest, 0.0) / limit, 0.0)
    return peak / up, cruise, peak / down, peak


def trapezoid(distance, limit, up, down, t):
    """Way travelled and velocity at time t; at rest at 0 before, and at exactly the distance after."""
    rise, cruise, fall, peak = trapezoid_times(distance, limit, up, down)
    first, speeding = uniform(0.0, 0.0, up, clamp(t, 0.0, rise))
    last, slowing = uniform(0.0, 0.0, down, clamp(rise + cruise + fall - t, 0.0, fall))
    ending = t >= rise + cruise
    covered = where(ending, absolute(distance) - last, first + peak * clamp(t - rise, 0.0, cruise))
    speed = where(ending, slowing, where(t < rise, speeding, peak))
    sign = where(distance < 0.0, -1.0, 1.0)
    return sign * covered, sign * speed
