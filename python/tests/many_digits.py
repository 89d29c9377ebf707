"""Directions in numbers of 340 digits: nodes may be 1e-150 apart."""
import mpmath

mpmath.mp.dps = 340


def direction(p):
    """p/|p|, where p is a vector of floats."""
    x, y, z = (mpmath.mpf(float(c)) for c in p)
    return times(1 / mpmath.sqrt(x * x + y * y + z * z), (x, y, z))


def times(factor, a):
    return tuple(factor * c for c in a)


def plus(a, b):
    return tuple(s + t for s, t in zip(a, b))


def minus(a, b):
    return tuple(s - t for s, t in zip(a, b))


def dot(a, b):
    return sum(s * t for s, t in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def det(a, b, c):
    return dot(a, cross(b, c))


def norm(a):
    return mpmath.sqrt(dot(a, a))


def unit(a):
    return times(1 / norm(a), a)


def angle(a, b):
    return mpmath.atan2(norm(cross(a, b)), dot(a, b))


def exactly(p):
    return tuple(mpmath.mpf(float(c)) for c in p)


def relative_error(found, exact):
    return float(abs(mpmath.mpf(float(found)) - exact) / exact)
