"""Visible normals of any slope distribution (Heitz and d'Eon 2014), over arrays of NumPy.

>>> import numpy as np
>>> import vndf
>>> table = vndf.build("student-t:gamma=2.5", size=128, tolerance=1e-4)
>>> u = np.random.default_rng(1).random((100_000, 2), dtype=np.float32)
>>> wm = table.sample(wi=(0.6, 0.0, 0.8), alpha=(0.3, 0.1), u=u)
>>> wm.shape, wm.dtype
((100000, 3), dtype('float32'))

`build` makes a table of a named distribution, a formula, a function, a profile or a normal map, and
`load` reads one. `Table` samples and evaluates, `Surface` has correlated slopes and a mean slope,
`ConductorBrdf` and `DielectricBsdf` scatter light, `reference` has the samplers of the papers, and
`validate` and `check` judge samplers.
"""

from . import reference
from ._bsdfs import BsdfSample, ConductorBrdf, DielectricBsdf
from ._sampler import SampledNormals, Sampler
from ._surface import Surface
from ._tables import Table, build, load
from ._verdicts import Verdict, check, validate

__all__ = [
    "BsdfSample",
    "ConductorBrdf",
    "DielectricBsdf",
    "SampledNormals",
    "Sampler",
    "Surface",
    "Table",
    "Verdict",
    "build",
    "check",
    "load",
    "reference",
    "validate",
]
