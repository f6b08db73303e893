"""Result folders as arrays, and the module beside the program on the same cases."""

import json

import numpy as np
import pytest
import thinwall


def test_a_result_folder_as_arrays(run_case):
    results = run_case("barrios-2019")
    summary = results.summary
    assert summary == json.loads((results.folder / "summary.json").read_text(encoding="utf-8"))
    assert "summary.json" in json.dumps(results.manifest)
    names = ("part", "robot", "coupled_receptance", "coupled_spatial")
    assert set(results.frf) == {*names, *(f"{name}_added" for name in names)}  # further lines at resonances
    assert {"part", "supported", "part_crossings"} <= set(results.lobes)
    hz = [mode["frequency_hz"] for mode in summary["part"]["modes"]]
    assert results.modes["modes"]["frequency_hz"] == pytest.approx(hz, rel=1e-12)
    for chart in summary["lobes"]:
        table = results.lobes[chart["name"]]
        assert table["limiting_depth_m"].min() == pytest.approx(chart["minimum_depth_m"], rel=1e-12)
        assert set(table["bifurcation"]) <= {"hopf", "flip", "fold", ""}
    assert repr(results).startswith("<Results of barrios-2019")


def test_receptances_of_a_run_are_reciprocal_passive_and_coupled_as_its_own_formula_says(run_case):
    results = run_case("barrios-2019")
    H = results.frf["part"]
    values = H.H
    assert values.shape == (len(H.frequency_hz), len(H.responses), len(H.forces))
    assert np.abs(values - values.transpose(0, 2, 1)).max() < 1e-9 * np.abs(values).max()
    assert np.all(H.entry("P.x", "P.x").imag < 0)
    # Barrios 2019, Eq. 14: G = H − H (H + H_R)⁻¹ H of the one direction that is joined.
    h, r = H.entry("P.x", "P.x"), results.frf["robot"].entry("R.x", "R.x")
    coupled = results.frf["coupled_receptance"].entry("P.x", "P.x")
    assert np.abs(coupled - (h - h * h / (h + r))).max() < 1e-9 * np.abs(h).max()


def test_shapes_of_a_run_lie_on_its_mesh(run_case):
    results = run_case("barrios-2019")
    shapes = results.shapes()
    assert [s.frequency_hz for s in shapes] == pytest.approx(
        list(results.modes["modes"]["frequency_hz"][: len(shapes)]), rel=1e-12
    )
    first = shapes[0]
    assert first.displacement.shape == first.points.shape
    # One scale for all. Mass-normalised, the largest entry of a plate that bends is about 2 / sqrt(mass).
    assert 1.0 < np.sqrt(results.summary["part"]["mass_kg"] / first.modal_mass_kg) < 3.0
    for shape in shapes + results.shapes("coupled"):
        assert np.abs(shape.displacement).max() == pytest.approx(1.0, rel=1e-9)
    assert np.isnan(results.shapes("coupled")[0].modal_mass_kg)
    # The part's centre is that of its box, in the middle between the nodes that lie farthest out.
    middle = 0.5 * (first.points.min(axis=0) + first.points.max(axis=0))
    assert middle == pytest.approx(results.summary["part"]["centre_m"], abs=1e-9)
    # The foot is held where the mode has nodes at rest, and there alone a displacement is exactly zero.
    assert np.any(np.all(first.displacement == 0, axis=1))
    coupled = [shape.frequency_hz for shape in results.shapes("coupled")]
    assert len(coupled) > 5
    assert coupled == pytest.approx(results.modes["coupled_modes"]["frequency_hz"][: len(coupled)], rel=1e-9)


def test_the_module_draws_the_chart_of_the_program(run_case):
    table = run_case("ding-2010").lobes["tool"]
    tool = thinwall.oscillators([(922.0, 0.011, 1340049.648, d) for d in "xy"], "tip")
    cut = thinwall.MillingProcess(teeth=2, diameter_m=0.01, K_t=600e6, K_r=200e6, radial_depth_m=0.001, direction="down")
    some = slice(None, None, 10)
    chart = thinwall.lobes(tool, cut, table["spindle_speed_rpm"][some], depth_limit_m=0.01)
    assert chart.limiting_depth_m == pytest.approx(table["limiting_depth_m"][some], rel=2e-4)  # twice the tolerance
    assert chart.kind == list(table["bifurcation"][some])


GARBAGE = [
    b"",
    b"no XML",
    b"\xff\xfe\x00",
    b"<VTKFile/>",
    b'<VTKFile compressor="x"><AppendedData encoding="raw"/></VTKFile>',
]
ARRAY = '<DataArray Name="{}" type="{}" offset="{}"/>'
VTU = '<VTKFile compressor="vtkZLibDataCompressor">{}<AppendedData encoding="base64">_{}</AppendedData></VTKFile>'


@pytest.mark.parametrize(
    "text",
    GARBAGE
    + [VTU.format(ARRAY.format(*words), data).encode() for words, data in [
        (("a", "Float64", 0), ""),
        (("a", "Float64", 0), "?"),
        (("a", "Float99", 0), "AQAAAAAAAAA="),
        (("a", "Float64", "x"), "AQAAAAAAAAA="),
        (("a", "Float64", 0), "AQAAAAAAAAAAgAAAAAAAAAgAAAAAAAAABAAAAAAAAAA=AAAAAA=="),
    ]],
)
def test_what_is_no_vtu_file_of_the_program_is_a_data_error(tmp_path, text):
    path = tmp_path / "a.vtu"
    path.write_bytes(text)
    with pytest.raises(thinwall.DataError, match="a.vtu"):
        thinwall.read_vtu(path)


@pytest.mark.parametrize(
    ("text", "said"), [(b"", "column names"), (b"a,b\n1\n", "row 1"), (b"a\n\xff\n", "utf-8"), (b'a\n"' + b"x" * 200000, "field")]
)
def test_what_is_no_table_is_a_data_error(tmp_path, text, said):
    path = tmp_path / "a.csv"
    path.write_bytes(text)
    with pytest.raises(thinwall.DataError, match=f"a.csv.*{said}"):
        thinwall.read_table(path)


READERS = {
    "read_vtu": thinwall.read_vtu,
    "read_table": thinwall.read_table,
    "read_results": thinwall.read_results,
    "read_response": thinwall.read_response,
    "read_frf": lambda path: thinwall.read_frf(path, "P.x", quantity="receptance", unit="m/N"),
    "read_mesh": lambda path: thinwall.read_mesh(path, "mm"),
}


@pytest.mark.parametrize("reader", READERS)
def test_what_is_not_there_and_what_is_no_such_thing_is_a_data_error(tmp_path, reader):
    file = tmp_path / "file.msh"
    file.write_bytes(b"\0\xff\2")
    for path in (tmp_path / "absent", tmp_path / "absent.msh", file, tmp_path):
        with pytest.raises(thinwall.DataError, match=path.name):
            READERS[reader](path)


@pytest.mark.parametrize("summary", ["[]", "{", "\udcff"])
def test_a_folder_with_a_broken_summary_is_a_data_error(tmp_path, summary):
    (tmp_path / "summary.json").write_text(summary, errors="surrogateescape", encoding="utf-8")
    with pytest.raises(thinwall.DataError, match="summary.json"):
        thinwall.read_results(tmp_path)


def test_columns_of_words_are_words_where_no_row_has_one(tmp_path):
    table = tmp_path / "a.csv"
    table.write_text("speed,bifurcation,depth,note,status\n1,,,,ok\n2,,,x,ok\n")
    read = thinwall.read_table(table)
    assert list(read["bifurcation"]) == ["", ""] and list(read["status"]) == ["ok", "ok"]
    assert np.all(np.isnan(read["depth"])) and list(read["note"]) == ["", "x"]
    table.write_text("speed,bifurcation\n")
    assert thinwall.read_table(table)["bifurcation"].dtype.kind == "U"


def test_receptances_are_one_array_that_stays():
    values = np.arange(12.0).reshape(3, 2, 2) * (1 + 2j)
    response = thinwall.Response([1.0, 2.0, 3.0], values, ["P.x", "P.y"])
    H = response.H
    assert np.array_equal(H, values) and H.flags.c_contiguous and not H.flags.writeable
    assert np.shares_memory(response.H, H)
    del response
    assert np.array_equal(H, values)
