"""The scripts of tests/examples/python make their pictures. How they look is judged by people."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("matplotlib")

EXAMPLES = Path(__file__).parent.parent / "examples" / "python"


@pytest.mark.parametrize(
    "script, arguments",
    [
        ("plot_lobes.py", ["--size", "64"]),
        ("fit_profile.py", ["--size", "16"]),
        ("variance.py", ["--size", "64", "--samples", "1000"]),
    ],
)
def test_a_picture_is_made(script, arguments, tmp_path):
    picture = tmp_path / "picture.png"
    subprocess.run(
        [sys.executable, EXAMPLES / script, *arguments, "--output", picture],
        check=True,
        env={**os.environ, "MPLBACKEND": "Agg", "MPLCONFIGDIR": str(tmp_path)},
    )
    header = picture.read_bytes()[:24]
    assert header.startswith(b"\x89PNG")
    assert int.from_bytes(header[16:20], "big") == 1000  # pixels across
