"""Tables: built, loaded, saved and sampled from."""

from __future__ import annotations

import os
from typing import Any, Callable, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arguments import Floats, Vectors, numbers, plain, thread_count
from ._sampler import Alpha, SampledNormals, Sampler
from ._surface import Surface

Path = Union[str, "os.PathLike[str]"]


class Table(Sampler):
    """Tables of a slope distribution, from which normals are sampled; of `build` and `load`.

    A table has the pair of tables (Heitz and d'Eon 2014), which serves both precisions, or the baked
    tables of a renderer, from which batches are drawn in single precision, or both. Where it has
    both, float32 is sampled from the baked tables and float64 from the pair. Where it has baked
    tables alone, float64 is rounded to float32, and so are results.

    Tables are immutable and may be used by several threads, pickled and copied. The functions are
    those of the C++ library, bit for bit.

    Examples
    --------
    >>> import vndf
    >>> table = vndf.build("ggx", size=256)
    >>> table
    <vndf.Table of ggx: baked tables and pair, max u-error ...>
    """

    def __init__(self, tables: _native.Tables) -> None:
        self._tables = tables
        self._sampler = tables.sampler()

    def sample_with_density(
        self, wi: ArrayLike, alpha: Alpha, u: ArrayLike, *, threads: int = 0
    ) -> SampledNormals:
        """Draws normals, each with the density that the map of the tables has there.

        An estimate that divides by this density, rather than by `pdf`, has no error of the tables.

        Parameters
        ----------
        wi : (..., 3)
            Incident directions.
        alpha : number, array or Surface
            Roughness, > 0.
        u : (..., 2)
            Random numbers in [0, 1].
        threads : int
            0 means one for each processor.

        Returns
        -------
        (wm, density) : the normals of `sample`, (..., 3), and densities, (...).

        Raises
        ------
        ValueError, TypeError
            As `sample`.

        Examples
        --------
        >>> wm, density = table.sample_with_density((0.6, 0.0, 0.8), 0.3, (0.25, 0.75))
        >>> abs(density / table.pdf((0.6, 0.0, 0.8), wm, 0.3) - 1) < 1e-3
        True
        """
        a = self._prepare(alpha, Vectors("wi", wi, 3), Vectors("u", u, 2))
        wm, density = a.empty(3), a.empty()
        _native.sample_with_density(
            self._sampler,
            a.arrays[0],
            a.alpha,
            a.arrays[1],
            wm,
            density[..., np.newaxis],
            thread_count(threads),
        )
        return SampledNormals(wm, plain(density))

    def invert(self, wi: ArrayLike, wm: ArrayLike, alpha: Alpha, *, threads: int = 0) -> Floats:
        """The random numbers for which `sample` gives `wm`.

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
        (..., 2) : random numbers; not a number where none give the normal.

        Raises
        ------
        ValueError, TypeError
            As `sample`.

        Examples
        --------
        >>> wm = table.sample((0.6, 0.0, 0.8), 0.3, (0.25, 0.75))
        >>> table.invert((0.6, 0.0, 0.8), wm, 0.3).round(6)
        array([0.25, 0.75])
        """
        a = self._prepare(alpha, Vectors("wi", wi, 3), Vectors("wm", wm, 3))
        u = a.empty(2)
        _native.invert(self._sampler, *a.arrays, a.alpha, u, thread_count(threads))
        return u

    def bake(
        self,
        tolerance: float = 1e-5,
        *,
        max_bytes: int = 262144,
        below_horizon: bool = True,
        threads: int = 0,
    ) -> Table:
        """Bakes the pair once more, and returns a table of the pair and the new baked tables.

        Parameters
        ----------
        tolerance : float
            Largest difference from the pair, in u, from 1e-6 to 1e-2.
        max_bytes : int
            Most bytes that sampling may read.
        below_horizon : bool
            Whether directions below the horizon can be sampled.
        threads : int
            0 means one for each processor.

        Raises
        ------
        ValueError
            For a table without a pair, an option outside its range, and a tolerance that cannot be
            kept within the bytes.

        Examples
        --------
        >>> rough = table.bake(tolerance=1e-3)
        >>> len(rough.tobytes()) < len(table.tobytes())
        True
        """
        baking = _native.Baking(tolerance, max_bytes, below_horizon)
        return Table(_native.bake(self._tables, baking, thread_count(threads)))

    def save(self, path: Path) -> None:
        """Writes the baked tables (.vndf) or the pair (.h5 or .exr), which the ending chooses.

        A file is written as a whole or not at all.

        Raises
        ------
        ValueError
            For another ending, and for a part that the table does not have.
        OSError
            For a file that cannot be written.

        Examples
        --------
        >>> table.save("ggx.vndf")
        """
        name = os.fspath(path)
        ending = os.path.splitext(name)[1].lower()
        if ending not in (".vndf", ".h5", ".hdf5", ".exr"):
            raise ValueError(f"{name}: give a name that ends in .vndf, .h5 or .exr")
        if ending == ".vndf":
            if not self._tables.has_kernel:
                raise ValueError(f"{name}: this table has no baked tables; call bake() first")
            _native.save_kernel(self._tables, name)
        else:
            if not self._tables.has_pair:
                raise ValueError(
                    f"{name}: this table has no pair, only the tables baked from it; save a .vndf "
                    "file"
                )
            _native.save_pair(self._tables, name)

    def tobytes(self, *, with_text: bool = True) -> bytes:
        """The baked tables, as a .vndf file has them.

        Parameters
        ----------
        with_text : bool
            Whether the name and the provenance are among them. Without these, tables of the same
            numbers have the same bytes.

        Raises
        ------
        ValueError
            For a table without baked tables.

        Examples
        --------
        >>> vndf.load(table.tobytes()).tobytes() == table.tobytes()
        True
        """
        if not self._tables.has_kernel:
            raise ValueError("this table has no baked tables; call bake() first")
        return self._tables.bytes_of_kernel(with_text)

    @property
    def distribution(self) -> str:
        """The name of the distribution, for people.

        >>> table.distribution
        'ggx'
        """
        return self._tables.distribution

    @property
    def specification(self) -> str:
        """The text from which the distribution can be made again; empty for a Python function.

        >>> table.specification
        'ggx'
        """
        return self._tables.specification

    @property
    def notes(self) -> str:
        """What was found while the table was built, in lines; empty if nothing.

        >>> table.notes
        ''
        """
        return self._tables.notes

    @property
    def surface(self) -> Optional[Surface]:
        """The surface of the map that the table is from, in units of the distribution, or None.

        It is what was taken out of the map: roughness, correlation and mean slope.

        >>> table.surface is None
        True
        """
        named = self._tables.surface
        return None if named is None else Surface(named[:2], named[2], named[3:])

    @property
    def certificate(self) -> dict[str, float]:
        """The measured errors, by their names in files: of the baked tables if there are some.

        >>> table.certificate["marginal_max_u_error"] < 1e-3
        True
        """
        tables = self._tables
        return tables.certificate_of_kernel if tables.has_kernel else tables.certificate_of_pair

    @property
    def has_pair(self) -> bool:
        """Whether there is a pair of tables, and thus double precision.

        >>> table.has_pair
        True
        """
        return self._tables.has_pair

    @property
    def has_baked(self) -> bool:
        """Whether there are baked tables, and thus fast batches.

        >>> table.has_baked
        True
        """
        return self._tables.has_kernel

    def __repr__(self) -> str:
        parts = [
            text
            for text, there in (("baked tables", self.has_baked), ("pair", self.has_pair))
            if there
        ]
        error = self.certificate["marginal_max_u_error"]
        has = " and ".join(parts)
        return f"<vndf.Table of {self.distribution}: {has}, max u-error {error:.2e}>"

    def __str__(self) -> str:
        """Everything that is known of the table, as `vndf info` prints it."""
        tables = self._tables
        return tables.describe_kernel() if tables.has_kernel else tables.describe_pair()

    def __reduce__(self) -> tuple[Any, ...]:
        tables = self._tables
        return _restored, (
            tables.bytes_of_pair() if tables.has_pair else None,
            tables.bytes_of_kernel(True) if tables.has_kernel else None,
        )


def _restored(pair: Optional[bytes], kernel: Optional[bytes]) -> Table:
    return Table(_native.tables_of_parts(pair, kernel))


def load(source: Union[Path, bytes, bytearray, memoryview]) -> Table:
    """Loads tables from a file of any kind, or from the bytes of one.

    Parameters
    ----------
    source : path or bytes
        A file of baked tables (.vndf) or of a pair (.h5 or .exr), told by its first bytes.

    Raises
    ------
    FileNotFoundError, OSError
        For a file that is not there or cannot be read.
    ValueError
        For a file that is damaged or something else. The message says which rule it breaks.

    Examples
    --------
    >>> table.save("ggx.vndf")
    >>> vndf.load("ggx.vndf").certificate == table.certificate
    True
    """
    if isinstance(source, (bytes, bytearray, memoryview)):
        return Table(_native.tables_of_bytes(bytes(source)))
    path = os.fspath(source)
    with open(path, "rb"):  # a file that cannot be read is an OSError with its number
        pass
    return Table(_native.tables_of_file(path))


def build(
    distribution: Optional[str] = None,
    *,
    p22: Union[str, Callable[[float], float], None] = None,
    ndf: Optional[str] = None,
    profile: Optional[tuple[ArrayLike, ArrayLike]] = None,
    normal_map: Union[ArrayLike, Path, None] = None,
    params: Optional[Mapping[str, float]] = None,
    breaks: Sequence[float] = (),
    frozen_at: Optional[float] = None,
    tail: Optional[str] = None,
    smooth: bool = False,
    encoding: Optional[str] = None,
    ignore_asymmetry: bool = False,
    name: str = "",
    size: Union[int, tuple[int, int]] = 1024,
    precision: str = "single",
    tolerance: Optional[float] = 1e-5,
    max_bytes: int = 262144,
    below_horizon: bool = True,
    threads: int = 0,
) -> Table:
    """Builds the tables of a slope distribution, and bakes them.

    Give one of the first five, as to `vndf build` of the program.

    Parameters
    ----------
    distribution : str
        A named one, as "ggx", "student-t:gamma=2.5" or "mixture:0.7*ggx+0.3*beckmann@0.2".
    p22 : str or function
        The density of slopes at slope radius r >= 0, in any scale: a formula in r, or a function
        float -> float. A function is called some 1e7 times, on this thread, and builds the same
        numbers as a formula of the same values; but files cannot say what it was.
    ndf : str
        The normal distribution, a formula in theta (radians), or in theta and alpha.
    profile : (r, p22)
        Samples (N,) of p22 at increasing slope radii r.
    normal_map : (H, W, 3), (H, W, 2) or path
        Normals, floats in [-1, 1] or [0, 1] or integers of 8 or 16 bits; slopes, floats; or a file.
    params : mapping
        The numbers that a formula uses by name.
    breaks : sequence
        Slope radii at which a formula or function jumps or has a kink.
    frozen_at : float
        Takes the surface of this alpha of an `ndf` as the shape.
    tail : "none", "exponential" or "power"
        What a profile does beyond its last sample; none by default.
    smooth : bool
        Takes the noise out of a profile.
    encoding : "automatic", "plain" or "shifted"
        How a map stores normals n as values v: n = v, or n = 2 v - 1.
    ignore_asymmetry : bool
        Accepts a map whose slopes are not radially symmetric.
    name : str
        The name of the distribution, for people.
    size : int or (int, int)
        Nodes of the pair along an axis, or (rows, columns), from 2 x 5 to 8192 x 8192.
    precision : "single" or "double"
        Of the stored values of the pair.
    tolerance : float or None
        Largest difference of the baked tables from the pair, in u, from 1e-6 to 1e-2; None bakes
        none.
    max_bytes : int
        Most bytes that sampling from the baked tables may read.
    below_horizon : bool
        Whether baked tables serve directions below the horizon.
    threads : int
        0 means one for each processor.

    Returns
    -------
    Table : with a pair, and baked tables unless `tolerance` is None.

    Raises
    ------
    ValueError
        For a text, samples or a map that are wrong, for a density that cannot be normalised or has
        no finite mean slope, and for a tolerance that cannot be kept.
    TypeError
        For arguments that do not go together, or of another type.

    What a function raises is raised.

    Examples
    --------
    >>> mine = vndf.build(p22="exp(-k*r^2)", params={"k": 2.5}, size=64, name="mine")
    >>> mine.specification
    "p22:'exp(-k*r^2)' param:k=2.5 name:'mine'"
    """
    sources = {
        "distribution": distribution,
        "p22": p22,
        "ndf": ndf,
        "profile": profile,
        "normal_map": normal_map,
    }
    given = [key for key, value in sources.items() if value is not None]
    if len(given) != 1:
        raise TypeError(
            f"build() needs one of {', '.join(sources)}; "
            + (f"{' and '.join(given)} are given" if given else "none is given")
        )
    formula = isinstance(p22, str) or ndf is not None
    _require("params", params is not None, formula, "a formula of p22 or ndf")
    _require("breaks", len(breaks) > 0, p22 is not None or ndf is not None, "p22 or ndf")
    _require("frozen_at", frozen_at is not None, ndf is not None, "ndf")
    _require("tail", tail is not None, profile is not None, "profile")
    _require("smooth", smooth, profile is not None, "profile")
    _require("encoding", encoding is not None, normal_map is not None, "normal_map")
    _require("ignore_asymmetry", ignore_asymmetry, normal_map is not None, "normal_map")
    if callable(p22) and thread_count(threads) > 1:
        raise ValueError("a function is called on one thread; leave threads out")
    numbers_of = dict(params or {})
    marks = [float(r) for r in breaks]
    if distribution is not None:
        source = _native.source_of_family(distribution, name)
    elif isinstance(p22, str):
        source = _native.source_of_p22(p22, numbers_of, marks, name)
    elif p22 is not None:
        if not callable(p22):
            raise TypeError(f"p22 is of type {type(p22).__name__}; give a formula or a function")
        source = _native.source_of_function(p22, marks, name or _name_of(p22))
    elif ndf is not None:
        source = _native.source_of_ndf(ndf, numbers_of, frozen_at, marks, name)
    elif profile is not None:
        source = _source_of_profile(profile, tail or "none", smooth, name or "profile")
    else:
        assert normal_map is not None
        source = _source_of_map(normal_map, encoding or "automatic", ignore_asymmetry, name)
    baking = None
    if tolerance is not None:
        baking = _native.Baking(tolerance, max_bytes, below_horizon)
    shown = f"{given[0]}={_shown(sources[given[0]])}"
    command = f"vndf.build({shown}, size={size}, tolerance={tolerance})"
    return Table(
        _native.build(source, _size_of(size, precision), baking, command, thread_count(threads))
    )


def _require(option: str, given: bool, has_effect: bool, sources: str) -> None:
    if given and not has_effect:
        raise TypeError(f"{option} goes with {sources}")


def _name_of(function: object) -> str:
    name = getattr(function, "__name__", type(function).__name__)
    return "p22" if name == "<lambda>" else str(name)


def _shown(source: object) -> str:
    """What the provenance says of a source: nothing that differs from run to run."""
    return repr(source) if isinstance(source, str) else f"<{type(source).__name__}>"


def _size_of(size: Union[int, tuple[int, int]], precision: str) -> _native.Size:
    if precision not in ("single", "double"):
        raise ValueError(f"precision is '{precision}'; it must be single or double")
    rows, columns = (size, size) if isinstance(size, int) else size
    if rows < 0 or columns < 0:
        raise ValueError(f"size is {size}; it must be from 2 x 5 to 8192 x 8192")
    return _native.Size(rows, columns, precision == "double")


def _source_of_profile(
    profile: tuple[ArrayLike, ArrayLike], tail: str, smooth: bool, name: str
) -> _native.Source:
    if not isinstance(profile, (tuple, list)) or len(profile) != 2:
        raise TypeError("profile must be the pair (r, p22) of two arrays")
    r, p22 = (numbers(what, values) for what, values in zip(("r", "p22"), profile))
    if r.ndim != 1 or r.shape != p22.shape:
        raise ValueError(
            f"r has shape {r.shape} and p22 has shape {p22.shape}; both must be (N,), as many "
            "radii as densities"
        )
    return _native.source_of_profile(r, p22, tail, smooth, name)


def _source_of_map(
    normal_map: Union[ArrayLike, Path], encoding: str, ignore_asymmetry: bool, name: str
) -> _native.Source:
    if isinstance(normal_map, (str, os.PathLike)):
        path = os.fspath(normal_map)
        with open(path, "rb"):
            pass
        stem = os.path.splitext(os.path.basename(path))[0]
        return _native.source_of_map_file(path, encoding, ignore_asymmetry, name or stem)
    array = np.asarray(normal_map)
    if array.ndim != 3 or array.shape[2] not in (2, 3) or array.size == 0:
        raise ValueError(
            f"normal_map has shape {array.shape}; give normals (H, W, 3) or slopes (H, W, 2)"
        )
    whole = array.dtype in (np.uint8, np.uint16)
    if whole and array.shape[2] == 3:
        array = array / np.float32(np.iinfo(array.dtype).max)
    elif array.dtype.kind != "f":
        raise TypeError(
            f"normal_map has the dtype {array.dtype}; give floats, or normals of uint8 or uint16"
        )
    values = np.ascontiguousarray(array, np.float32)
    return _native.source_of_map(values, whole, encoding, ignore_asymmetry, name or "normal_map")
