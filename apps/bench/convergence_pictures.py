"""Errors of pictures, for the convergence report. Arrays of height x width x 3, in double. Pure."""

import math

import numpy as np

DARKNESS = 0.01  # of relMSE, see include/limn/image/compare.h
BLOCK = 10  # pixels a side


def relmse(picture, reference):
    return float(np.mean((picture - reference) ** 2 / (reference**2 + DARKNESS)))


def half_error(halves):
    """relMSE of the mean of two independent halves."""
    return relmse(halves[0], (halves[0] + halves[1]) / 2)


def corrected_relmse(picture, halves):
    """Against the mean of two independent halves, whose own error is subtracted."""
    return relmse(picture, (halves[0] + halves[1]) / 2) - half_error(halves)


def block_means(picture, block=BLOCK):
    rows, columns = (side // block for side in picture.shape[:2])
    cut = picture[: rows * block, : columns * block]
    return cut.reshape(rows, block, columns, block, -1).mean(axis=(1, 3))


def agreement(ours, theirs, block=BLOCK):
    """Of two references in halves: the rms relative difference of their block means beyond noise, and the noise."""
    a, b = ([block_means(half, block) for half in halves] for halves in (ours, theirs))
    mean_a, mean_b = (a[0] + a[1]) / 2, (b[0] + b[1]) / 2
    weight = 1 / (((mean_a + mean_b) / 2) ** 2 + DARKNESS)
    noise = np.mean(((a[0] - a[1]) ** 2 + (b[0] - b[1]) ** 2) / 4 * weight)
    return {"difference": math.sqrt(max(0.0, float(np.mean((mean_a - mean_b) ** 2 * weight) - noise))),
            "noise": math.sqrt(float(noise))}
