"""The samplers of the papers, by the names that the program lists, with _ in place of - and dots.

Each is a `vndf.Sampler` with `name` and `distribution`, which it claims:

>>> import vndf
>>> vndf.reference.ggx_caps
<vndf.reference.ggx_caps, a sampler of ggx>
>>> vndf.reference.ggx_caps.sample((0.6, 0.0, 0.8), 0.3, (0.25, 0.75)).shape
(3,)

Samplers whose names end in _ndf or _walter draw all normals, whatever wi (Algorithm 1 of Heitz and
d'Eon 2014), and those in _v_cavity draw visible normals of V-cavities (Algorithm 3).
"""

from __future__ import annotations

from typing import Any

from . import _native
from ._sampler import Sampler


class Reference(Sampler):
    """A sampler of a paper.

    >>> vndf.reference.samplers["ggx-caps"] is vndf.reference.ggx_caps
    True
    """

    def __init__(self, name: str, distribution: str, sampler: _native.Sampler) -> None:
        self.name = name
        self.distribution = distribution
        self._sampler = sampler

    def __repr__(self) -> str:
        return f"<vndf.reference.{_identifier(self.name)}, a sampler of {self.distribution}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _named, (self.name,)


def _identifier(name: str) -> str:
    return name.replace("-", "_").replace(".", "_")


def _named(name: str) -> Reference:
    return samplers[name]


_native_samplers = _native.references()

#: All of them, by the names that the program lists.
samplers: dict[str, Reference] = {
    name: Reference(name, distribution, _native_samplers[name])
    for name, distribution in _native.named_references()
}

beckmann_analytic: Reference = samplers["beckmann-analytic"]
beckmann_exact: Reference = samplers["beckmann-exact"]
ggx_analytic: Reference = samplers["ggx-analytic"]
ggx_exact: Reference = samplers["ggx-exact"]
ggx_hemisphere: Reference = samplers["ggx-hemisphere"]
ggx_caps: Reference = samplers["ggx-caps"]
beckmann_ndf: Reference = samplers["beckmann-ndf"]
ggx_ndf: Reference = samplers["ggx-ndf"]
beckmann_walter: Reference = samplers["beckmann-walter"]
ggx_walter: Reference = samplers["ggx-walter"]
blinn_phong_ndf: Reference = samplers["blinn-phong-ndf"]
gtr_1_5_ndf: Reference = samplers["gtr-1.5-ndf"]
gtr_2_ndf: Reference = samplers["gtr-2-ndf"]
beckmann_v_cavity: Reference = samplers["beckmann-v-cavity"]
ggx_v_cavity: Reference = samplers["ggx-v-cavity"]
