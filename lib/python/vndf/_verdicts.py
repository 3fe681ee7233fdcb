"""The validator: whether a sampler draws what it should."""

from __future__ import annotations

import json
from typing import Any, Union

from . import _native
from ._arguments import thread_count
from ._tables import Table
from .reference import Reference


class Verdict(dict[str, Any]):
    """What a validation found: the object that the program writes with --json.

    The keys are sampler, passed, samples, resolutions, results and not_run. It prints as the program
    prints it.

    >>> verdict = vndf.validate(vndf.reference.ggx_caps, thoroughness="quick", seed=1)
    >>> verdict["passed"], verdict["results"][0]["check"]
    (True, 'hard cases')
    >>> print(verdict)
    ggx-caps: pass
      pass  hard cases ...
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
    >>> vndf.validate(vndf.reference.ggx_exact, thoroughness="quick").passed
    True
    """
    options = (thoroughness, seed, thread_count(threads))
    if isinstance(sampler, Table):
        return Verdict(_native.validate_tables(sampler._tables, *options))
    if isinstance(sampler, Reference):
        return Verdict(_native.validate_reference(sampler.name, *options))
    raise TypeError(
        f"sampler is of type {type(sampler).__name__}; give a vndf.Table or one of vndf.reference, or "
        "the samples of yours to vndf.check()"
    )
