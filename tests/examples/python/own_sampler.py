import numpy as np
import vndf


def my_sampler(wi, alpha, u):
    """Spherical caps (Dupuy and Benyoub 2023)."""
    w = wi * (*alpha, 1)
    w /= np.linalg.norm(w, axis=-1, keepdims=True)
    z = (1 - u[:, 1]) * (1 + w[:, 2]) - w[:, 2]
    sine, phi = np.sqrt((1 - z * z).clip(0)), 2 * np.pi * u[:, 0]
    m = (np.stack([sine * np.cos(phi), sine * np.sin(phi), z], -1) + w) * (*alpha, 1)
    return m / np.linalg.norm(m, axis=-1, keepdims=True)


random = np.random.default_rng(1)
theta, u = 1.55 * random.random(100_000), random.random((100_000, 2))
wi = np.stack([np.sin(theta), 0 * theta, np.cos(theta)], -1)
wm = my_sampler(wi, (0.3, 0.1), u)
print(vndf.check(wi, (0.3, 0.1), wm, u, against="ggx"))
