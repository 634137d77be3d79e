"""The arithmetic of the convergence report: time to an error, intervals. Pure."""

import math
import random
import statistics

DIFFERENT = 0.01  # rms relative difference of block means from which two renderers do not solve the same problem


def solves_another_problem(agreed):
    """By convergence_pictures.agreement: beyond the noise, and beyond what matters."""
    return agreed["difference"] > max(DIFFERENT, 2 * agreed["noise"])


def line_through(points):
    """Least-squares slope and intercept; the slope of independent samples where the points have none."""
    mean_x, mean_y = (statistics.mean(p[i] for p in points) for i in (0, 1))
    spread = sum((x - mean_x) ** 2 for x, _ in points)
    slope = sum((x - mean_x) * (y - mean_y) for x, y in points) / spread if spread > 0 else -1.0
    return slope, mean_y - slope * mean_x


def seconds_to(error, curve):
    """Seconds to an error on a curve of (seconds, error), by the line error = c / seconds^p through the three points
    that are nearest to it; and whether that lies outside of what was measured. (None, True) if nothing is known."""
    points = [(math.log(s), math.log(e)) for s, e in curve if s > 0 and e > 0]
    if not points:
        return None, True
    target = math.log(error)
    outside = not min(y for _, y in points) <= target <= max(y for _, y in points)
    nearest = sorted(points, key=lambda p: abs(p[1] - target))[:3]
    slope, intercept = line_through(nearest)
    if not -3 < slope < -0.3:  # noise, not convergence: that of independent samples, through their middle
        slope = -1.0
        intercept = statistics.mean(y - slope * x for x, y in nearest)
    return math.exp((target - intercept) / slope), outside


def mean_curve(rungs):
    """(seconds, error) for each rung; a rung has the lists "seconds" and "errors", one entry a seed."""
    return [(statistics.median(r["seconds"]), statistics.mean(r["errors"])) for r in rungs]


def resampled_curve(rungs, dice):
    curve = []
    for rung in rungs:
        picked = [dice.randrange(len(rung["errors"])) for _ in rung["errors"]]
        curve.append((statistics.median(rung["seconds"][i] for i in picked),
                      statistics.mean(rung["errors"][i] for i in picked)))
    return curve


def fastest(error, curves):
    """The name and the seconds of the curve that reaches the error first, or (None, None)."""
    times = {name: seconds_to(error, curve)[0] for name, curve in curves.items()}
    known = {name: t for name, t in times.items() if t is not None}
    if not known:
        return None, None
    name = min(known, key=known.get)
    return name, known[name]


def ratio_to_best(error, ours, peers, resamples=1000):
    """Our seconds to the error over those of the fastest peer: (ratio, low, high, the peer's name), the 95 % interval
    from resampling the seeds of every rung, the fastest chosen anew each time. None where somebody's are unknown."""
    def ratio(curve_of):
        own = seconds_to(error, curve_of(ours))[0]
        name, best = fastest(error, {peer: curve_of(rungs) for peer, rungs in peers.items()})
        return (own / best, name) if own is not None and best is not None else (None, None)

    middle, name = ratio(mean_curve)
    if middle is None:
        return None
    dice = random.Random(1)
    spread = sorted(r for r in (ratio(lambda rungs: resampled_curve(rungs, dice))[0] for _ in range(resamples))
                    if r is not None)
    return middle, spread[int(0.025 * len(spread))], spread[int(0.975 * (len(spread) - 1))], name


def slope_over_samples(rungs):
    """Of log error over log samples a pixel: -1 for independent samples."""
    points = [(math.log(r["spp"]), math.log(e)) for r, (_, e) in zip(rungs, mean_curve(rungs)) if e > 0]
    return line_through(points)[0] if len(points) > 1 else float("nan")
