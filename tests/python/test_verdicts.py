"""The validator from Python."""

import pickle

import pytest

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


def test_a_wrong_sampler_fails():
    verdict = vndf.validate(vndf.reference.ggx_analytic, thoroughness="quick")
    assert not verdict.passed
    assert "ggx-analytic: FAIL" in str(verdict)


def test_what_cannot_be_validated_is_told(table):
    with pytest.raises(TypeError, match="vndf.check"):
        vndf.validate(lambda wi: wi)
    with pytest.raises(ValueError, match="slow"):
        vndf.validate(table, thoroughness="slow")
