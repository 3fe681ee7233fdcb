"""How much noise visible normals save: Algorithm 2 of Heitz and d'Eon 2014 against Algorithm 1.

    python3 variance.py [--samples N] [--size N] [--output FILE]

A rough mirror of GGX stands in a white world. Algorithm 1 draws all normals, and Algorithm 2 draws
those that are visible; both estimate how much light the surface reflects.
"""

import argparse

import matplotlib.pyplot as plt
import numpy as np

import vndf


def weights(sampler, alpha, theta, u):
    """What each sample adds to the estimate; 0 where the light is lost."""
    wi = (np.sin(theta), 0.0, np.cos(theta))
    mirror = vndf.ConductorBrdf(sampler, alpha, eta=0.0001, k=1000.0)  # reflects all light
    return mirror.sample(wi, u).weight


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=200_000)
    parser.add_argument("--size", type=int, default=512, help="nodes of the tables along an axis")
    parser.add_argument("--output", default="variance.png")
    options = parser.parse_args()
    table = vndf.build("ggx", size=options.size, tolerance=1e-4)
    algorithms = {
        "Algorithm 1: all normals": vndf.reference.ggx_ndf,
        "Algorithm 2: visible normals": table,
    }
    u = np.random.default_rng(1).random((options.samples, 2), dtype=np.float32)

    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 5), layout="constrained")
    figure.suptitle("A rough mirror of GGX in a white world")
    degrees = np.linspace(1, 89, 23)
    for alpha, color in ((0.1, "tab:blue"), (0.5, "tab:orange"), (1.0, "tab:green")):
        for (name, sampler), style in zip(algorithms.items(), ("--", "-")):
            drawn = [weights(sampler, alpha, t, u) for t in np.radians(degrees)]
            label = f"{name}, alpha {alpha}"
            left.semilogy(degrees, [w.std() for w in drawn], style, color=color, label=label)
            right.semilogy(degrees, [w.max() for w in drawn], style, color=color)
    left.set(title="Noise of one sample", xlabel="incidence (degrees)", ylabel="standard deviation")
    left.legend(fontsize="small")
    right.set(title="Largest weight: one bright pixel", xlabel="incidence (degrees)", ylabel="weight")
    figure.savefig(options.output, dpi=100)


if __name__ == "__main__":
    main()
