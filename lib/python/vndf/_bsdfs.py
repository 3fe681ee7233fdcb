"""BSDFs over any sampler of normals."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arguments import Floats, Vectors, numbers, plain, prepare, thread_count
from ._sampler import Alpha, Sampler


class BsdfSample(NamedTuple):
    """Directions that a BSDF draws. Where weight and pdf are 0, light is lost and wo is nothing."""

    wo: Floats
    weight: Any
    pdf: Any


class ConductorBrdf:
    """Reflection by a rough metal, with correlated masking and shadowing.

    Parameters
    ----------
    sampler : Sampler
        A `vndf.Table` or one of `vndf.reference`.
    alpha : number, array or Surface
        Roughness, as in `Sampler.sample`. It broadcasts with directions.
    eta, k : float or (C,)
        Real and imaginary part of the refractive index, one for each channel of colour, relative to
        the medium of wi. eta > 0, k >= 0.

    Raises
    ------
    ValueError
        For eta and k of different lengths.
    TypeError
        For a sampler that is none.

    Examples
    --------
    >>> gold = vndf.ConductorBrdf(table, (0.3, 0.1), (0.14, 0.37, 1.44), (4.1, 2.3, 1.8))
    >>> drawn = gold.sample((0.6, 0.0, 0.8), (0.25, 0.75))
    >>> drawn.weight.round(3)
    array([0.969, 0.793, 0.374])
    """

    def __init__(self, sampler: Sampler, alpha: Alpha, eta: ArrayLike, k: ArrayLike) -> None:
        self._sampler = _checked(sampler)
        self._alpha = alpha
        e, extinction = (numbers(*named) for named in (("eta", eta), ("k", k)))
        if e.ndim > 1 or e.shape != extinction.shape or e.size == 0:
            raise ValueError(
                f"eta has shape {e.shape} and k has shape {extinction.shape}; give two numbers, or "
                "two arrays (C,) of as many channels"
            )
        self._channels = e.shape
        self._indices = list(zip(e.ravel().tolist(), extinction.ravel().tolist()))

    def evaluate(self, wi: ArrayLike, wo: ArrayLike, *, threads: int = 0) -> Any:
        """f(wi, wo) wo.z for each channel.

        Parameters
        ----------
        wi, wo : (..., 3)
            Unit vectors that point away from the surface.
        threads : int
            0 means one for each processor.

        Returns
        -------
        (..., C), or (...) where eta is a number: 0 below the horizon.

        Raises
        ------
        ValueError, TypeError
            As `Sampler.sample`.

        Examples
        --------
        >>> metal = vndf.ConductorBrdf(table, 0.3, 0.2, 3.0)
        >>> round(metal.evaluate((0.6, 0.0, 0.8), (-0.6, 0.0, 0.8)), 3)
        0.995
        """
        a = self._prepare(Vectors("wi", wi, 3), Vectors("wo", wo, 3))
        f = a.empty(len(self._indices))
        _native.conductor_evaluate(
            self._sampler._sampler,
            *a.arrays,
            a.alpha,
            self._indices,
            f,
            thread_count(threads),
        )
        return self._shaped(f)

    def pdf(self, wi: ArrayLike, wo: ArrayLike, *, threads: int = 0) -> Any:
        """Density with which `sample` draws wo, per solid angle.

        Parameters
        ----------
        wi, wo : (..., 3)
            Unit vectors that point away from the surface.
        threads : int
            0 means one for each processor.

        Returns
        -------
        (...) : densities.

        Raises
        ------
        ValueError, TypeError
            As `Sampler.sample`.

        Examples
        --------
        >>> metal = vndf.ConductorBrdf(table, 0.3, 0.2, 3.0)
        >>> round(metal.pdf((0.6, 0.0, 0.8), (-0.6, 0.0, 0.8)), 3)
        1.092
        """
        a = self._prepare(Vectors("wi", wi, 3), Vectors("wo", wo, 3))
        pdf = a.empty()
        _native.conductor_pdf(
            self._sampler._sampler,
            *a.arrays,
            a.alpha,
            pdf[..., np.newaxis],
            thread_count(threads),
        )
        return plain(pdf)

    def sample(self, wi: ArrayLike, u: ArrayLike, *, threads: int = 0) -> BsdfSample:
        """Draws wo.

        Parameters
        ----------
        wi : (..., 3)
            Unit vectors that point away from the surface.
        u : (..., 2)
            Random numbers in [0, 1].
        threads : int
            0 means one for each processor.

        Returns
        -------
        (wo, weight, pdf) : (..., 3), (..., C) and (...). The weight is f wo.z / pdf.

        Raises
        ------
        ValueError, TypeError
            As `Sampler.sample`.

        Examples
        --------
        >>> metal = vndf.ConductorBrdf(table, 0.3, 0.2, 3.0)
        >>> wo, weight, pdf = metal.sample((0.6, 0.0, 0.8), np.random.random((1000, 2)))
        >>> wo.shape, weight.shape, pdf.shape
        ((1000, 3), (1000,), (1000,))
        """
        a = self._prepare(Vectors("wi", wi, 3), Vectors("u", u, 2))
        wo, weight, pdf = a.empty(3), a.empty(len(self._indices)), a.empty()
        _native.conductor_sample(
            self._sampler._sampler,
            a.arrays[0],
            a.alpha,
            a.arrays[1],
            self._indices,
            wo,
            weight,
            pdf[..., np.newaxis],
            thread_count(threads),
        )
        return BsdfSample(wo, self._shaped(weight), plain(pdf))

    def _prepare(self, *arguments: Vectors) -> Any:
        return prepare(self._sampler._sampler.in_double, self._alpha, *arguments)

    def _shaped(self, channels: Floats) -> Any:
        return channels if self._channels else plain(channels[..., 0])


class DielectricBsdf:
    """Reflection and transmission by a rough dielectric, such as glass.

    Parameters
    ----------
    sampler : Sampler
        A `vndf.Table` or one of `vndf.reference`.
    alpha : number, array or Surface
        Roughness, as in `Sampler.sample`.
    eta : float
        Refractive index below the surface over that above, > 0.

    Raises
    ------
    ValueError
        For eta <= 0.
    TypeError
        For a sampler that is none.

    Examples
    --------
    >>> glass = vndf.DielectricBsdf(table, 0.3, 1.5)
    >>> wo, weight, pdf = glass.sample((0.6, 0.0, 0.8), (0.25, 0.75, 0.9))
    >>> bool(wo[2] < 0)  # transmitted
    True
    """

    def __init__(self, sampler: Sampler, alpha: Alpha, eta: float) -> None:
        self._sampler = _checked(sampler)
        self._alpha = alpha
        self._eta = float(eta)
        if not self._eta > 0:
            raise ValueError(f"eta is {eta}; it must be > 0")

    def evaluate(self, wi: ArrayLike, wo: ArrayLike, *, threads: int = 0) -> Any:
        """f(wi, wo) |wo.z|, of energy; wi and wo may be on either side.

        Parameters
        ----------
        wi, wo : (..., 3)
            Unit vectors that point away from the surface.
        threads : int
            0 means one for each processor.

        Returns
        -------
        (...) : numbers >= 0.

        Raises
        ------
        ValueError, TypeError
            As `Sampler.sample`.

        Examples
        --------
        >>> glass = vndf.DielectricBsdf(table, 0.3, 1.5)
        >>> round(glass.evaluate((0.6, 0.0, 0.8), (-0.4, 0.0, -0.9165)), 3)
        20.759
        """
        return self._evaluate(_native.dielectric_evaluate, wi, wo, threads)

    def pdf(self, wi: ArrayLike, wo: ArrayLike, *, threads: int = 0) -> Any:
        """Density with which `sample` draws wo, per solid angle.

        Parameters
        ----------
        wi, wo : (..., 3)
            Unit vectors that point away from the surface.
        threads : int
            0 means one for each processor.

        Returns
        -------
        (...) : densities.

        Raises
        ------
        ValueError, TypeError
            As `Sampler.sample`.

        Examples
        --------
        >>> glass = vndf.DielectricBsdf(table, 0.3, 1.5)
        >>> round(glass.pdf((0.6, 0.0, 0.8), (-0.4, 0.0, -0.9165)), 3)
        20.849
        """
        return self._evaluate(_native.dielectric_pdf, wi, wo, threads)

    def sample(self, wi: ArrayLike, u: ArrayLike, *, threads: int = 0) -> BsdfSample:
        """Draws wo.

        Parameters
        ----------
        wi : (..., 3)
            Unit vectors that point away from the surface.
        u : (..., 3)
            Random numbers in [0, 1]: two for the normal, and one for reflection or transmission.
        threads : int
            0 means one for each processor.

        Returns
        -------
        (wo, weight, pdf) : (..., 3), (...) and (...). The weight is f |wo.z| / pdf.

        Raises
        ------
        ValueError, TypeError
            As `Sampler.sample`.

        Examples
        --------
        >>> glass = vndf.DielectricBsdf(table, 0.3, 1.5)
        >>> glass.sample((0.6, 0.0, 0.8), np.random.random((1000, 3))).wo.shape
        (1000, 3)
        """
        a = self._prepare(Vectors("wi", wi, 3), Vectors("u", u, 3))
        wo, weight, pdf = a.empty(3), a.empty(), a.empty()
        _native.dielectric_sample(
            self._sampler._sampler,
            a.arrays[0],
            a.alpha,
            a.arrays[1],
            self._eta,
            wo,
            weight[..., np.newaxis],
            pdf[..., np.newaxis],
            thread_count(threads),
        )
        return BsdfSample(wo, plain(weight), plain(pdf))

    def _prepare(self, *arguments: Vectors) -> Any:
        return prepare(self._sampler._sampler.in_double, self._alpha, *arguments)

    def _evaluate(self, function: Any, wi: ArrayLike, wo: ArrayLike, threads: int) -> Any:
        a = self._prepare(Vectors("wi", wi, 3), Vectors("wo", wo, 3))
        results = a.empty()
        function(
            self._sampler._sampler,
            *a.arrays,
            a.alpha,
            self._eta,
            results[..., np.newaxis],
            thread_count(threads),
        )
        return plain(results)


def _checked(sampler: Sampler) -> Sampler:
    if not isinstance(sampler, Sampler):
        raise TypeError(
            f"sampler is of type {type(sampler).__name__}; give a vndf.Table or one of "
            "vndf.reference"
        )
    return sampler
