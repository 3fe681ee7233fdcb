"""Fits Student-T and a mixture to a measured profile, and compares what is sampled from them.

    python3 fit_profile.py [PROFILE.csv] [--size N] [--output FILE]

The file has two columns, slope radius and density. Without one, a brushed surface is made up: two
scales of roughness, measured with 3 % of noise.
"""

import argparse
from itertools import product

import matplotlib.pyplot as plt
import numpy as np

import vndf

SAMPLES = 20_000


def made_up_profile():
    r = np.geomspace(0.01, 6, 60)
    p22 = 0.6 * np.exp(-((r / 0.25) ** 2)) / 0.25**2 + 0.4 / (1 + r * r) ** 2
    return r, p22 * np.exp(0.03 * np.random.default_rng(1).normal(size=r.size))


# Densities at unit roughness, of mass pi.
def ggx(r):
    return (1 + r * r) ** -2


def beckmann(r):
    return np.exp(-r * r)


def student_t(r, gamma):
    return (1 + r * r / (gamma - 1)) ** -gamma


def mixture(r, weight, width):
    return weight * beckmann(r / width) / width**2 + (1 - weight) * ggx(r)


def best_fit(r, p22, density, *ranges):
    """The parameters and the scale of slopes at which log p22 differs least, and by how much.

    A grid of all parameters is made finer around its best point. The factor of p22 is free.
    """
    limits = [np.log(axis) for axis in ((0.05, 3.0), *ranges)]
    ranges = limits
    for _ in range(12):
        axes = [np.linspace(low, high, 7) for low, high in ranges]
        best = (np.inf,)
        for point in product(*axes):
            scale, *parameters = np.exp(point)
            with np.errstate(divide="ignore"):
                difference = np.log(density(r / scale, *parameters)) - np.log(p22)
            error = difference.std()
            if error < best[0]:
                best = (error, point)
        steps = [0.7 * (high - low) / 2 for low, high in ranges]
        ranges = [
            (max(p - s, low), min(p + s, high))
            for p, s, (low, high) in zip(best[1], steps, limits)
        ]
    scale, *parameters = np.exp(best[1])
    return scale, parameters, best[0]


def u_error(measured, fitted, scale, theta):
    """The largest distance between the CDFs of the visible slopes of two tables."""
    wi = (np.sin(theta), 0.0, np.cos(theta))
    u = np.random.default_rng(2).random((SAMPLES, 2))
    wm = measured.sample(wi, 0.5, u)
    found = np.sort(fitted.invert(wi, wm, 0.5 * scale)[:, 0])
    return np.abs(found - (np.arange(found.size) + 0.5) / found.size).max()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("profile", nargs="?")
    parser.add_argument("--size", type=int, default=256, help="nodes of the tables along an axis")
    parser.add_argument("--output", default="fit.png")
    options = parser.parse_args()
    if options.profile:
        r, p22 = np.loadtxt(options.profile, delimiter=",", skiprows=1, unpack=True)
    else:
        r, p22 = made_up_profile()

    tables = {"size": options.size, "tolerance": None}  # the pair, which has double precision
    measured = vndf.build(profile=(r, p22), tail="power", smooth=True, **tables)
    fits = {}
    scale, (gamma,), error = best_fit(r, p22, student_t, (1.56, 20))
    fits[f"Student-T, gamma {gamma:.2f}"] = (
        scale,
        lambda x: student_t(x, gamma),
        error,
        vndf.build(f"student-t:gamma={gamma}", **tables),
    )
    scale, (weight, width), error = best_fit(r, p22, mixture, (0.05, 0.95), (0.05, 1))
    fits[f"{weight:.2f} Beckmann of width {width:.2f}, {1 - weight:.2f} GGX"] = (
        scale,
        lambda x: mixture(x, weight, width),
        error,
        vndf.build(f"mixture:{weight}*beckmann@{width}+{1 - weight}*ggx", **tables),
    )

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 5), layout="constrained")
    left.loglog(r, p22, "k.", label="measured")
    theta = np.radians(np.linspace(0, 85, 18))
    for name, (scale, density, error, table) in fits.items():
        fitted = density(r / scale)
        fitted *= np.exp((np.log(p22) - np.log(fitted)).mean())
        left.plot(r, fitted, label=f"{name}\n(p22 within {100 * error:.0f} %)")
        errors = [u_error(measured, table, scale, t) for t in theta]
        right.plot(np.degrees(theta), errors, label=name)
    left.set(title="Density of slopes", xlabel="slope radius r", ylabel="p22", ylim=(p22.min() / 3, None))
    left.legend()
    noise = 1.36 / np.sqrt(SAMPLES)  # Kolmogorov
    right.axhline(noise, color="gray", ls=":", label=f"noise of {SAMPLES} samples (95 %)")
    right.set(title="Visible slopes: fit against measured", yscale="log")
    right.set(xlabel="incidence (degrees)", ylabel="largest distance of CDFs")
    right.legend()
    figure.savefig(options.output, dpi=100)


if __name__ == "__main__":
    main()
