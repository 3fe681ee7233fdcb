import numpy as np
import vndf

table = vndf.build("student-t:gamma=2.5")
print(repr(table))
u = np.random.default_rng(1).random((1_000_000, 2), dtype=np.float32)
wm = table.sample(wi=(0.6, 0.0, 0.8), alpha=(0.3, 0.1), u=u)
print(wm.shape, wm.dtype, wm.mean(axis=0).round(3))

theta = np.radians([0, 45, 85])
w = np.stack([np.sin(theta), 0 * theta, np.cos(theta)], axis=-1)
print("G1", table.g1(w, 0.3).round(4))

gold = vndf.ConductorBrdf(table, (0.3, 0.1), eta=(0.14, 0.37, 1.44), k=(4.1, 2.3, 1.8))
wo, weight, pdf = gold.sample(w[1], u)
print("reflected", weight.mean(axis=0).round(2))
