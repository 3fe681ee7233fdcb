"""Surfaces with correlated slopes or a mean slope."""

import pickle

import numpy as np
import pytest
from conftest import directions

import vndf


def test_a_surface_without_correlation_and_mean_is_its_roughness(table, random):
    wi, u = directions(random, 100), random.random((100, 2))
    flat = vndf.Surface((0.3, 0.1))
    assert np.array_equal(table.sample(wi, flat, u), table.sample(wi, (0.3, 0.1), u))
    assert np.array_equal(table.d(wi, vndf.Surface(0.3)), table.d(wi, 0.3))


def test_three_ways_to_the_same_surface(table, random):
    wi = directions(random, 100)
    turned = vndf.Surface.turned((0.4, 0.1), 0.5)
    c, s = np.cos(0.5), np.sin(0.5)
    rotation = np.array([[c, -s], [s, c]])
    covariance = rotation @ np.diag([0.16, 0.01]) @ rotation.T
    covariance = (covariance + covariance.T) / 2
    of_covariance = vndf.Surface.from_covariance(covariance)
    x, y = np.sqrt(np.diag(covariance))
    correlated = vndf.Surface((x, y), covariance[0, 1] / (x * y))
    expected = table.d(wi @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]), (0.4, 0.1))
    for surface in (turned, of_covariance, correlated):
        assert table.d(wi, surface) == pytest.approx(expected, rel=1e-9)


def test_d_of_a_tilted_surface_keeps_its_projected_area(table):
    # The mean facet of the mean slope (a, b) shows int D(wm) dot(wm, w) = w.z - a w.x - b w.y.
    surface = vndf.Surface((0.3, 0.2), 0.4, (0.2, -0.1))
    z = (np.arange(2000) + 0.5) / 2000
    phi = (np.arange(400) + 0.5) / 400 * 2 * np.pi
    sine = np.sqrt(1 - z * z)[:, np.newaxis]
    wm = np.stack(np.broadcast_arrays(sine * np.cos(phi), sine * np.sin(phi), z[:, np.newaxis]), -1)
    d = table.d(wm, surface)[..., np.newaxis]
    mean = (d * wm).sum((0, 1)) * 2 * np.pi / (2000 * 400)
    assert mean == pytest.approx([-0.2, 0.1, 1], abs=2e-3)


def test_arrays_of_surfaces_broadcast(table, random):
    wi, u = directions(random, 5), random.random((5, 2))
    surfaces = vndf.Surface(random.uniform(0.1, 1, (5, 2)), np.linspace(-0.5, 0.5, 5), (0.1, 0))
    many = table.sample(wi, surfaces, u)
    assert many.shape == (5, 3)
    with pytest.raises(ValueError, match=r"alpha has shape \(5, 5\)"):
        table.sample(np.ones((4, 3)), surfaces, np.ones((4, 2)))


def test_surfaces_print_and_pickle(table):
    for surface in (
        vndf.Surface((0.3, 0.1), 0.5, (0.1, 0)),
        vndf.Surface.turned(0.3, 0.5),
        vndf.Surface.from_covariance(np.eye(2)),
        vndf.Surface(np.ones((5, 2))),
    ):
        again = pickle.loads(pickle.dumps(surface))
        assert repr(again) == repr(surface)
        w = (0.6, 0.0, 0.8)
        assert np.array_equal(table.d(w, again), table.d(w, surface))


@pytest.mark.parametrize(
    "make, message",
    [
        (lambda: vndf.Surface(0.3, 1), "correlation"),
        (lambda: vndf.Surface((1, 2, 3)), r"alpha has shape \(3,\)"),
        (lambda: vndf.Surface(0.3, 0, (1, 2, 3)), r"mean has shape \(3,\)"),
        (lambda: vndf.Surface(np.ones((3, 2)), np.zeros(4)), "shapes"),
        (lambda: vndf.Surface.from_covariance(np.ones(3)), r"\(3,\)"),
        (lambda: vndf.Surface.from_covariance([[1, 2], [2, 1]]), "positive"),
        (lambda: vndf.Surface.from_covariance([[1, 0], [0.1, 1]]), "symmetric"),
    ],
)
def test_wrong_surfaces_are_told(make, message):
    with pytest.raises(ValueError, match=message):
        make()
