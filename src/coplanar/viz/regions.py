"""Closed outlines from pieces of a boundary, so that a region can be filled."""

from __future__ import annotations

import numpy as np

JOINED = 1e-6  # of the extent: ends nearer than this are one point


def loops_of(pieces: list[np.ndarray]) -> list[np.ndarray]:
    """Outlines (n, 2) joined of pieces (k, 2) end to end, holes turning the other way; none at all if one stays open.

    Example:
        >>> upper, lower = np.array([[1.0, 0], [0, 1], [-1, 0]]), np.array([[1.0, 0], [0, -1], [-1, 0]])
        >>> loops_of([upper, lower])[0].tolist()
        [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]
        >>> loops_of([upper])
        []
    """
    rest = list(pieces)
    near = JOINED * float(np.ptp(np.vstack(pieces), axis=0).max()) if pieces else 0.0
    loops = []
    while rest:
        loop = rest.pop(0)
        while np.hypot(*(loop[-1] - loop[0])) > near or len(loop) < 4:
            place = next((i for i, piece in enumerate(rest) if _distance(loop[-1], piece) <= near), None)
            if place is None:
                return []
            piece = rest.pop(place)
            forward = np.hypot(*(piece[0] - loop[-1])) <= near
            loop = np.vstack([loop, (piece if forward else piece[::-1])[1:]])
        loops.append(loop[:-1])
    return turned(loops)


def turned(loops: list[np.ndarray]) -> list[np.ndarray]:
    """Outlines (n, 2), those inside an odd number of others clockwise, the others counterclockwise.

    Example:
        >>> square = np.array([[1.0, 1.0], [1, -1], [-1, -1], [-1, 1]])
        >>> [loop[1].tolist() for loop in turned([3.0 * square, square])]
        [[-3.0, -3.0], [1.0, -1.0]]
    """
    return [_turned(loop, sum(_holds(other, loop[0]) for other in loops if other is not loop)) for loop in loops]


def around(outer: np.ndarray, inner: np.ndarray, centre: np.ndarray) -> list[np.ndarray]:
    """A sampled region between two lines of points about a centre, as closed lines: a ring, or a sector of one.

    Example:
        >>> turn = np.linspace(0.0, 1.0, 9)
        >>> line = np.column_stack([np.cos(turn), np.sin(turn)])
        >>> [len(loop) for loop in around(2.0 * line, line, np.zeros(2))]
        [19]
    """
    lines = []
    for line in (outer, inner):
        angles = np.arctan2(*(line - centre).T[::-1])
        gaps = np.diff(angles, append=angles[0] + 2.0 * np.pi)
        widest = int(np.argmax(gaps))
        lines.append((np.roll(line, -widest - 1, axis=0), gaps[widest] > 4.0 * np.median(gaps)))
    (far, open_far), (near, open_near) = lines
    if open_far or open_near:
        return [np.vstack([far, near[::-1], far[:1]])]
    return [np.vstack([line, line[:1]]) for line in (far, near)]


def _distance(point: np.ndarray, piece: np.ndarray) -> float:
    return float(np.hypot(*(piece[[0, -1]] - point).T).min())


def _turned(loop: np.ndarray, depth: int) -> np.ndarray:
    """Counterclockwise outside of all others or in a hole of a hole, clockwise in a hole."""
    x, y = (loop - loop.mean(axis=0)).T
    counterclockwise = float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) > 0.0
    return loop if counterclockwise == (depth % 2 == 0) else loop[::-1]


def _holds(loop: np.ndarray, point: np.ndarray) -> bool:
    """Whether a ray from the point crosses the outline an odd number of times."""
    (x0, y0), (x1, y1) = loop.T - point[:, None], np.roll(loop, -1, axis=0).T - point[:, None]
    crosses = (y0 > 0.0) != (y1 > 0.0)
    ahead = x0 * y1 - x1 * y0 > 0.0
    return bool(np.sum(crosses & (ahead == (y1 > y0))) % 2)
