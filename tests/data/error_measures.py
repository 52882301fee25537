#!/usr/bin/env python3
"""Error measures of tests/unit/output/error_measures_test.cpp (MeasuredErrors.AgreeWithNumpy), by numpy: /usr/bin/python3 tests/data/error_measures.py

The curves: 181 looks, x = 0 ... 45 degrees. Reference lobes under an envelope, with one exact zero; the result has the same lobes shifted by
0.3 degrees to larger x, 3 % more level, a phase error and a weak background."""
import numpy as np


def lobes(x):
    return 0.3 * np.exp(-((x - 20) / 12) ** 2) * np.cos(0.7 * x) * np.exp(0.9j * x)


x = np.arange(181) * 0.25
b = lobes(x)
b[7] = 0
a = 1.03 * lobes(x - 0.3) * np.exp(0.05j) + 0.002 * np.exp(2j * x)


def level(s):
    with np.errstate(divide="ignore"):
        return 20 * np.log10(np.abs(s)) + 10 * np.log10(4 * np.pi)


la, lb = level(a), level(b)
within = lb >= lb.max() - 20
d = (la - lb)[within]
floor = lb.max() - 80
ra, rb = np.maximum(la, floor), np.maximum(lb, floor)


def shifted(m):
    """Correlation of a(x) with b(x - m steps) where both exist."""
    n = len(x)
    first, second = (ra[m:], rb[:n - m]) if m >= 0 else (ra[:n + m], rb[-m:])
    return np.corrcoef(first, second)[0, 1]


steps = list(range(-45, 46))
c = [shifted(m) for m in steps]
best = int(np.argmax(c))
parabola = np.polyfit([-1, 0, 1], c[best - 1:best + 2], 2)
for name, value in {
    "within": within.sum(), "rms": np.sqrt(np.mean(d ** 2)), "mean_abs": np.mean(np.abs(d)), "median_abs": np.median(np.abs(d)),
    "p95_abs": np.percentile(np.abs(d), 95), "largest_abs": np.max(np.abs(d)), "largest_row": np.flatnonzero(within)[np.argmax(np.abs(d))],
    "bias": np.mean(d), "at_peak": la[np.argmax(lb)] - lb.max(), "relative": np.linalg.norm(a - b) / np.linalg.norm(b),
    "austin": np.mean(np.abs(ra - rb)), "correlation": np.corrcoef(ra, rb)[0, 1],
    "lag": 0.25 * (steps[best] - parabola[1] / (2 * parabola[0])),
}.items():
    print(f"{name:12} {value:.15g}")
