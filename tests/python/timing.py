"""How long a million normals take: this module, the C++ batch under it, and NumPy alone.

    timing.py VNDF_LIBRARY_VALUES [ROUNDS]

All are timed in turn in one run, because a shared machine is slower at one time than at another. In
each turn three calls go before three that count, until which what others left in the caches is gone.
The lowest and the median time of the rounds are printed in milliseconds.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

import vndf

N = 1_000_000


def numpy_caps(wi, alpha, u):
    """Visible GGX normals by spherical caps (Dupuy and Benyoub 2023), in NumPy."""
    stretched = wi * np.array([alpha[0], alpha[1], 1], np.float32)
    stretched /= np.sqrt((stretched * stretched).sum(-1, keepdims=True))
    phi = np.float32(2 * np.pi) * u[:, 0]
    z = (1 - u[:, 1]) * (1 + stretched[..., 2]) - stretched[..., 2]
    sine = np.sqrt(np.clip(1 - z * z, 0, 1))
    m = np.stack([sine * np.cos(phi), sine * np.sin(phi), z], -1) + stretched
    m *= np.array([alpha[0], alpha[1], 1], np.float32)
    m /= np.sqrt((m * m).sum(-1, keepdims=True))
    return m


def random_directions(random, n):
    w = random.normal(size=(n, 3))
    w[:, 2] = np.abs(w[:, 2])
    return (w / np.linalg.norm(w, axis=1, keepdims=True)).astype(np.float32)


def milliseconds(run):
    start = time.perf_counter()
    run()
    return 1e3 * (time.perf_counter() - start)


def main(program, rounds):
    random = np.random.default_rng(1)
    table = vndf.build("ggx", size=1024)
    wi, u = random_directions(random, N), random.random((N, 2), dtype=np.float32)
    alpha = (0.3, 0.1)
    alphas = np.broadcast_to(np.float32(alpha), (N, 2)).copy()
    out = np.empty((N, 3), np.float32)
    runs = {
        "table.sample, one direction": lambda: table.sample(wi[0], alpha, u, threads=1),
        "table.sample, random directions": lambda: table.sample(wi, alphas, u, threads=1),
        "the same into out=, one direction": lambda: table.sample(
            wi[0], alpha, u, out=out, threads=1
        ),
        "the same into out=, random directions": lambda: table.sample(
            wi, alphas, u, out=out, threads=1
        ),
        "two threads, one direction": lambda: table.sample(wi[0], alpha, u, threads=2),
        "two threads, random directions": lambda: table.sample(wi, alphas, u, threads=2),
        "float64 from the pair, one direction": lambda: table.sample(
            wi[0].astype(float), alpha, u.astype(float), threads=1
        ),
        "NumPy's caps, one direction": lambda: numpy_caps(wi[0], alpha, u),
        "NumPy's caps, random directions": lambda: numpy_caps(wi, alpha, u),
    }
    times = {name: [] for name in runs}
    batch = {"C++ batch, one direction": [], "C++ batch, random directions": []}
    with tempfile.TemporaryDirectory() as folder:
        baked, inputs = Path(folder, "ggx.vndf"), Path(folder, "inputs")
        table.save(baked)
        np.hstack([wi, wi, alphas, u, u[:, :1]]).astype(np.float64).tofile(inputs)
        for _ in range(rounds):
            command = [program, "time", str(baked), str(inputs), "6"]
            lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout
            for row in [line.split() for line in lines.splitlines()][3:]:
                for name, value in zip(batch, row):
                    batch[name].append(float(value))
            for name, run in runs.items():
                times[name] += [milliseconds(run) for _ in range(6)][3:]
    for name, values in {**batch, **times}.items():
        print(f"{name:<40} {min(values):8.2f} {np.median(values):8.2f} ms")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 10)
