"""Surfaces that are more than a roughness along x and y."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native


class Surface:
    """A rough surface with correlated slopes or a mean slope, in place of `alpha`.

    Slopes along x and y are stretched by `alpha`, have a `correlation`, and lie about the mean
    slope `mean`, that of the facet (-mean_x, -mean_y, 1).
    Filtered normal maps (LEADR, Dupuy et al. 2013)
    and scratches at an angle are such surfaces. Lambda and G1 on them are relative to the mean
    normal.

    Parameters
    ----------
    alpha : float, (2,) or (..., 2)
        Roughness along x and y, > 0, in the units of the distribution.
    correlation : float or (...)
        In (-1, 1).
    mean : (2,) or (..., 2)
        Mean slope along x and y.

    Arrays make as many surfaces, which broadcast with directions.

    Raises
    ------
    ValueError
        For a correlation outside (-1, 1), and for shapes that do not go together.

    Examples
    --------
    >>> import vndf
    >>> surface = vndf.Surface((0.3, 0.1), correlation=0.5, mean=(0.1, 0.0))
    >>> surface
    vndf.Surface(alpha=(0.3, 0.1), correlation=0.5, mean=(0.1, 0.0))
    """

    def __init__(
        self, alpha: ArrayLike, correlation: ArrayLike = 0.0, mean: ArrayLike = (0.0, 0.0)
    ) -> None:
        c = np.asarray(correlation, np.float64)
        if np.any(np.abs(c) >= 1):
            raise ValueError(f"correlation is {correlation!r}; it must be in (-1, 1)")
        named = _joined(_pair("alpha", alpha), c[..., np.newaxis], _pair("mean", mean))
        self._set(
            _native.correlated_surface(named),
            f"(alpha={_shown(named[..., :2])}, correlation={_shown(named[..., 2])}, "
            f"mean={_shown(named[..., 3:])})",
        )

    @classmethod
    def from_covariance(cls, covariance: ArrayLike, mean: ArrayLike = (0.0, 0.0)) -> Surface:
        """The surface whose slopes have a covariance, in units of the square of alpha.

        That is twice the variance of slopes for Beckmann.

        Parameters
        ----------
        covariance : (2, 2) or (..., 2, 2)
            Symmetric and positive definite.
        mean : (2,) or (..., 2)
            Mean slope.

        Raises
        ------
        ValueError
            For a matrix that is not symmetric and positive definite.

        Examples
        --------
        >>> import vndf
        >>> vndf.Surface.from_covariance([[0.09, 0.015], [0.015, 0.01]])
        vndf.Surface.from_covariance([[0.09, 0.015], [0.015, 0.01]], mean=(0.0, 0.0))
        """
        c = np.asarray(covariance, np.float64)
        if c.ndim < 2 or c.shape[-2:] != (2, 2):
            raise ValueError(f"covariance has shape {c.shape}; its last two axes must be (2, 2)")
        xx, xy, yx, yy = c[..., 0, 0], c[..., 0, 1], c[..., 1, 0], c[..., 1, 1]
        if np.any(xy != yx) or np.any(xx <= 0) or np.any(xx * yy <= xy * xy):
            raise ValueError("covariance must be symmetric and positive definite")
        named = _joined(np.stack([xx, xy], -1), yy[..., np.newaxis], _pair("mean", mean))
        shown = c.tolist() if c.ndim == 2 else f"<shape {c.shape}>"
        return cls._of(
            _native.surface_of_covariance(named),
            f".from_covariance({shown}, mean={_shown(named[..., 3:])})",
        )

    @classmethod
    def turned(cls, alpha: ArrayLike, angle: ArrayLike, mean: ArrayLike = (0.0, 0.0)) -> Surface:
        """The surface of roughness `alpha`, turned about z by `angle` radians, from x towards y.

        Parameters
        ----------
        alpha : float, (2,) or (..., 2)
            Roughness along both axes before the turn, > 0.
        angle : float or (...)
            Radians.
        mean : (2,) or (..., 2)
            Mean slope, which is not turned.

        Raises
        ------
        ValueError
            For shapes that do not go together.

        Examples
        --------
        >>> import vndf
        >>> vndf.Surface.turned((0.3, 0.1), 0.5)
        vndf.Surface.turned(alpha=(0.3, 0.1), angle=0.5, mean=(0.0, 0.0))
        """
        turn = np.asarray(angle, np.float64)[..., np.newaxis]
        named = _joined(_pair("alpha", alpha), turn, _pair("mean", mean))
        return cls._of(
            _native.turned_surface(named),
            f".turned(alpha={_shown(named[..., :2])}, angle={_shown(named[..., 2])}, "
            f"mean={_shown(named[..., 3:])})",
        )

    @classmethod
    def _of(cls, numbers: NDArray[np.float64], text: str) -> Surface:
        surface = cls.__new__(cls)
        surface._set(numbers, text)
        return surface

    def _set(self, numbers: NDArray[np.float64], text: str) -> None:
        self._numbers = numbers  # that store it, in double precision (lib/vndf/rough_surface.h)
        self._text = text

    def __repr__(self) -> str:
        return f"vndf.Surface{self._text}"


def _joined(*parts: NDArray[np.float64]) -> NDArray[np.float64]:
    """Parts of surfaces along one last axis."""
    try:
        shape = np.broadcast_shapes(*(p.shape[:-1] for p in parts))
    except ValueError:
        shapes = ", ".join(str(p.shape[:-1]) for p in parts)
        raise ValueError(
            f"the parts of a surface have the shapes {shapes}; give as many of each, or one"
        ) from None
    return np.concatenate([np.broadcast_to(p, shape + p.shape[-1:]) for p in parts], axis=-1)


def _pair(name: str, value: ArrayLike) -> NDArray[np.float64]:
    array = np.asarray(value, np.float64)
    if array.ndim == 0:
        array = np.broadcast_to(array, (2,))
    if array.shape[-1] != 2:
        raise ValueError(f"{name} has shape {array.shape}; its last axis must have 2 numbers")
    return array


def _shown(numbers: NDArray[np.float64]) -> str:
    if numbers.ndim == 0:
        return str(float(numbers))
    return str(tuple(numbers.tolist())) if numbers.ndim == 1 else f"<shape {numbers.shape}>"
