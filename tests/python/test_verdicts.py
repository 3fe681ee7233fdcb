"""The validator from Python."""

import pickle

import numpy as np
import pytest
from conftest import directions

import vndf


def test_a_verdict_is_a_dict_that_prints_like_the_program(table):
    verdict = vndf.validate(table, thoroughness="quick", seed=3)
    assert verdict.passed and verdict["passed"] is True
    assert verdict["sampler"] == "ggx"
    assert {r["check"] for r in verdict["results"]} >= {"hard cases", "inverse", "distribution"}
    lines = str(verdict).splitlines()
    assert lines[0] == "ggx: pass"
    assert lines[1].startswith("  pass  hard cases")
    assert repr(verdict) == str(verdict)
    again = pickle.loads(pickle.dumps(verdict))
    assert again == verdict and str(again) == str(verdict)


def caps(wi, alpha, u):
    """Spherical caps in NumPy: a sampler of one's own."""
    scale = np.append(alpha, 1.0)
    w = wi * scale
    w /= np.linalg.norm(w, axis=-1, keepdims=True)
    z = (1 - u[:, 1]) * (1 + w[:, 2]) - w[:, 2]
    sine, phi = np.sqrt((1 - z * z).clip(0)), 2 * np.pi * u[:, 0]
    m = (np.stack([sine * np.cos(phi), sine * np.sin(phi), z], -1) + w) * scale
    return m / np.linalg.norm(m, axis=-1, keepdims=True)


@pytest.fixture(scope="module")
def samples():
    random = np.random.default_rng(1)
    wi, u = directions(random, 50_000), random.random((50_000, 2))
    alpha = np.array([0.3, 0.1])
    return wi, alpha, caps(wi, alpha, u), u


def test_samples_of_ones_own_are_accepted(samples, table):
    wi, alpha, wm, u = samples
    pdf = vndf.reference.ggx_exact.pdf(wi, wm, alpha)
    verdict = vndf.check(wi, alpha, wm, u, pdf, against="ggx", name="my caps")
    assert verdict.passed
    lines = str(verdict).splitlines()
    assert lines[0] == "my caps against ggx: pass" and lines[-1] == "accepted"
    checks = {r["check"] for r in verdict["results"]}
    assert {"density", "distribution"} <= checks
    assert vndf.check(wi, alpha, wm, against=table).passed


def test_wrong_samples_are_rejected(samples):
    wi, alpha, wm, u = samples
    wrong = vndf.check(wi, alpha * 1.05, wm, against="ggx")
    assert not wrong.passed and str(wrong).splitlines()[-1].startswith("rejected: ")
    pdf = 1.01 * vndf.reference.ggx_exact.pdf(wi, wm, alpha)
    assert not vndf.check(wi, alpha, wm, pdf=pdf, against="ggx").passed


def test_samples_on_surfaces_are_checked(table):
    random = np.random.default_rng(1)
    u = random.random((50_000, 2))
    surface = vndf.Surface.turned((0.4, 0.1), 0.7, (0.2, -0.1))
    wm = table.sample((0.3, 0.0, np.sqrt(0.91)), surface, u)
    good = vndf.check((0.3, 0.0, np.sqrt(0.91)), surface, wm, u, against=table, u_error=1e-3)
    assert good.passed, str(good)
    other = vndf.Surface.turned((0.4, 0.1), 0.75, (0.2, -0.1))
    assert not vndf.check((0.3, 0.0, np.sqrt(0.91)), other, wm, against=table).passed


@pytest.mark.parametrize(
    "change, error, message",
    [
        ({"wi": np.ones((5, 3))}, ValueError, r"wi has shape \(5, 3\) and wm has shape"),
        ({"wm": np.ones((50_000, 3))}, ValueError, "sample 0: mx,my,mz must have length 1"),
        ({"u": np.full((50_000, 2), np.nan)}, ValueError, "sample 0: u1 and u2"),
        ({"u": np.full((50_000, 2), 2)}, ValueError, "sample 0: u1 and u2"),
        ({"alpha": -1}, ValueError, "sample 0: ax and ay"),
        ({"against": "gggx"}, ValueError, "gggx"),
        ({"against": "none.vndf"}, FileNotFoundError, "none.vndf"),
        ({"against": 3}, TypeError, "int"),
        ({"normals": "some"}, ValueError, "some"),
    ],
)
def test_samples_that_cannot_be_checked_are_told(samples, change, error, message):
    arguments = dict(zip(("wi", "alpha", "wm", "u"), samples), against="ggx")
    with pytest.raises(error, match=message):
        vndf.check(**{**arguments, **change})


def test_a_few_samples_are_too_few(samples):
    wi, alpha, wm, _ = samples
    with pytest.raises(ValueError, match="100"):
        vndf.check(wi[:99], alpha, wm[:99], against="ggx")


def test_what_cannot_be_validated_is_told(table):
    with pytest.raises(TypeError, match="vndf.check"):
        vndf.validate(lambda wi: wi)
    with pytest.raises(ValueError, match="slow"):
        vndf.validate(table, thoroughness="slow")
