"""Cases and shaders on cards, comparisons, pictures."""

import subprocess
import sys

import numpy as np
import pytest

import crossbar_gi as cg

HIGHLIGHT = "docs/examples/highlight.toml"

SQUARE_OF_T0 = """ps_1_4
texcrd r0.rgb, t0
mul r0.rgb, r0, r0
+mov r0.a, c0
"""


def test_a_case_file():
    run = cg.run(HIGHLIGHT)
    (target,) = run.targets
    assert target.shape == (32, 256, 4) and run.depth is None
    assert run.document["device"] == "r200" and run.document["format"] == "s3.12:rdn"
    assert run.counts["fragments_shaded"] == 32 * 256 and run.counts["triangles_assembled"] == 2
    assert run.modelled["pipeline_us"] > 0 and run.modelled["rates_us"] > 0
    # Eight bits per channel, brightest at the right.
    np.testing.assert_array_equal(target * 255, np.round(target * 255))
    assert (np.diff(target[0, :, 0]) >= 0).all() and target[0, -1, 0] > 0.5 and target[0, 0, 0] == 0
    np.testing.assert_array_equal(cg.run(HIGHLIGHT, executor="scalar").targets[0], target)


def test_a_shader_is_what_the_formats_say():
    run = cg.run(SQUARE_OF_T0, format="s3.12:rdn", inputs={"c0": [0, 0, 0, 1]}, size=(64, 1), target="rgba32f")
    # The pixel centers of Direct3D are at whole numbers.
    coordinate = np.arange(64) / 64
    squares = cg.mul(coordinate, coordinate, "s3.12:rdn")
    np.testing.assert_array_equal(run.targets[0][0, :, 0], squares)
    rows = run.trace(7, 0)
    assert [row["name"] for row in rows if row["instruction"] == 1] == ["r0.x", "r0.y", "r0.z"]
    assert next(row["value"] for row in rows if row["instruction"] == 1) == squares[7]
    assert all(row["text"].startswith(("texcrd", "mul", "+mov")) for row in rows)


def test_devices_formats_and_switches_change_the_bits():
    half = cg.run(HIGHLIGHT, format="fp32").targets[0]
    assert (cg.run(HIGHLIGHT).targets[0] != half).any()
    assert cg.run(HIGHLIGHT, device="r300").document["device"] == "r300"


def test_textures_as_arrays():
    text = "ps_1_4\ntexld r0, t0\n"
    texels = np.random.default_rng(1).random((8, 8, 4)).astype(np.float32)
    run = cg.run(text, format="s3.12:rdn", inputs={"t0": texels}, size=(8, 8), target="rgba32f")
    np.testing.assert_array_equal(run.targets[0], cg.round(texels, "s3.12:rdn"))


def test_a_case_as_a_dictionary_and_as_text():
    case = {
        "title": 'a "quoted" title',
        "shader_model": "ps_1_4",
        "format": "s3.12",
        "pixel": {"source": SQUARE_OF_T0},
        "constants": {"c0": np.array([0, 0, 0, 1.0])},
        "geometry": {"full_screen": True},
        "target": {"size": [4, 4], "format": "bgra8"},
        "probe": [{"pixel": [0, 0], "expected": [0.0], "tolerance": 0.1}],
    }
    run = cg.run(case)
    assert run.document["title"] == 'a "quoted" title' and run.probes[0]["passed"]
    text = open(HIGHLIGHT).read()
    np.testing.assert_array_equal(cg.run(text).targets[0], cg.run(HIGHLIGHT).targets[0])


def test_compare_names_the_first_difference():
    same = cg.compare(HIGHLIGHT)
    assert same["equal"] and same["left"]["executor"] == "scalar" and same["right"]["executor"] == "batch"
    parted = cg.compare(HIGHLIGHT, right={"format": "fp32"})
    assert not parted["equal"] and parted["different"] > 0
    difference = parted["first"]["difference"]
    assert difference["stage"] in ("input", "instruction") and difference["text"]
    with pytest.raises(ValueError, match="expected device, format, switches and executor on the left side, found card"):
        cg.compare(HIGHLIGHT, left={"card": "r200"})


def test_pictures():
    a = np.random.default_rng(2).random((32, 48, 3))
    equal = cg.diff(a, a)
    assert equal.ssim == 1 and equal.flip == 0 and equal.rmse == 0 and equal.flip_map.shape == (32, 48)
    b = a.copy()
    b[4:9, 10:20] = 0
    d = cg.diff(a, b)
    assert 0 < d.flip < d.flip_maximum <= 1 and d.ssim < 1 and d.maximum == pytest.approx(a[4:9, 10:20].max())
    assert d.flip_map[6, 15] > d.flip_map[30, 40]
    bytes_ = (a * 255).astype(np.uint8)
    assert cg.diff(bytes_, bytes_).flip == 0
    assert cg.diff(a[:8, :8], b[:8, :8]).ssim is None


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: cg.run("no/such.toml"), r"`no/such.toml` cannot be read"),
        (lambda: cg.run("ps_1_4\nmull r0, r0, r0\n"), "expected an instruction, found `mull`"),
        (lambda: cg.run(HIGHLIGHT, device="r20"), "r20"),
        (lambda: cg.run(HIGHLIGHT, format="s3"), "number format `s3`: expected a layout"),
        (lambda: cg.run(HIGHLIGHT, executor="fast"), 'expected the executor "scalar" or "batch", found "fast"'),
        (lambda: cg.run(HIGHLIGHT, inputs={"x": [1]}), r"expected inputs named c0, c1, ... \(constants\)"),
        (lambda: cg.run(HIGHLIGHT, inputs={"c0": [1, 2]}), r"expected 4 numbers for c0, found shape \(2,\)"),
        (lambda: cg.run(HIGHLIGHT, inputs={"c8": [1, 0, 0, 0]}), "expected one of the 8 constants of r200, found c8"),
        (
            lambda: cg.run(HIGHLIGHT, inputs={"t0": np.ones((2, 2, 4))}),
            "expected a texture that the case binds, found t0",
        ),
        (lambda: cg.run(HIGHLIGHT).trace(256, 0), "expected a pixel within 256x32, found column 256, row 0"),
        (lambda: cg.diff(np.ones((2, 2)), np.ones((2, 2))), r"expected a picture of shape \(height, width, 3\) as a"),
        (lambda: cg.diff(np.ones((2, 2, 3)), np.ones((2, 3, 3))), "expected two pictures of the same size"),
        (
            lambda: cg.diff(np.full((2, 2, 3), np.nan), np.ones((2, 2, 3))),
            r"expected numbers, found NaN in a\[0, 0, 0\]",
        ),
    ],
)
def test_errors_say_what_was_expected(call, message):
    with pytest.raises(ValueError, match=message):
        call()


def test_studies_are_records():
    entries = cg.entries()
    assert {"id", "title"} == set(entries[0]) and "ray-engine-equation-11" in [entry["id"] for entry in entries]
    rows = cg.reproduce("ray-engine-equation-11")
    assert rows and all(row["verdict"] for row in rows)
    with pytest.raises(ValueError, match="ray-engine-equation-12"):
        cg.reproduce("ray-engine-equation-12")
    curve = cg.precision("docs/examples/lerp.toml", families=["fixed"], budget=200)
    assert curve and all(isinstance(row, dict) for row in curve)
    with pytest.raises(ValueError, match="expected one of the tables"):
        cg.precision("docs/examples/lerp.toml", families=["fixed"], budget=50, table="none")
    with pytest.raises(ValueError, match="sparkle"):
        cg.precision("cpca", switches={"sparkle": "on"})
    with pytest.raises(ValueError, match="expected a goal as `largest_codes<=1`"):
        cg.precision("docs/examples/lerp.toml", goal="small")


@pytest.mark.parametrize("work", [
    'cg.reproduce("ray-engine-tables-1-2")',
    'cg.run("ps_1_4\\nmov r0, c0", size=(2048, 2048), executor="scalar", target="bgra8")',
])
def test_ctrl_c_ends_studies_and_draws(work):
    # A separate process: when it ends, the work in the background ends too.
    script = f"""
import os, signal, threading, time
import crossbar_gi as cg
# A shell may have started its background processes with the signal ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)
threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
start = time.perf_counter()
try:
    {work}
except KeyboardInterrupt:
    print(time.perf_counter() - start, flush=True)
    os._exit(0)
"""
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=100)
    assert run.returncode == 0 and 0.3 <= float(run.stdout) < 3, run
