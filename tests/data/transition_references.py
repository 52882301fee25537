#!/usr/bin/env python3
"""Makes transition_references.csv with mpmath, 60 digits:

    python3 tests/data/transition_references.py > tests/data/transition_references.csv

Rows "F": F(X) = sqrt(pi) z e^(z^2) erfc(z), z = e^(j pi/4) sqrt(X), which is Kouyoumjian and Pathak's (1974, eq. 26) integral.
Rows "D": soft and hard coefficients of a wedge, eq. 25 there, the four products of cotangent and F written out, times
sqrt(k): they depend on kL alone. Angles are the doubles as printed; none lies exactly on a boundary.
"""
from mpmath import mp, mpf, mpc, sqrt, pi, exp, erfc, cot, cos, sin, nint

mp.dps = 60


def transition(x):
    z = exp(mpc(0, pi / 4)) * sqrt(x)
    return sqrt(pi) * z * exp(z * z) * erfc(z) if x < 1e12 else series(x)


def series(x):
    total, term = mpc(0), mpc(1)
    for m in range(1, 12):
        total += term
        term *= mpc(0, 1) * (2 * m - 1) / (2 * x)
    return total


def coefficients(n, source, observer, kl):
    def product(beta, sign):
        image = nint((beta + sign * pi) / (2 * pi * n))
        a = 2 * cos((2 * n * pi * image - beta) / 2) ** 2
        return cot((pi + sign * beta) / (2 * n)) * transition(kl * a)

    factor = -exp(mpc(0, -pi / 4)) / (2 * n * sqrt(2 * pi))
    minus = product(observer - source, 1) + product(observer - source, -1)
    plus = product(observer + source, 1) + product(observer + source, -1)
    return factor * (minus - plus), factor * (minus + plus)


def row(kind, n, source, observer, kl, first, second):
    numbers = [float(v) for v in (n, source, observer, kl)]
    values = [mp.nstr(v, 18) for v in (first.real, first.imag, second.real, second.imag)]
    print(",".join([kind] + ["%.17g" % v for v in numbers] + values))


print("# made by transition_references.py")
print("kind,n,source,observer,kl,re_first,im_first,re_second,im_second")
for power in list(range(-300, -20, 40)) + [-17, -14, -11, -8, -6, -4, -2, -1, 0, 1, 2, 4, 6, 8, 11, 14, 16]:
    for digit in (1.0, 2.3, 5.5):
        x = digit * 10.0**power
        row("F", 0, 0, 0, x, transition(mpf(x)), mpc(0))
distances = [s * 10.0**e for e in (-11, -7, -3, -1) for s in (-1, 1)]
for n in (2.0, 1.5, 1.05, 1.9999999, 0.75):
    for source in (1e-9, 1e-3, 1.3, float(pi / 2), 3.0):
        for boundary in (float(pi) + source, float(pi) - source, float((2 * n - 1) * pi) - source):
            for eps in distances:
                observer = boundary + eps
                if not 0 <= observer <= n * float(pi) or source > n * float(pi):
                    continue
                for kl in (1e-3, 3.0, 1e6):
                    soft, hard = coefficients(mpf(n), mpf(source), mpf(observer), mpf(kl))
                    row("D", n, source, observer, kl, soft, hard)
