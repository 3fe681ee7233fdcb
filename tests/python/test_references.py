"""The samplers of the papers."""

import pickle

import numpy as np
import pytest

import vndf

WI = (0.6, 0.0, 0.8)


def test_there_are_those_that_the_program_lists():
    from vndf import _native

    assert [name for name, _ in _native.named_references()] == list(vndf.reference.samplers)
    assert sorted(_native.references()) == sorted(vndf.reference.samplers)
    for name, sampler in vndf.reference.samplers.items():
        assert getattr(vndf.reference, name.replace("-", "_").replace(".", "_")) is sampler


@pytest.mark.parametrize("name", list(vndf.reference.samplers))
def test_each_draws_with_its_density(name, random):
    sampler = vndf.reference.samplers[name]
    u = random.random((20_000, 2))
    wm = sampler.sample(WI, 0.4, u)
    assert np.linalg.norm(wm, axis=1) == pytest.approx(1)
    assert wm.dtype == np.float64
    assert sampler.sample(WI, 0.4, u.astype(np.float32)).dtype == np.float32
    # The mean of wm.z^2 / pdf over the normals is the integral of z^2 over those that can be drawn.
    pdf = sampler.pdf(WI, wm, 0.4)
    assert np.all(pdf > 0)
    inside = wm[:, 2] > 0.95  # where all is drawn
    assert np.mean(np.where(inside, 1 / pdf, 0)) == pytest.approx(2 * np.pi * 0.05, rel=0.05)


def test_ggx_is_ggx_whatever_draws_it(table, random):
    u = random.random((1000, 2))
    exact = vndf.reference.ggx_exact
    assert table.sample(WI, 0.3, u) == pytest.approx(exact.sample(WI, 0.3, u), abs=1e-3)
    wm = exact.sample(WI, 0.3, u)
    for name in ("ggx_caps", "ggx_hemisphere", "ggx_analytic"):
        other = getattr(vndf.reference, name)
        assert other.pdf(WI, wm, 0.3) == pytest.approx(exact.pdf(WI, wm, 0.3), rel=1e-9)


def test_they_are_pickled():
    for sampler in vndf.reference.samplers.values():
        assert pickle.loads(pickle.dumps(sampler)) is sampler
