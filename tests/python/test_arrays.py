"""Shapes, precisions, strides and wrong arguments, which are the same for every function."""

import numpy as np
import pytest
from conftest import directions

import vndf

WI = (0.6, 0.0, 0.8)


def test_one_sample_has_the_shape_of_one_vector(table):
    wm = table.sample(WI, 0.3, (0.25, 0.75))
    assert wm.shape == (3,)
    assert isinstance(table.pdf(WI, wm, 0.3), np.floating)


@pytest.mark.parametrize(
    "wi, alpha, u, shape",
    [
        ((3,), (), (7, 2), (7,)),
        ((7, 3), (2,), (7, 2), (7,)),
        ((7, 3), (7, 2), (2,), (7,)),
        ((7, 3), (7, 1), (7, 2), (7,)),
        ((7, 3), (7,), (7, 2), (7,)),
        ((5, 1, 3), (2,), (7, 2), (5, 7)),
        ((5, 1, 3), (4, 1, 1, 2), (1, 7, 2), (4, 5, 7)),
        ((1, 3), (1, 2), (1, 2), (1,)),
    ],
)
def test_axes_before_the_last_broadcast(table, random, wi, alpha, u, shape):
    w = directions(random, *wi[:-1]).astype(np.float32)
    a = random.uniform(0.1, 1, alpha).astype(np.float32)
    v = random.random(u, dtype=np.float32)
    wm = table.sample(w, a, v)
    assert wm.shape == shape + (3,)
    whole = a[..., np.newaxis] if alpha == () or alpha == (7,) else a
    each = [np.broadcast_to(x, shape + x.shape[-1:]) for x in (w, whole, v)]
    for place in np.ndindex(shape):
        one = table.sample(each[0][place], each[1][place] * np.ones(2, np.float32), each[2][place])
        assert np.array_equal(wm[place], one)


@pytest.mark.parametrize("function", ["d", "lambda_", "g1"])
def test_functions_of_one_direction_broadcast_with_roughness(table, random, function):
    w = directions(random, 5, 1)
    values = getattr(table, function)(w, random.uniform(0.1, 1, (7, 2)))
    assert values.shape == (5, 7)


def test_results_have_the_precision_of_the_arrays(table, baked, pair):
    single, double = np.float32([WI]), np.array([WI])
    u = np.float32([[0.5, 0.5]])
    for t in (table, pair):
        assert t.sample(single, 0.3, u).dtype == np.float32
        assert t.sample(single, np.array([0.3, 0.1]), u).dtype == np.float32
        assert t.sample(double, 0.3, u).dtype == np.float64
        assert t.sample(WI, 0.3, u).dtype == np.float32
        assert t.sample(WI, 0.3, (0.5, 0.5)).dtype == np.float64
        assert t.sample(single.astype(np.float16), 0.3, u).dtype == np.float32
    for w in (single, double):
        assert baked.sample(w, 0.3, u).dtype == np.float32


def test_baked_tables_round_double_precision(baked, random):
    wi, u = directions(random, 100), random.random((100, 2))
    rounded = baked.sample(wi.astype(np.float32), 0.3, u.astype(np.float32))
    assert np.array_equal(baked.sample(wi, 0.3, u), rounded)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_strides_do_not_matter(table, random, dtype):
    n = 3000
    wi, u = directions(random, n).astype(dtype), random.random((n, 2)).astype(dtype)
    alpha = random.uniform(0.1, 1, (n, 2)).astype(dtype)
    expected = table.sample(wi, alpha, u)
    fortran = [np.asfortranarray(x) for x in (wi, alpha, u)]
    assert np.array_equal(table.sample(*fortran), expected)
    spaced = [np.repeat(np.repeat(x, 2, 0), 2, 1)[::2, ::2] for x in (wi, alpha, u)]
    assert np.array_equal(table.sample(*spaced), expected)
    backwards = [x[::-1] for x in (wi, alpha, u)]
    assert np.array_equal(table.sample(*backwards)[::-1], expected)
    swapped = [x.astype(x.dtype.newbyteorder()) for x in (wi, alpha, u)]
    assert np.array_equal(table.sample(*swapped), expected)
    unaligned = [
        np.frombuffer(b"x" + x.tobytes(), dtype, offset=1).reshape(x.shape) for x in (wi, alpha, u)
    ]
    assert np.array_equal(table.sample(*unaligned), expected)
    folded = [x.reshape(3, -1, 10, x.shape[1]).swapaxes(0, 2) for x in (wi, alpha, u)]
    assert np.array_equal(table.sample(*folded).swapaxes(0, 2).reshape(n, 3), expected)


def test_read_only_arrays_are_read(table, random):
    u = random.random((5, 2), dtype=np.float32)
    u.flags.writeable = False
    assert np.array_equal(table.sample(WI, 0.3, u), table.sample(WI, 0.3, u.copy()))


def test_arrays_without_samples_give_none(table):
    none = np.empty((0, 3), np.float32)
    assert table.sample(none, 0.3, (0.5, 0.5)).shape == (0, 3)
    assert table.pdf(none, none, 0.3).shape == (0,)
    assert table.sample(WI, 0.3, np.empty((4, 0, 2))).shape == (4, 0, 3)
    assert table.invert(none, none, 0.3).shape == (0, 2)
    assert vndf.ConductorBrdf(table, 0.3, [1, 2], [3, 4]).evaluate(none, none).shape == (0, 2)


def test_what_is_no_number_gives_the_fallbacks_of_the_library(table, baked, pair):
    nan = float("nan")
    for t in (table, baked, pair, vndf.reference.ggx_exact):
        for wi, alpha in (((nan, 0, 1), 0.3), (WI, nan), (WI, 0.0), (WI, -1.0)):
            assert np.array_equal(t.sample(wi, alpha, (0.5, 0.5)), [0, 0, 1])
            assert t.pdf(wi, (0, 0, 1), alpha) == 0
            assert t.g1(wi, alpha) == 0
    assert np.isnan(table.invert((nan, 0, 1), (0, 0, 1), 0.3)).all()
    assert table.sample_with_density((nan, 0, 1), 0.3, (0.5, 0.5)).density == 0


def test_an_array_of_results_may_be_given(table, random):
    u = random.random((1000, 2), dtype=np.float32)
    expected = table.sample(WI, 0.3, u)
    out = np.empty((1000, 3), np.float32)
    assert table.sample(WI, 0.3, u, out=out) is out
    assert np.array_equal(out, expected)
    part = np.zeros((2000, 6), np.float32)[::2, ::2]
    assert np.array_equal(table.sample(WI, 0.3, u, out=part), expected)


@pytest.mark.parametrize(
    "out, error, message",
    [
        (np.empty((9, 3), np.float32), ValueError, r"\(9, 3\).*\(10, 3\)"),
        (np.empty((10, 3)), ValueError, "float64.*float32"),
        ([0], TypeError, "list"),
        (np.broadcast_to(np.float32(0), (10, 3)), ValueError, "read-only"),
    ],
)
def test_an_array_of_results_must_fit(table, out, error, message):
    with pytest.raises(error, match=message):
        table.sample(WI, 0.3, np.zeros((10, 2), np.float32), out=out)


@pytest.mark.parametrize(
    "wi, alpha, u, message",
    [
        ((5, 3), (), (4, 2), r"wi has shape \(5, 3\) and u has shape \(4, 2\)"),
        ((5, 3), (4, 2), (5, 2), r"wi has shape \(5, 3\).*alpha has shape \(4, 2\)"),
        ((5, 3), (4,), (5, 2), r"alpha has shape \(4,\)"),
        ((5, 2), (), (5, 2), r"wi has shape \(5, 2\); its last axis must have 3 numbers"),
        ((3,), (), (5, 3), r"u has shape \(5, 3\); its last axis must have 2 numbers"),
        ((), (), (2,), r"wi has shape \(\)"),
        ((3,), (5, 3), (2,), r"alpha has shape \(5, 3\); give a number, a pair"),
    ],
)
def test_wrong_shapes_are_named(table, wi, alpha, u, message):
    with pytest.raises(ValueError, match=message):
        table.sample(np.ones(wi), np.ones(alpha), np.ones(u))


@pytest.mark.parametrize("wrong", ["text", [None, 0, 1], [1j, 0, 1], [True, False, True]])
def test_what_is_not_real_numbers_is_a_type_error(table, wrong):
    with pytest.raises(TypeError, match="wi has the dtype"):
        table.sample(wrong, 0.3, (0.5, 0.5))


def test_ragged_lists_are_refused(table):
    with pytest.raises((TypeError, ValueError)):
        table.sample([[0, 0, 1], [0, 1]], 0.3, (0.5, 0.5))


@pytest.mark.parametrize("threads, error", [(-1, ValueError), (1.5, TypeError), ("2", TypeError)])
def test_threads_must_be_a_whole_number(table, threads, error):
    with pytest.raises(error):
        table.sample(WI, 0.3, (0.5, 0.5), threads=threads)


def test_results_do_not_depend_on_threads(table, random):
    n = 200_000
    wi, u = directions(random, n).astype(np.float32), random.random((n, 2), dtype=np.float32)
    one = table.sample(wi, 0.3, u, threads=1)
    for threads in (0, 2, 3, 64):
        assert np.array_equal(table.sample(wi, 0.3, u, threads=threads), one)
