"""Every example of a docstring runs, every public function has one, and the hints are right."""

import doctest
import importlib.util
import inspect
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import vndf

FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
MODULES = (
    vndf,
    vndf.reference,
    *(
        sys.modules["vndf." + name]
        for name in ("_sampler", "_surface", "_tables", "_bsdfs", "_verdicts")
    ),
)


def test_examples_run(table, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # some write files
    names = {"np": np, "vndf": vndf, "table": table}
    runner = doctest.DocTestRunner(optionflags=FLAGS)
    for module in MODULES:
        for test in doctest.DocTestFinder().find(module, module=module, extraglobs=names):
            runner.run(test)
    assert runner.failures == 0
    assert runner.tries > 60


def public_functions():
    for name in vndf.__all__:
        thing = getattr(vndf, name)
        if inspect.isfunction(thing):
            yield f"vndf.{name}", thing
        if inspect.isclass(thing) and not issubclass(thing, tuple):
            for member, value in vars(thing).items():
                value = getattr(value, "fget", None) or getattr(value, "__func__", value)
                if inspect.isfunction(value) and not member.startswith("_"):
                    yield f"vndf.{name}.{member}", value


def test_every_public_function_is_documented_with_an_example():
    found = dict(public_functions())
    assert len(found) > 25
    for name, function in found.items():
        assert function.__doc__, name
        examples = ">>>" in function.__doc__
        assert examples or name == "vndf.Verdict.passed", name


USER = '''
import numpy as np
import vndf

table: vndf.Table = vndf.build("ggx", size=64, tolerance=1e-3)
wm = table.sample((0.6, 0.0, 0.8), 0.3, np.zeros((5, 2), np.float32))
first: float = float(wm[0, 0])
drawn = table.sample_with_density((0.6, 0.0, 0.8), vndf.Surface((0.3, 0.1), 0.5), (0.5, 0.5))
density: float = drawn.density
brdf = vndf.ConductorBrdf(vndf.reference.ggx_caps, (0.3, 0.1), [0.2, 1.0], [3.0, 2.0])
figures: dict[str, float] = table.certificate
verdict: vndf.Verdict = vndf.validate(table, thoroughness="quick")
'''


@pytest.mark.skipif(importlib.util.find_spec("mypy") is None, reason="mypy is not installed")
def test_hints_are_right_in_strict_mode(tmp_path):
    (tmp_path / "user.py").write_text(USER)
    (tmp_path / "wrong.py").write_text(USER + "\ntable.sample(1)\nvndf.build(size='large')\n")
    package = Path(vndf.__file__).parent
    check = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache")]

    def run(*files):
        return subprocess.run(
            [*check, *map(str, files)],
            capture_output=True,
            text=True,
            env={**os.environ, "MYPYPATH": str(package.parent)},
        )

    right = run(package, tmp_path / "user.py")
    assert right.returncode == 0, right.stdout
    wrong = run(tmp_path / "wrong.py")
    assert wrong.stdout.count("error:") >= 2
