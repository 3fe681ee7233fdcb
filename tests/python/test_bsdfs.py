"""BSDFs over tables and over the samplers of the papers."""

import pickle

import numpy as np
import pytest

import vndf

WI = (0.6, 0.0, 0.8)


def test_channels_are_those_of_the_indices(table, random):
    u = random.random((100, 2), dtype=np.float32)
    eta, k = [0.2, 0.9, 1.5, 2.0, 1.2], [3.0, 2.5, 2.0, 0.0, 4.0]
    many = vndf.ConductorBrdf(table, 0.3, eta, k)
    wo, weight, pdf = many.sample(WI, u)
    assert (wo.shape, weight.shape, pdf.shape) == ((100, 3), (100, 5), (100,))
    value = many.evaluate(WI, wo)
    for c in range(5):
        one = vndf.ConductorBrdf(table, 0.3, eta[c], k[c])
        drawn = one.sample(WI, u)
        assert np.array_equal(drawn.wo, wo) and np.array_equal(drawn.pdf, pdf)
        assert np.array_equal(drawn.weight, weight[:, c])
        assert np.array_equal(one.evaluate(WI, wo), value[:, c])


@pytest.mark.parametrize("name", ["ggx_caps", "ggx_ndf", "ggx_v_cavity"])
def test_a_weight_is_the_value_over_the_density(name, random):
    u = random.random((1000, 2))
    for alpha in (0.3, vndf.Surface((0.3, 0.2), 0.4, (0.1, 0.0))):
        metal = vndf.ConductorBrdf(getattr(vndf.reference, name), alpha, 0.2, 3.0)
        wo, weight, pdf = metal.sample(WI, u)
        kept = pdf > 0
        assert kept.mean() > 0.5
        assert pdf[kept] == pytest.approx(metal.pdf(WI, wo)[kept], rel=1e-6)
        assert weight[kept] * pdf[kept] == pytest.approx(metal.evaluate(WI, wo)[kept], rel=1e-6)


def test_glass_reflects_and_transmits(table, random):
    glass = vndf.DielectricBsdf(table, 0.3, 1.5)
    u = random.random((20_000, 3))
    wo, weight, pdf = glass.sample(WI, u)
    assert 0.02 < np.mean(wo[:, 2] > 0) < 0.2
    assert np.max(weight) <= 1
    kept = pdf > 0
    assert weight[kept] * pdf[kept] == pytest.approx(glass.evaluate(WI, wo)[kept], rel=1e-6)


def test_bsdfs_are_pickled(table, random):
    u = random.random((10, 3))
    glass = vndf.DielectricBsdf(table, vndf.Surface(0.3, 0.5), 1.5)
    metal = vndf.ConductorBrdf(vndf.reference.ggx_caps, (0.3, 0.1), 0.2, 3.0)
    for bsdf, v in ((glass, u), (metal, u[:, :2])):
        again = pickle.loads(pickle.dumps(bsdf))
        assert np.array_equal(again.sample(WI, v).wo, bsdf.sample(WI, v).wo)


@pytest.mark.parametrize(
    "make, error, message",
    [
        (lambda t: vndf.ConductorBrdf(t, 0.3, [1, 2], 3), ValueError, r"\(2,\).*\(\)"),
        (lambda t: vndf.ConductorBrdf(t, 0.3, [], []), ValueError, r"\(0,\)"),
        (lambda t: vndf.ConductorBrdf("ggx", 0.3, 1, 2), TypeError, "str"),
        (lambda t: vndf.DielectricBsdf(t, 0.3, 0), ValueError, "eta"),
        (lambda t: vndf.DielectricBsdf(t, 0.3, 1.5).sample(WI, (0.5, 0.5)), ValueError, r"u has"),
    ],
)
def test_wrong_bsdfs_are_told(table, make, error, message):
    with pytest.raises(error, match=message):
        make(table)
