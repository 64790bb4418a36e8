# SPDX-License-Identifier: Apache-2.0
"""How many lights a point accepts, over their number: docs/mathematics.md, section 1. Only what is fitted is free."""
import math
from dataclasses import dataclass


@dataclass
class Plane:
    """Lights on a disc of radius R, the point at height h above it: share (n rho^2 + ln((1+k)/(rho^2+k))/x), with
    x = a R^2, k = (h/R)^2 and rho R the distance within which every light is accepted. Linear in n while all are
    accepted, then logarithmic, then constant."""

    x: float
    k: float
    share: float = 1.0

    def __call__(self, n):
        rho_sq = min(max(1 / (self.x * n) - self.k, 0.0), 1.0)
        return self.share * (n * rho_sq + math.log((1 + self.k) / (rho_sq + self.k)) / self.x)


@dataclass
class Linear:
    """Constant ranges: every light has the same chance to reach the point."""

    share: float = 1.0

    def __call__(self, n):
        return self.share * n


def spread(law, points):
    """Least squares of ln(measured / law) over the scale: their sum, and the scale."""
    errors = [math.log(y / law(x)) for x, y in points]
    mean = sum(errors) / len(errors)
    return sum((error - mean) ** 2 for error in errors), math.exp(mean)


def fitted_plane(points):
    """The law closest to the points (n, lights) in relative error, over a grid of x and k."""
    grid = [1.25**i for i in range(-62, 21)]
    best = min(((*spread(Plane(x, k), points), x, k) for x in grid for k in grid), key=lambda entry: entry[0])
    return Plane(best[2], best[3], best[1])


def fitted_linear(points):
    return Linear(spread(Linear(), points)[1])


FITS = {"plane": fitted_plane, "linear": fitted_linear}


def exponent(points):
    """d ln y / d ln x, by least squares."""
    logs = [(math.log(x), math.log(y)) for x, y in points]
    mean_x, mean_y = (sum(values) / len(logs) for values in zip(*logs))
    return sum((x - mean_x) * (y - mean_y) for x, y in logs) / sum((x - mean_x) ** 2 for x, _ in logs)
