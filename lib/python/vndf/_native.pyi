"""The extension module, which only the files beside it use."""

from typing import Any, Callable, Optional, Sequence

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.floating[Any]]
_Indices = Sequence[tuple[float, float]]
_Report = tuple[str, str]

class Sampler:
    @property
    def in_double(self) -> bool: ...

class Source: ...

class Size:
    def __init__(self, rows: int, columns: int, in_double: bool) -> None: ...

class Baking:
    def __init__(self, tolerance: float, max_bytes: int, below_horizon: bool) -> None: ...

class Claim:
    def __init__(self, normals: str, inverse: Optional[bool], u_error: float) -> None: ...

class Tables:
    def sampler(self) -> Sampler: ...
    def source(self) -> Source: ...
    def bytes_of_kernel(self, with_text: bool) -> bytes: ...
    def bytes_of_pair(self) -> bytes: ...
    def describe_kernel(self) -> str: ...
    def describe_pair(self) -> str: ...
    @property
    def has_kernel(self) -> bool: ...
    @property
    def has_pair(self) -> bool: ...
    @property
    def certificate_of_kernel(self) -> dict[str, float]: ...
    @property
    def certificate_of_pair(self) -> dict[str, float]: ...
    @property
    def distribution(self) -> str: ...
    @property
    def specification(self) -> str: ...
    @property
    def notes(self) -> str: ...
    @property
    def surface(self) -> Optional[list[float]]: ...

def source_of_family(text: str, name: str) -> Source: ...
def source_of_p22(
    formula: str, parameters: dict[str, float], breaks: list[float], name: str
) -> Source: ...
def source_of_function(
    p22: Callable[[float], float], breaks: list[float], name: str
) -> Source: ...
def source_of_ndf(
    formula: str,
    parameters: dict[str, float],
    frozen_at: Optional[float],
    breaks: list[float],
    name: str,
) -> Source: ...
def source_of_profile(r: _Floats, p22: _Floats, tail: str, smooth: bool, name: str) -> Source: ...
def source_of_map(
    pixels: _Floats, whole_numbers: bool, encoding: str, ignore_asymmetry: bool, name: str
) -> Source: ...
def source_of_map_file(
    path: str, encoding: str, ignore_asymmetry: bool, name: str
) -> Source: ...
def build(
    source: Source, size: Size, baking: Optional[Baking], command: str, threads: int
) -> Tables: ...
def bake(tables: Tables, baking: Baking, threads: int) -> Tables: ...
def save_kernel(tables: Tables, path: str) -> None: ...
def save_pair(tables: Tables, path: str) -> None: ...
def tables_of_bytes(content: bytes) -> Tables: ...
def tables_of_file(path: str) -> Tables: ...
def tables_of_parts(pair: Optional[bytes], kernel: Optional[bytes]) -> Tables: ...
def references() -> dict[str, Sampler]: ...
def named_references() -> list[tuple[str, str]]: ...
# From the five numbers by which surfaces are named to the five that store them.
def correlated_surface(named: _Floats) -> NDArray[np.float64]: ...
def surface_of_covariance(named: _Floats) -> NDArray[np.float64]: ...
def turned_surface(named: _Floats) -> NDArray[np.float64]: ...
def sample(
    sampler: Sampler,
    wi: _Floats,
    alpha: _Floats,
    u: _Floats,
    wm: _Floats,
    threads: int,
) -> None: ...
def sample_with_density(
    sampler: Sampler,
    wi: _Floats,
    alpha: _Floats,
    u: _Floats,
    wm: _Floats,
    density: _Floats,
    threads: int,
) -> None: ...

# Called with as many arrays of directions as each of them takes, then alpha, the array of results
# and the number of threads; conductor_evaluate takes the indices before the results.
invert: Callable[..., None]
pdf: Callable[..., None]
d: Callable[..., None]
lambda_: Callable[..., None]
g1: Callable[..., None]
g2: Callable[..., None]
conductor_evaluate: Callable[..., None]
conductor_pdf: Callable[..., None]
dielectric_evaluate: Callable[..., None]
dielectric_pdf: Callable[..., None]

def conductor_sample(
    sampler: Sampler,
    wi: _Floats,
    alpha: _Floats,
    u: _Floats,
    indices: _Indices,
    wo: _Floats,
    weight: _Floats,
    pdf: _Floats,
    threads: int,
) -> None: ...
def dielectric_sample(
    sampler: Sampler,
    wi: _Floats,
    alpha: _Floats,
    u: _Floats,
    eta: float,
    wo: _Floats,
    weight: _Floats,
    pdf: _Floats,
    threads: int,
) -> None: ...
def check(
    name: str,
    against: Source,
    wi: _Floats,
    alpha: _Floats,
    wm: _Floats,
    u: Optional[_Floats],
    pdf: Optional[_Floats],
    claim: Claim,
    seed: int,
    threads: int,
) -> _Report: ...
def source_of_specification(text: str) -> Source: ...
def validate_tables(tables: Tables, thoroughness: str, seed: int, threads: int) -> _Report: ...
def validate_reference(name: str, thoroughness: str, seed: int, threads: int) -> _Report: ...
