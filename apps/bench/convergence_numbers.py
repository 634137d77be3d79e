"""The arithmetic of `./build.sh convergence`: errors of pictures, and the seconds to an error. Pictures are arrays of
height x width x 3."""

import math
import statistics

import numpy as np

DARKNESS = 0.01  # of relMSE, see include/limn/image/compare.h
DIFFERENT = 0.01  # relative difference of block means from which two renderers do not solve the same problem


def relmse(picture, reference):
    return float(np.mean((picture - reference) ** 2 / (reference**2 + DARKNESS)))


def half_error(halves):
    """The error of a reference: relMSE of the mean of two independent halves."""
    return relmse(halves[0], (halves[0] + halves[1]) / 2)


def corrected_relmse(picture, halves):
    """Against a reference in halves, whose own error is subtracted."""
    return relmse(picture, (halves[0] + halves[1]) / 2) - half_error(halves)


def block_means(picture, block=10):
    rows, columns = (side // block for side in picture.shape[:2])
    cut = picture[: rows * block, : columns * block]
    return cut.reshape(rows, block, columns, block, -1).mean(axis=(1, 3))


def agreement(ours, theirs):
    """The rms relative difference of the block means of two references in halves, beyond noise, and the noise."""
    a, b = ([block_means(half) for half in halves] for halves in (ours, theirs))
    mean_a, mean_b = (a[0] + a[1]) / 2, (b[0] + b[1]) / 2
    weight = 1 / (((mean_a + mean_b) / 2) ** 2 + DARKNESS)
    noise = float(np.mean(((a[0] - a[1]) ** 2 + (b[0] - b[1]) ** 2) / 4 * weight))
    difference = float(np.mean((mean_a - mean_b) ** 2 * weight))
    return math.sqrt(max(0.0, difference - noise)), math.sqrt(noise)


def solves_another_problem(difference, noise):
    """By `agreement`: the difference is beyond the noise, and beyond what matters."""
    return difference > max(DIFFERENT, 2 * noise)


def seconds_to(error, curve):
    """Seconds to an error on a curve of (seconds, error), by the line error = c / seconds^p through the three points
    that are nearest to it, and whether the error is outside of what was measured. (None, True) if nothing is known."""
    points = sorted(((math.log(s), math.log(e)) for s, e in curve if s > 0 and e > 0),
                    key=lambda point: abs(point[1] - math.log(error)))[:3]
    if not points:
        return None, True
    logs = [math.log(e) for _, e in curve if e > 0]
    x, y = (statistics.mean(axis) for axis in zip(*points))
    spread = sum((p[0] - x) ** 2 for p in points)
    slope = sum((p[0] - x) * (p[1] - y) for p in points) / spread if spread > 0 else -1.0
    if not -3 < slope < -0.3:  # noise hides the convergence: take that of independent samples
        slope = -1.0
    return math.exp(x + (math.log(error) - y) / slope), not min(logs) <= math.log(error) <= max(logs)


def median_seconds(error, rungs):
    """The seconds to an error: the median over the seeds, the least, the largest, and whether the median is extrapolated.
    A rung has the lists "seconds" and "errors" with an entry for each seed. None if nothing is known."""
    curves = zip(*([(statistics.median(rung["seconds"]), e) for e in rung["errors"]] for rung in rungs))
    known = sorted(found for found in (seconds_to(error, curve) for curve in curves) if found[0] is not None)
    if not known:
        return None
    middle = statistics.median(seconds for seconds, _ in known)
    return middle, known[0][0], known[-1][0], sum(outside for _, outside in known) > len(known) / 2
