"""Which triangles cross: bounding boxes, then signs of determinants, exact where rounding could decide."""

from __future__ import annotations

import numpy as np

# Of the difference between a 3x3 determinant of differences in double precision and the true one, relative to its
# permanent: Shewchuk, "Adaptive precision floating-point arithmetic", 1997, (7 + 56 eps) eps, rounded up.
ERROR = 8e-16


def box_pairs(x: np.ndarray, some: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Pairs (number in `triangles` of one of `some`, another number) whose bounding boxes meet, each once."""
    p = x[triangles]
    low, high = p.min(1), p.max(1)
    lo, hi = low[some].min(0), high[some].max(0)
    near = np.flatnonzero(((low <= hi) & (high >= lo)).all(1))
    near = near[np.argsort(low[near, 0], kind="stable")]
    start = low[near, 0]
    # A box that meets begins at most this much before.
    width = float((high[near, 0] - low[near, 0]).max(initial=0))
    is_some = np.zeros(len(triangles), bool)
    is_some[some] = True
    found = []
    for t in some.tolist():
        a, b = np.searchsorted(start, [low[t, 0] - width * (1 + 1e-12), np.nextafter(high[t, 0], np.inf)])
        others = near[a:b]
        hit = others[((low[others] <= high[t]) & (high[others] >= low[t])).all(1)]
        hit = hit[(hit != t) & ~(is_some[hit] & (hit < t))]
        if len(hit):
            found.append(np.column_stack([np.full(len(hit), t), hit]))
    return np.concatenate(found) if found else np.zeros((0, 2), np.int64)


def exact_integers(x: np.ndarray) -> np.ndarray:
    """The coordinates as whole numbers of one common unit."""
    _, exponents = np.frexp(x[x != 0])
    unit = int(exponents.min(initial=0)) - 53
    whole = np.empty(x.shape, dtype=object)
    for at, value in np.ndenumerate(x):
        top, bottom = float(value).as_integer_ratio()
        shift = bottom.bit_length() - 1 + unit
        whole[at] = top >> shift if shift >= 0 else top << -shift
    return whole


def sides(x: np.ndarray, a: np.ndarray, b: np.ndarray, c: np.ndarray, d: np.ndarray) -> np.ndarray:
    """On which side of the plane through a, b, c the point d is: -1, 0 or 1, exactly. Arguments are vertex numbers."""
    u, v, w = x[a] - x[d], x[b] - x[d], x[c] - x[d]
    with np.errstate(over="ignore", invalid="ignore"):
        det = (u * np.cross(v, w)).sum(1)
        absolute = np.abs(v[:, [1, 2, 0]] * w[:, [2, 0, 1]]) + np.abs(v[:, [2, 0, 1]] * w[:, [1, 2, 0]])
        permanent = (np.abs(u) * absolute).sum(1)
    sign = np.sign(det).astype(int)
    unsure = np.flatnonzero(~(np.abs(det) > ERROR * permanent))
    if len(unsure):
        used = np.unique(np.concatenate([q[unsure] for q in (a, b, c, d)]))
        whole = exact_integers(x[used])
        p, q, r, s = (whole[np.searchsorted(used, t[unsure])] for t in (a, b, c, d))
        u, v, w = p - s, q - s, r - s
        det = sum(u[:, i] * (v[:, j] * w[:, k] - v[:, k] * w[:, j]) for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)))
        sign[unsure] = [(e > 0) - (e < 0) for e in det]
    return sign


def crosses(x: np.ndarray, p: np.ndarray, q: np.ndarray, triangle: np.ndarray) -> np.ndarray:
    """Whether the open segments pq cross the open triangles; touching is no crossing."""
    result = np.zeros(len(p), bool)
    a, b, c = triangle.T
    left = np.arange(len(p))
    side_p = sides(x, a, b, c, p)
    left = left[side_p != 0]
    left = left[sides(x, a[left], b[left], c[left], q[left]) == -side_p[left]]
    first = sides(x, p[left], q[left], a[left], b[left])
    keep = first != 0
    left, first = left[keep], first[keep]
    for e, f in ((b, c), (c, a)):
        keep = sides(x, p[left], q[left], e[left], f[left]) == first
        left, first = left[keep], first[keep]
    result[left] = True
    return result


def crossing(x: np.ndarray, triangles: np.ndarray, pairs: np.ndarray) -> np.ndarray:
    """Which of these pairs of triangles cross. Those that share an edge do not: folds are looked for elsewhere."""
    one, two = triangles[pairs[:, 0]], triangles[pairs[:, 1]]
    shared = (one[:, :, None] == two[:, None, :]).any(2).sum(1)
    result = np.zeros(len(pairs), bool)
    for first, second in ((one, two), (two, one)):
        for k in range(3):
            p, q = first[:, k], first[:, (k + 1) % 3]
            # An edge that starts at a corner of the other triangle cannot cross it elsewhere.
            apart = (second != p[:, None]).all(1) & (second != q[:, None]).all(1) & (shared < 2) & ~result
            test = np.flatnonzero(apart)
            result[test] |= crosses(x, p[test], q[test], second[test])
    return result


def crossing_pairs(x: np.ndarray, triangles: np.ndarray, some: np.ndarray) -> np.ndarray:
    """Pairs of crossing triangles, at least one of them of `some` (numbers in `triangles`)."""
    pairs = box_pairs(x, some, triangles)
    return pairs[crossing(x, triangles, pairs)] if len(pairs) else pairs
