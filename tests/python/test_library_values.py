"""Every function gives what the C++ library gives, bit for bit."""

import subprocess

import numpy as np
import pytest
from conftest import directions

import vndf

N = 1500  # more than a block


@pytest.fixture(scope="module", params=["ggx", "exponential-power:p=0.5"])
def compared(request, library_values, tmp_path_factory):
    """A table, inputs, and what library_values.cpp gives for them in single and in double."""
    folder = tmp_path_factory.mktemp("values")
    table = vndf.build(request.param, size=128, tolerance=1e-4, max_bytes=1 << 20)
    table.save(folder / "baked.vndf")
    table.save(folder / "pair.h5")
    random = np.random.default_rng(1)
    wi, wo = directions(random, N), directions(random, N)
    wi[: N // 8, 2] *= -1  # below the horizon
    wo[::2, 2] *= -1
    alpha = np.exp(random.uniform(-3, 1, (N, 2)))
    alpha[-5:] = [[np.nan, 1], [0, 1], [-1, 1], [1, np.inf], [1e-4, 1]]
    u = random.random((N, 3))
    u[:4] = [[0, 0, 0], [1, 1, 1], [0, 1, 0.5], [1, 0, 0.5]]
    inputs = [x.astype(np.float32).astype(np.float64) for x in (wi, wo, alpha, u)]
    np.hstack(inputs).tofile(folder / "inputs")
    subprocess.run(
        [library_values, "values"]
        + [str(folder / name) for name in ("baked.vndf", "pair.h5", "inputs", "results")],
        check=True,
    )
    results = np.fromfile(folder / "results").reshape(N, 2, -1)
    return table, inputs, {np.float32: results[:, 0], np.float64: results[:, 1]}


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_all_functions(compared, dtype):
    table, inputs, expected = compared
    wi, wo, alpha, u = (x.astype(dtype) for x in inputs)
    uv = u[:, :2]
    surface = vndf.Surface(inputs[2], 0.5, (0.1, -0.2))
    metal = vndf.ConductorBrdf(table, surface, (0.2, 1.5), (3, 2))
    glass = vndf.DielectricBsdf(table, alpha, 1.5)
    wm = table.sample(wi, alpha, uv)
    tilted = table.sample(wi, surface, uv)
    columns = [
        wm,
        table.pdf(wi, wm, alpha),
        table.d(wm, alpha),
        table.lambda_(wi, alpha),
        table.g1(wi, alpha),
        table.g2(wi, wo, wm, alpha),
        *table.sample_with_density(wi, alpha, uv),
        np.nan_to_num(table.invert(wi, wm, alpha), nan=-1),
        tilted,
        table.pdf(wi, tilted, surface),
        table.d(tilted, surface),
        table.lambda_(wi, surface),
        *metal.sample(wi, uv),
        metal.evaluate(wi, wo)[:, 1],
        metal.pdf(wi, wo),
        *glass.sample(wi, u),
        glass.evaluate(wi, wo),
        glass.pdf(wi, wo),
    ]
    assert all(c.dtype == dtype for c in columns)
    found = np.column_stack(columns).astype(np.float64)
    # As bits, because a number that is none differs from itself, and 0 is not -0.
    assert np.array_equal(found.view(np.uint64), expected[dtype].view(np.uint64))


def test_one_direction_and_one_surface_are_those_of_many(compared):
    table, inputs, _ = compared
    wi, _, alpha, u = (x.astype(np.float32) for x in inputs)
    uv = u[:, :2]
    wis, alphas = np.repeat(wi[-9:-8], N, 0), np.repeat(alpha[-9:-8], N, 0)
    expected = table.sample(wis, alphas, uv)
    assert np.array_equal(table.sample(wi[-9], alpha[-9], uv), expected)
    assert np.array_equal(table.sample(wis, alpha[-9], uv), expected)
    assert np.array_equal(table.sample(wi[-9], alphas, uv), expected)
    one = vndf.Surface(alpha[-9], 0.5, (0.1, -0.2))
    many = vndf.Surface(alphas, 0.5, (0.1, -0.2))
    assert np.array_equal(table.sample(wi, one, uv), table.sample(wi, many, uv))
