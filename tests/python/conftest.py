"""Tables and inputs that the tests share."""

import os

import numpy as np
import pytest

import vndf


@pytest.fixture(scope="session")
def table():
    """Baked tables and the pair."""
    return vndf.build("ggx", size=256)


@pytest.fixture(scope="session")
def baked(table):
    """Baked tables alone."""
    return vndf.load(table.tobytes())


@pytest.fixture(scope="session")
def pair():
    """A pair alone."""
    return vndf.build("student-t:gamma=2.5", size=64, tolerance=None)


@pytest.fixture(scope="session")
def library_values():
    """The program of library_values.cpp."""
    return os.environ["VNDF_LIBRARY_VALUES"]


@pytest.fixture()
def random():
    return np.random.default_rng(1)


def directions(random, *shape):
    """Unit vectors above the surface."""
    w = random.normal(size=shape + (3,))
    w[..., 2] = np.abs(w[..., 2])
    return w / np.linalg.norm(w, axis=-1, keepdims=True)
