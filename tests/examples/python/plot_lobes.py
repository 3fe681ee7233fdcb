"""Plots the density of visible normals and the lobes of a rough metal that has them.

    python3 plot_lobes.py [--distribution NAME] [--alpha X Y] [--size N] [--output FILE]
"""

import argparse

import matplotlib.pyplot as plt
import numpy as np

import vndf

INCIDENCE = (0, 45, 75)  # degrees


def direction(theta):
    theta = np.radians(theta)
    return np.stack([np.sin(theta), np.zeros_like(theta), np.cos(theta)], -1)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--distribution", default="student-t:gamma=2.5")
    parser.add_argument("--alpha", type=float, nargs=2, default=(0.6, 0.3))
    parser.add_argument("--size", type=int, default=512, help="nodes of the tables along an axis")
    parser.add_argument("--output", default="lobes.png")
    options = parser.parse_args()
    table = vndf.build(options.distribution, size=options.size, tolerance=1e-4)
    alpha = tuple(options.alpha)

    figure = plt.figure(figsize=(10, 8), layout="constrained")
    figure.suptitle(
        f"{table.distribution}, alpha = {alpha[0]} along x and {alpha[1]} along y "
        "(red: where the viewer is)"
    )
    grid = figure.add_gridspec(2, 3, height_ratios=(1, 1.15))

    # Normals seen from above, in units of the density that D has at its top.
    x = np.linspace(-1, 1, 301)
    x, y = np.meshgrid(x, x)
    height = 1 - x * x - y * y
    wm = np.stack([x, y, np.sqrt(height.clip(0))], -1)
    for column, theta in enumerate(INCIDENCE):
        axes = figure.add_subplot(grid[0, column], aspect="equal")
        density = np.where(height > 0, table.pdf(direction(theta), wm, alpha), np.nan)
        image = axes.pcolormesh(x, y, density / table.d((0.0, 0.0, 1.0), alpha), vmin=0, vmax=1.5)
        axes.plot(np.sin(np.radians(theta)), 0, "r+", markersize=12)
        axes.set(title=f"visible normals from {theta}°", xlabel="x")
        axes.set(xticks=(-1, 0, 1), yticks=(-1, 0, 1))
        if column == 0:
            axes.set_ylabel("y")
    figure.colorbar(image, ax=figure.axes, label="density over D(0, 0, 1)")

    # Where the light of one direction goes, in the plane of incidence.
    axes = figure.add_subplot(grid[1, :], projection="polar")
    axes.set(theta_zero_location="N", theta_direction=-1, thetamin=-90, thetamax=90)
    gold = vndf.ConductorBrdf(table, alpha, eta=0.37, k=2.3)  # in green
    angles = np.linspace(-90, 90, 721)
    for theta, color in zip(INCIDENCE, ("tab:blue", "tab:orange", "tab:green")):
        value = gold.evaluate(direction(theta), direction(angles))
        axes.plot(np.radians(angles), value, color=color, label=f"light from {theta}°")
        axes.plot([np.radians(theta)] * 2, [0, 1.05 * value.max()], ":", color=color)
    axes.set_title("f cos of gold in the plane of incidence, light from the dotted directions", pad=0)
    axes.set_rlabel_position(90)
    axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0))
    figure.savefig(options.output, dpi=100)


if __name__ == "__main__":
    main()
