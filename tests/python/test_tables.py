"""Tables: built from anything, saved, loaded, pickled, and what is refused."""

import copy
import math
import pickle
import resource
import threading

import numpy as np
import pytest
from conftest import directions

import vndf

WI = (0.6, 0.0, 0.8)
SMALL = {"size": 32, "tolerance": 1e-2}
PAIR = {"size": 32, "tolerance": None}


@pytest.fixture(scope="module")
def of_function():
    def mine(r):
        return math.exp(-r * r) if r < 2 else 0

    return vndf.build(p22=mine, breaks=[2], **SMALL)


def test_a_function_builds_the_numbers_of_its_formula(of_function):
    formula = vndf.build(p22="r < 2 ? exp(-r*r) : 0", breaks=[2], **SMALL)
    assert of_function.tobytes(with_text=False) == formula.tobytes(with_text=False)
    assert formula.specification.startswith("p22:")
    assert of_function.specification == "" and of_function.distribution == "mine"


def test_samples_are_checked_against_a_function_where_it_is_known(of_function):
    u = np.random.default_rng(1).random((200, 2))
    wm = of_function.sample(WI, 0.3, u)
    assert vndf.check(WI, 0.3, wm, u, against=of_function, u_error=0.02).passed
    with pytest.raises(ValueError):
        vndf.check(WI, 0.3, wm, against=pickle.loads(pickle.dumps(of_function)))


def test_what_a_function_raises_is_raised():
    calls = 0

    def fails(r):
        nonlocal calls
        calls += 1
        if calls > 20_000:
            raise KeyError("late")
        return math.exp(-r)

    with pytest.raises(KeyError, match="late"):
        vndf.build(p22=fails, **SMALL)
    with pytest.raises(ZeroDivisionError):
        vndf.build(p22=lambda r: 1 / 0, **SMALL)
    with pytest.raises(TypeError, match="real number"):
        vndf.build(p22=lambda r: "text", **SMALL)


def test_a_function_that_is_no_density_is_named():
    with pytest.raises(ValueError, match="mine"):
        vndf.build(p22=lambda r: -1.0, name="mine", **SMALL)
    with pytest.raises(ValueError, match="one thread"):
        vndf.build(p22=lambda r: math.exp(-r), threads=2)


def test_other_threads_run_while_a_function_is_called():
    beats, done = [], threading.Event()

    def beat():
        while not done.wait(0.001):
            beats.append(1)

    def density(r):
        if len(beats) > 3:
            raise StopIteration
        return math.exp(-r * r)

    thread = threading.Thread(target=beat)
    thread.start()
    with pytest.raises(StopIteration):
        vndf.build(p22=density, **SMALL)
    done.set()
    thread.join()


WM = (0.1, 0.2, math.sqrt(0.95))


def test_profiles_are_arrays():
    r = np.linspace(0, 4, 40)
    noisy = np.exp(-r * r) * (1 + 0.01 * np.sin(40 * r))
    table = vndf.build(
        profile=(r, noisy), tail="exponential", smooth=True, name="measured", **PAIR
    )
    assert table.distribution == "measured"
    assert table.specification.startswith("profile tail:exponential=")
    assert "smoothed" in table.notes and "fitted within" in table.notes
    assert table.d(WM, 0.5) == pytest.approx(vndf.reference.beckmann_ndf.d(WM, 0.5), rel=0.05)


def test_maps_are_arrays_or_files(tmp_path):
    slopes = np.random.default_rng(1).normal(size=(200, 200, 2)) * np.sqrt(0.5) * (0.3, 0.1)
    normals = np.dstack([-slopes, np.ones(slopes.shape[:2])])
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    table = vndf.build(normal_map=np.uint16(np.round((normals + 1) / 2 * 65535)), **PAIR)
    assert "normals n = 2 v - 1, 200 x 200 texels" in table.notes
    # E|X| of unit roughness is 1 of a map, and 1 / sqrt(pi) of Beckmann.
    gaussian = vndf.reference.beckmann_ndf
    assert table.d(WM, 0.5 / math.sqrt(math.pi)) == pytest.approx(gaussian.d(WM, 0.5), rel=0.05)
    # What was taken out of the map can be put back.
    slopes_of_surface = gaussian.d(WM, (0.3, 0.1))
    assert table.d(WM, table.surface) == pytest.approx(slopes_of_surface, rel=0.1)
    # Other maps, which are refused because a texel is wrong or the map is not radially symmetric.
    square = np.random.default_rng(1).uniform(-1, 1, size=(200, 200, 2)).astype(np.float32)
    with pytest.raises(ValueError, match="symmetric"):
        vndf.build(normal_map=square, **SMALL)
    normals[3, 5] = [0, 0, -1]
    with pytest.raises(ValueError, match="mine: the texel in column 5 of row 3"):
        vndf.build(normal_map=normals, name="mine", **SMALL)
    with pytest.raises(FileNotFoundError):
        vndf.build(normal_map=tmp_path / "none.exr")


@pytest.mark.parametrize(
    "arguments, error, message",
    [
        ({}, TypeError, "none is given"),
        ({"distribution": "ggx", "p22": "1"}, TypeError, "distribution and p22 are given"),
        ({"distribution": "gggx"}, ValueError, "did you mean"),
        ({"p22": "exp(-r"}, ValueError, "column"),
        ({"p22": 3}, TypeError, "int"),
        ({"p22": "exp(-k*r)", "params": {"k": -1}}, ValueError, "."),
        ({"distribution": "ggx", "params": {"k": 1}}, TypeError, "params goes with"),
        ({"distribution": "ggx", "breaks": [1]}, TypeError, "breaks goes with"),
        ({"distribution": "ggx", "tail": "power"}, TypeError, "tail goes with"),
        ({"distribution": "ggx", "frozen_at": 1}, TypeError, "frozen_at goes with"),
        ({"ndf": "cos(theta)^(2/alpha^2-2)"}, ValueError, "shape-invariant"),
        ({"profile": [1, 2, 3]}, TypeError, "pair"),
        ({"profile": (np.ones(4), np.ones(5))}, ValueError, r"\(4,\).*\(5,\)"),
        ({"profile": (np.arange(4), np.ones(4)), "tail": "long"}, ValueError, "long"),
        ({"normal_map": np.ones((3, 4))}, ValueError, r"\(3, 4\)"),
        ({"normal_map": np.ones((3, 4, 3), int)}, TypeError, "int64"),
        ({"normal_map": np.ones((30, 40, 2)), "encoding": "x"}, ValueError, "'x'"),
        ({"distribution": "ggx", "size": 1}, ValueError, "."),
        ({"distribution": "ggx", "size": -1}, ValueError, "-1"),
        ({"distribution": "ggx", "precision": "half"}, ValueError, "half"),
        ({"distribution": "ggx", "size": 32, "tolerance": 1}, ValueError, "tolerance"),
        ({"distribution": "ggx", "size": 32, "max_bytes": 1000}, ValueError, "bytes"),
    ],
)
def test_what_cannot_be_built_is_told(arguments, error, message):
    with pytest.raises(error, match=message):
        vndf.build(**arguments)


def test_files_and_bytes_hold_the_same(table, tmp_path):
    table.save(tmp_path / "t.vndf")
    assert (tmp_path / "t.vndf").read_bytes() == table.tobytes()
    path = tmp_path / "t.vndf"
    for source in (path, str(path), table.tobytes(), bytearray(table.tobytes())):
        assert vndf.load(source).tobytes() == table.tobytes()
    for ending in ("h5", "exr"):
        path = tmp_path / f"t.{ending}"
        table.save(path)
        for source in (path, path.read_bytes()):
            loaded = vndf.load(source)
            assert loaded.has_pair and not loaded.has_baked
            u = (0.3, 0.4)
            assert np.array_equal(loaded.sample(WI, 0.3, u), table.sample(WI, 0.3, u))
    assert vndf.load(tmp_path / "t.h5").bake().tobytes() == table.tobytes()


def test_what_cannot_be_loaded_is_told(table, tmp_path):
    with pytest.raises(FileNotFoundError, match="none.vndf"):
        vndf.load(tmp_path / "none.vndf")
    with pytest.raises(OSError):
        vndf.load(tmp_path)
    damaged = bytearray(table.tobytes())
    damaged[1000] ^= 1
    (tmp_path / "damaged.vndf").write_bytes(damaged)
    with pytest.raises(ValueError, match="damaged.vndf"):
        vndf.load(tmp_path / "damaged.vndf")
    for wrong in (bytes(damaged), b"", b"neither"):
        with pytest.raises(ValueError):
            vndf.load(wrong)
    with pytest.raises(TypeError):
        vndf.load(3)


def test_what_cannot_be_saved_is_told(table, baked, pair, tmp_path):
    with pytest.raises(ValueError, match="ends in"):
        table.save(tmp_path / "t.txt")
    with pytest.raises(ValueError, match="no pair"):
        baked.save(tmp_path / "t.h5")
    with pytest.raises(ValueError, match="bake"):
        pair.save(tmp_path / "t.vndf")
    for name in ("t.vndf", "t.h5"):
        with pytest.raises(OSError):
            table.save(tmp_path / "nowhere" / name)
    with pytest.raises(ValueError, match="pair"):
        baked.bake()
    with pytest.raises(ValueError, match="bake"):
        pair.tobytes()


def test_tables_are_pickled_and_copied(table, baked, pair, random):
    u = random.random((50, 2), dtype=np.float32)
    for t in (table, baked, pair):
        for again in (pickle.loads(pickle.dumps(t)), copy.deepcopy(t)):
            assert (again.has_pair, again.has_baked) == (t.has_pair, t.has_baked)
            assert repr(again) == repr(t)
            assert again.certificate == t.certificate
            for dtype in (np.float32, np.float64):
                assert np.array_equal(
                    again.sample(WI, 0.3, u.astype(dtype)), t.sample(WI, 0.3, u.astype(dtype))
                )


def test_what_is_known_of_a_table(table, pair):
    assert table.specification == "ggx" and table.distribution == "ggx"
    assert table.certificate["marginal_max_u_error"] < 2e-5
    assert "Certificate" in str(table) and "baked within" in str(table)
    assert "marginal table          64 x 64" in str(pair) or "marginal table" in str(pair)
    assert pair.certificate["max_pdf_error"] < 1e-3


def test_many_loads_leave_no_memory(table):
    block = table.tobytes()

    def load_many(count):
        for _ in range(count):
            loaded = vndf.load(block)
            loaded.sample(WI, 0.3, (0.5, 0.5))
            vndf.Surface(0.3, 0.1)
        return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss

    before = load_many(500)
    after = load_many(10_000)
    # A leak of the block alone would be 1 GB; one of 100 bytes a load would be 1 MB.
    assert after - before < 1000


def test_threads_sample_at_once(table, random):
    n, count = 20_000, 8
    wi, u = directions(random, n).astype(np.float32), random.random((n, 2), dtype=np.float32)
    expected = table.sample(wi, 0.3, u)
    right = []

    def work():
        for _ in range(5):
            right.append(np.array_equal(table.sample(wi, 0.3, u, threads=2), expected))

    threads = [threading.Thread(target=work) for _ in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert right == [True] * (5 * count)


def test_samples_are_those_of_the_distribution(table, random):
    u = random.random((100_000, 2), dtype=np.float32)
    wm = table.sample(WI, 0.5, u)
    # D dot(wi, wm) integrates to the visible area of wi, and pdf is D dot(wi, wm) over it.
    area = 0.8 / table.g1(WI, 0.5)
    estimate = np.mean(table.d(wm, 0.5) * (wm @ np.float32(WI)) / table.pdf(WI, wm, 0.5))
    assert estimate == pytest.approx(area, rel=1e-4)
    drawn = table.sample_with_density(WI, 0.5, u)
    ratio = drawn.density / table.pdf(WI, drawn.wm, 0.5)
    assert np.median(np.abs(ratio - 1)) < 1e-3
    assert np.allclose(table.invert(WI, wm[:1000], 0.5), u[:1000], atol=2e-5)
