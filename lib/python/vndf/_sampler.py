"""What tables and the samplers of the papers have in common."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arguments import Arguments, Floats, Vectors, plain, prepare, thread_count
from ._surface import Surface

Alpha = Union[ArrayLike, Surface]


class SampledNormals(NamedTuple):
    """Normals with the density that they were drawn with."""

    wm: Floats
    density: Any


class Sampler:
    """A sampler of microfacet normals: a `vndf.Table` or one of `vndf.reference`.

    All functions take arrays whose last axis has the numbers of one sample, and broadcast the axes
    before it. Directions are unit vectors of the shading frame, with z along the normal of the
    surface; densities are per solid angle. For an input outside its range (alpha <= 0, a component
    that is not a number) a function returns what it states, and raises nothing.

    `alpha` is the roughness: a number; a pair along x and y; an array whose last axis has 1 or 2
    numbers; an array (N,) of one number for each sample, unless N is 2, which is a pair; or a
    `vndf.Surface`.

    Results are float64 where an array of directions or random numbers is float64 and the sampler
    has double precision, and float32 elsewhere. Numbers, tuples and lists take the precision of the
    arrays beside them, and are float64 if there are none.

    `threads` is the number of threads to run; 0 means one for each processor. Results do not depend
    on it, and other threads of Python run meanwhile.
    """

    _sampler: _native.Sampler

    def sample(
        self,
        wi: ArrayLike,
        alpha: Alpha,
        u: ArrayLike,
        *,
        out: Optional[Floats] = None,
        threads: int = 0,
    ) -> Floats:
        """Draws the normals visible from `wi`.

        Parameters
        ----------
        wi : (..., 3)
            Incident directions, also below the horizon.
        alpha : number, array or Surface
            Roughness, > 0.
        u : (..., 2)
            Random numbers in [0, 1].
        out : (..., 3), optional
            Where the normals go: an array of the shape and dtype of the result.
        threads : int
            0 means one for each processor.

        Returns
        -------
        (..., 3) : unit normals; (0, 0, 1) for an input outside its range.

        Raises
        ------
        ValueError
            For shapes that do not broadcast, and for an `out` of another shape or dtype.
        TypeError
            For something that is not real numbers.

        Examples
        --------
        >>> table.sample((0.6, 0.0, 0.8), (0.3, 0.1), np.float32([0.25, 0.75]))
        array([ 0.2559..., -0.0568...,  0.9650...], dtype=float32)
        """
        a = self._prepare(alpha, Vectors("wi", wi, 3), Vectors("u", u, 2))
        wm = a.empty(3) if out is None else _checked_out(out, a)
        _native.sample(
            self._sampler, a.arrays[0], a.alpha, a.arrays[1], wm, thread_count(threads)
        )
        return wm

    def pdf(self, wi: ArrayLike, wm: ArrayLike, alpha: Alpha, *, threads: int = 0) -> Any:
        """Density of `sample` per solid angle, that of the exact distribution.

        Parameters
        ----------
        wi, wm : (..., 3)
            Incident directions and normals.
        alpha : number, array or Surface
            Roughness, > 0.
        threads : int
            0 means one for each processor.

        Returns
        -------
        (...) : densities, >= 0; 0 for an input outside its range.

        Raises
        ------
        ValueError, TypeError
            As `sample`.

        Examples
        --------
        >>> round(table.pdf((0.6, 0.0, 0.8), (0.0, 0.0, 1.0), (0.3, 0.1)), 3)
        10.479
        """
        a = self._prepare(alpha, Vectors("wi", wi, 3), Vectors("wm", wm, 3))
        return self._evaluate(_native.pdf, a, threads)

    def d(self, wm: ArrayLike, alpha: Alpha, *, threads: int = 0) -> Any:
        """The distribution of normals D(wm) per solid angle.

        Parameters
        ----------
        wm : (..., 3)
            Normals.
        alpha : number, array or Surface
            Roughness, > 0.
        threads : int
            0 means one for each processor.

        Returns
        -------
        (...) : densities; 0 for a normal on or below the horizon and an input outside its range.

        Raises
        ------
        ValueError, TypeError
            As `sample`.

        Examples
        --------
        >>> round(table.d((0.0, 0.0, 1.0), (0.3, 0.1)), 3)  # 1 / (pi 0.3 0.1) for GGX
        10.61
        """
        return self._evaluate(_native.d, self._prepare(alpha, Vectors("wm", wm, 3)), threads)

    def lambda_(self, w: ArrayLike, alpha: Alpha, *, threads: int = 0) -> Any:
        """Smith's Lambda(w), of the direction or its mirror below the horizon.

        Parameters
        ----------
        w : (..., 3)
            Directions.
        alpha : number, array or Surface
            Roughness, > 0.
        threads : int
            0 means one for each processor.

        Returns
        -------
        (...) : numbers >= 0, infinite at the horizon; 0 for an input outside its range.

        Raises
        ------
        ValueError, TypeError
            As `sample`.

        Examples
        --------
        >>> round(table.lambda_((0.6, 0.0, 0.8), 0.3), 4)
        0.0125
        """
        return self._evaluate(_native.lambda_, self._prepare(alpha, Vectors("w", w, 3)), threads)

    def g1(self, w: ArrayLike, alpha: Alpha, *, threads: int = 0) -> Any:
        """Smith's masking G1(w) = 1 / (1 + Lambda(w)).

        Parameters
        ----------
        w : (..., 3)
            Directions.
        alpha : number, array or Surface
            Roughness, > 0.
        threads : int
            0 means one for each processor.

        Returns
        -------
        (...) : numbers in [0, 1]; 0 for an input outside its range.

        Raises
        ------
        ValueError, TypeError
            As `sample`.

        Examples
        --------
        >>> round(table.g1((0.6, 0.0, 0.8), 0.3), 4)
        0.9877
        """
        return self._evaluate(_native.g1, self._prepare(alpha, Vectors("w", w, 3)), threads)

    def g2(
        self, wi: ArrayLike, wo: ArrayLike, wm: ArrayLike, alpha: Alpha, *, threads: int = 0
    ) -> Any:
        """Masking and shadowing G2(wi, wo, wm), in reflection and in transmission.

        It is that of Smith with correlated heights (Heitz 2014), and that of V-cavities for
        samplers of these.

        Parameters
        ----------
        wi, wo, wm : (..., 3)
            Two directions, on any side of the surface, and normals.
        alpha : number, array or Surface
            Roughness, > 0.
        threads : int
            0 means one for each processor.

        Returns
        -------
        (...) : numbers in [0, 1].

        Raises
        ------
        ValueError, TypeError
            As `sample`.

        Examples
        --------
        >>> round(table.g2((0.6, 0.0, 0.8), (-0.6, 0.0, 0.8), (0.0, 0.0, 1.0), 0.3), 4)
        0.9756
        """
        a = self._prepare(
            alpha, Vectors("wi", wi, 3), Vectors("wo", wo, 3), Vectors("wm", wm, 3)
        )
        return self._evaluate(_native.g2, a, threads)

    def _prepare(self, alpha: Alpha, *arguments: Vectors) -> Arguments:
        return prepare(self._sampler.in_double, alpha, *arguments)

    def _evaluate(self, function: Any, a: Arguments, threads: int) -> Any:
        results = a.empty()
        function(
            self._sampler,
            *a.arrays,
            a.alpha,
            results[..., np.newaxis],
            thread_count(threads),
        )
        return plain(results)


def _checked_out(out: Floats, a: Arguments) -> Floats:
    if not isinstance(out, np.ndarray):
        raise TypeError(f"out is of type {type(out).__name__}; give an array")
    wanted = a.shape + (3,)
    if out.shape != wanted or out.dtype != a.dtype:
        raise ValueError(
            f"out has shape {out.shape} and dtype {out.dtype}; the result has shape {wanted} and "
            f"dtype {a.dtype}"
        )
    if not out.flags.writeable:
        raise ValueError("out is read-only; give an array that may be written")
    return out
