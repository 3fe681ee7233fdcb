"""The validator: whether a sampler draws what it should."""

from __future__ import annotations

import json
import os
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arguments import Vectors, numbers, prepare, thread_count
from ._sampler import Alpha
from ._tables import Table, load
from .reference import Reference


class Verdict(dict[str, Any]):
    """What a validation found: the object that the program writes with --json.

    The keys are sampler, passed, samples, resolutions, results and not_run. It prints as the
    program prints it.
    """

    def __init__(self, report: tuple[str, str]) -> None:
        super().__init__(json.loads(report[1]))
        self._text = report[0]

    @property
    def passed(self) -> bool:
        """Whether every result passed."""
        return bool(self["passed"])

    def __str__(self) -> str:
        return self._text.rstrip("\n")

    __repr__ = __str__

    def __reduce__(self) -> tuple[Any, ...]:
        return Verdict, ((self._text, json.dumps(self)),)


#: More samples show no error that is worth the time (lib/vndf/validate/records.h).
_MOST_SAMPLES = 2_000_000


def check(
    wi: ArrayLike,
    alpha: Alpha,
    wm: ArrayLike,
    u: Optional[ArrayLike] = None,
    pdf: Optional[ArrayLike] = None,
    *,
    against: Union[str, "os.PathLike[str]", Table],
    normals: str = "visible",
    inverse: Optional[bool] = None,
    u_error: float = 1e-5,
    name: str = "samples",
    seed: int = 1,
    threads: int = 0,
) -> Verdict:
    """Checks the samples of any sampler against the exact distribution, as `vndf check` does.

    The distribution of the normals is tested whatever the sampler's method is, the map where the
    random numbers are given and it is an inverse of the CDFs, and the density where it is given.
    What is not tested is told with the reason, under `not_run`.

    Parameters
    ----------
    wi : (..., 3)
        Incident directions, unit vectors.
    alpha : number, array or Surface
        Roughness, from 1e-9 to 1e9.
    wm : (..., 3)
        What the sampler returned, unit vectors.
    u : (..., 2), optional
        The random numbers that it was given, in [0, 1].
    pdf : (...), optional
        The densities that it states.
    against : str, path or Table
        The distribution: its name or specification, a file of tables, or a table.
    normals : "visible", "v-cavity" or "all"
        Which normals the sampler claims to draw.
    inverse : bool, optional
        Whether it claims to be the monotone inverse of the CDFs; recognised where it is not given.
    u_error : float
        Largest error of such a map, in u.
    name : str
        What the verdict calls the samples.
    seed : int
        Of the random numbers of the check. Of more than two million samples a random part is
        checked.
    threads : int
        0 means one for each processor.

    Raises
    ------
    ValueError
        For shapes that do not broadcast, for fewer than 100 samples, and for a sample that breaks a
        rule, which the message names.
    FileNotFoundError, TypeError
        For `against`.

    Examples
    --------
    >>> random = np.random.default_rng(1)
    >>> theta, u = np.float32(1.5) * random.random(100_000), random.random((100_000, 2))
    >>> wi = np.stack([np.sin(theta), 0 * theta, np.cos(theta)], -1)
    >>> wm = vndf.reference.ggx_caps.sample(wi, (0.3, 0.1), u)  # put yours here
    >>> verdict = vndf.check(wi, (0.3, 0.1), wm, u, against="ggx")
    >>> verdict.passed
    True
    >>> print(verdict)
    samples against ggx: pass
      pass  ...
    accepted
    """
    claim = _native.Claim(normals, inverse, u_error)
    source, title = _against(against)
    arguments = [Vectors("wi", wi, 3), Vectors("wm", wm, 3)]
    if u is not None:
        arguments.append(Vectors("u", u, 2))
    if pdf is not None:
        arguments.append(Vectors("pdf", numbers("pdf", pdf)[..., np.newaxis], 1))
    a = prepare(True, alpha, *arguments)
    arrays = [x.reshape(-1, x.shape[-1]) for x in (*a.arrays, a.alpha)]
    if len(arrays[0]) > _MOST_SAMPLES:
        kept = np.random.default_rng(seed).choice(len(arrays[0]), _MOST_SAMPLES, replace=False)
        arrays = [x[kept] for x in arrays]
    directions, normals_drawn, *rest, surfaces = arrays
    return Verdict(
        _native.check(
            f"{name} against {title}",
            source,
            directions,
            surfaces,
            normals_drawn,
            rest.pop(0) if u is not None else None,
            rest.pop(0) if pdf is not None else None,
            claim,
            seed,
            thread_count(threads),
        )
    )


def _against(against: Union[str, "os.PathLike[str]", Table]) -> tuple[_native.Source, str]:
    """The distribution, and what it is called."""
    if isinstance(against, Table):
        return against._tables.source(), against.distribution
    text = os.fspath(against)
    is_file = os.path.splitext(text)[1] in (".vndf", ".h5", ".hdf5", ".exr")
    if is_file or not isinstance(against, str):
        return load(against)._tables.source(), text
    return _native.source_of_specification(text), text


def validate(
    sampler: Union[Table, Reference],
    *,
    thoroughness: str = "standard",
    seed: int = 1,
    threads: int = 0,
) -> Verdict:
    """Checks a table, or a sampler of `vndf.reference`, against its exact distribution.

    Parameters
    ----------
    sampler : Table or Reference
        Of a table with both parts, the baked tables are checked, with the bounds of their
        certificate.
    thoroughness : "quick", "standard" or "thorough"
        Seconds, a minute, or 1e9 samples.
    seed : int
        All random numbers follow from it.
    threads : int
        0 means one for each processor.

    Raises
    ------
    ValueError
        For a table whose distribution cannot be made again, as that of a Python function after
        pickling.
    TypeError
        For something else than these samplers; `check` takes the samples of any.

    Examples
    --------
    >>> verdict = vndf.validate(vndf.reference.ggx_caps, thoroughness="quick")
    >>> verdict["passed"], verdict["results"][0]["check"]
    (True, 'hard cases')
    >>> print(verdict)
    ggx-caps: pass
      pass  hard cases ...
    """
    options = (thoroughness, seed, thread_count(threads))
    if isinstance(sampler, Table):
        return Verdict(_native.validate_tables(sampler._tables, *options))
    if isinstance(sampler, Reference):
        return Verdict(_native.validate_reference(sampler.name, *options))
    raise TypeError(
        f"sampler is of type {type(sampler).__name__}; give a vndf.Table or one of vndf.reference, "
        "or the samples of yours to vndf.check()"
    )
