"""Arguments of every function of a sampler: their shapes, their precision and their surfaces.

All functions take arrays whose last axis has the numbers of one sample, and broadcast the axes
before it as NumPy does. Here these arrays are brought to one shape by views, so that nothing is
copied.
"""

from __future__ import annotations

import operator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._surface import Surface

Floats = NDArray[np.floating[Any]]


class Vectors(NamedTuple):
    """An argument with `width` numbers for each sample."""

    name: str
    value: ArrayLike
    width: int


class Arguments(NamedTuple):
    """Arguments of one shape. `shape` is that of the results, without their last axis."""

    arrays: list[Floats]
    alpha: Floats
    shape: tuple[int, ...]
    dtype: np.dtype[Any]

    def empty(self, *width: int) -> Floats:
        """An array for results, of `width` numbers for each sample or of one."""
        return np.empty(self.shape + width, self.dtype)


def numbers(name: str, value: ArrayLike) -> Floats:
    """`value` as an array of float32 or float64: a copy only where it is something else."""
    array = np.asarray(value)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name} has the dtype {array.dtype}; give real numbers")
    single = array.dtype.kind == "f" and array.dtype.itemsize <= 4
    return np.require(array, np.float32 if single else np.float64, "A")


def prepare(in_double: bool, alpha: object, *arguments: Vectors) -> Arguments:
    """Checks arguments and brings them to one shape; `in_double` if results may be float64."""
    arrays = [_of_width(a) for a in arguments]
    surfaces = alpha._numbers if isinstance(alpha, Surface) else _alphas(alpha)
    width = max(2, surfaces.shape[-1])  # one number is that along x and y
    given = [(a.name, np.shape(a.value)) for a in arguments]
    given.append(("alpha", np.shape(surfaces if isinstance(alpha, Surface) else np.asarray(alpha))))
    shape = _common_shape(given, [x.shape[:-1] for x in (*arrays, surfaces)])
    return Arguments(
        [np.broadcast_to(x, shape + x.shape[-1:]) for x in arrays],
        np.broadcast_to(surfaces, shape + (width,)),
        shape,
        np.dtype(np.float64 if in_double and _in_double(arguments) else np.float32),
    )


def thread_count(threads: int) -> int:
    """The number of threads, where 0 means one for each processor."""
    count = operator.index(threads)
    if count < 0:
        raise ValueError(f"threads is {count}; give a number > 0, or 0 for one for each processor")
    return count


def plain(results: Floats) -> Any:
    """A number in place of an array without axes, as NumPy's own functions return it."""
    return results[()]


def _of_width(argument: Vectors) -> Floats:
    array = numbers(argument.name, argument.value)
    if array.ndim == 0 or array.shape[-1] != argument.width:
        raise ValueError(
            f"{argument.name} has shape {array.shape}; its last axis must have {argument.width} "
            f"numbers, as in ({argument.width},) or (N, {argument.width})"
        )
    return array


def _in_double(arguments: tuple[Vectors, ...]) -> bool:
    """Numbers, tuples and lists take the precision of the arrays beside them."""
    sizes = [
        a.value.dtype.itemsize
        for a in arguments
        if isinstance(a.value, (np.ndarray, np.generic)) and a.value.dtype.kind == "f"
    ]
    return not sizes or max(sizes) > 4


def _alphas(alpha: object) -> Floats:
    """Roughness as an array whose last axis has one number or two."""
    array = numbers("alpha", alpha)  # type: ignore[arg-type]
    if array.ndim == 0 or (array.ndim == 1 and array.shape[0] != 2):
        return array[..., np.newaxis]
    if array.shape[-1] not in (1, 2):
        raise ValueError(
            f"alpha has shape {array.shape}; give a number, a pair, an array (N,) of numbers or an "
            "array whose last axis has 1 or 2 numbers"
        )
    return array


def _common_shape(
    given: list[tuple[str, tuple[int, ...]]], samples: list[tuple[int, ...]]
) -> tuple[int, ...]:
    try:
        return np.broadcast_shapes(*samples)
    except ValueError:
        shapes = " and ".join(f"{name} has shape {shape}" for name, shape in given)
        raise ValueError(
            f"{shapes}; their axes before the last must be of one length, or of length 1"
        ) from None
