#!/usr/bin/env python3
"""bench/parts: surfaces and their variants keep what they must, and outcomes are told apart. Takes neither Gmsh nor the
program; exit code 77 where numpy is missing."""

import contextlib
import io
import pathlib
import re
import struct
import sys
import tempfile
import types
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench"))

try:
    import numpy as np
except ImportError:
    print("numpy is not installed")
    sys.exit(77)

from parts import equal_error, outcomes, page, reference, surfaces, sweep  # noqa: E402

CORNERS = np.array([[x, y, z] for z in (0.0, 3.0) for y in (0.0, 20.0) for x in (0.0, 40.0)])
SIDES = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
BOX = CORNERS, np.concatenate([SIDES[:, [0, 1, 2]], SIDES[:, [0, 2, 3]]])
VOLUME = 40.0 * 20.0 * 3.0


def grid_box(n):
    """The box with its sides divided n × n times, so that plane edges are there to flip."""
    points, triangles = [], []
    for side in SIDES:
        a, b, _, d = CORNERS[side]
        first = len(points)
        points += [a + i / n * (b - a) + j / n * (d - a) for j in range(n + 1) for i in range(n + 1)]
        for j in range(n):
            for i in range(n):
                p = first + j * (n + 1) + i
                triangles += [(p, p + 1, p + n + 2), (p, p + n + 2, p + n + 1)]
    unique, index = np.unique(np.round(points, 9), axis=0, return_inverse=True)
    return unique, index.reshape(-1)[np.array(triangles)]


class Surfaces(unittest.TestCase):
    def test_a_box_encloses_its_volume_wherever_it_lies(self):
        points, triangles = BOX
        self.assertTrue(surfaces.is_closed(triangles))
        self.assertAlmostEqual(surfaces.volume(points + 1e3, triangles), VOLUME, delta=1e-9 * VOLUME)

    def test_a_missing_or_turned_triangle_is_seen(self):
        _, triangles = BOX
        self.assertFalse(surfaces.is_closed(triangles[1:]))
        self.assertFalse(surfaces.is_closed(np.concatenate([triangles[:1, ::-1], triangles[1:]])))

    def test_triangles_turned_at_random_are_turned_outwards_again(self):
        points, triangles = grid_box(3)
        draw = np.random.default_rng(1)
        mixed = np.array([row[::-1] if draw.random() < 0.5 else row for row in triangles])
        again = surfaces.outward(points, mixed)
        self.assertTrue(surfaces.is_closed(again))
        self.assertAlmostEqual(surfaces.volume(points, again), VOLUME, delta=1e-9 * VOLUME)

    def test_shuffling_keeps_the_set_of_triangles(self):
        points, triangles = grid_box(2)
        mixed = surfaces.shuffled(points, triangles, 7)

        def corners(surface):
            return sorted(sorted(map(tuple, surface[0][row])) for row in surface[1])

        self.assertEqual(corners(mixed), corners((points, triangles)))
        self.assertTrue(surfaces.is_closed(mixed[1]))
        self.assertFalse(np.array_equal(mixed[1], triangles))

    def test_bad_triangles_are_worse_and_enclose_the_same(self):
        points, triangles = grid_box(5)
        bad = surfaces.badly_triangulated(points, triangles, 3)
        self.assertTrue(surfaces.is_closed(bad[1]))
        self.assertAlmostEqual(surfaces.volume(*bad), VOLUME, delta=1e-9 * VOLUME)
        self.assertGreater(len(bad[1]), len(triangles))
        self.assertLess(surfaces.smallest_angles(*bad).min(), 0.2 * surfaces.smallest_angles(points, triangles).min())
        self.assertGreaterEqual(surfaces.smallest_angles(*bad).min(), 0.05)
        area = [np.linalg.norm(np.cross(p[t[:, 1]] - p[t[:, 0]], p[t[:, 2]] - p[t[:, 0]]), axis=1).sum()
                for p, t in (bad, (points, triangles))]
        self.assertAlmostEqual(area[0], area[1], delta=1e-9 * area[1])  # nothing is folded over

    def test_the_angles_of_known_triangles(self):
        points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 3**0.5, 0]])
        found = surfaces.smallest_angles(points, np.array([[0, 1, 2], [0, 1, 3]]))
        self.assertTrue(np.allclose(found, [45.0, 30.0]))

    def test_files_hold_the_surface(self):
        points, triangles = BOX
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for kind in surfaces.WRITERS:
                surfaces.write(folder / f"box.coarse.{kind}", points / 3.0, triangles)
            binary = (folder / "box.coarse.stl").read_bytes()
            self.assertEqual(len(binary), 84 + 50 * len(triangles))
            self.assertEqual(struct.unpack("<3f", binary[96:108]), tuple(np.float32(points[triangles[0, 0]] / 3.0)))
            off = (folder / "box.coarse.off").read_text().split("\n")
            self.assertEqual(off[1], "8 12 0")
            self.assertEqual([float(word) for word in off[9].split()], list(points[-1] / 3.0))  # to the last bit
            obj = (folder / "box.coarse.obj").read_text()
            self.assertEqual(min(int(w) for line in obj.split("\n") if line[:1] == "f" for w in line.split()[1:]), 1)
            vertices = re.findall(r"vertex (.*)", (folder / "box.coarse.ascii.stl").read_text())
            self.assertEqual(len(vertices), 3 * len(triangles))
            ply = (folder / "box.coarse.ply").read_bytes()
            body = ply[ply.index(b"end_header\n") + 11:]
            self.assertEqual(len(body), 24 * len(points) + 13 * len(triangles))


class Outcomes(unittest.TestCase):
    MET = {"mesh": {"error_estimate": {"met": True}}}
    NOT = {"mesh": {"error_estimate": {"met": False}}}

    def test_each_end_of_a_run_has_its_name(self):
        cases = [((0, False, "", self.MET), outcomes.MET), ((0, False, "", self.NOT), outcomes.ESTIMATED),
                 ((3, False, "error: open edges", None), outcomes.REFUSED),
                 ((5, False, "error: no mesher could fill the surface", None), outcomes.REFUSED),
                 ((5, False, "", None), outcomes.INTERNAL),
                 ((1, False, "internal error: assertion", None), outcomes.INTERNAL),
                 ((5, False, "internal error: assertion", None), outcomes.INTERNAL),
                 ((0, False, "", None), outcomes.INTERNAL), ((-11, False, "", None), outcomes.CRASH),
                 ((-9, True, "", None), outcomes.OUT_OF_TIME), ((-24, False, "", None), outcomes.OUT_OF_TIME)]
        for arguments, name in cases:
            self.assertEqual(outcomes.outcome(*arguments), name, arguments)

    def test_rigid_motions_are_not_among_the_frequencies(self):
        modes = [{"frequency_hz": 0.0, "rigid_body": True}] * 6 + [{"frequency_hz": 80.0}, {"frequency_hz": 90.0}]
        found = outcomes.figures({"part": {"modes": modes}, "mesh": {"dofs": 9}})
        self.assertEqual((found["rigid_motions"], found["frequencies_hz"], found["dofs"]), (6, [80.0, 90.0], 9))

    def test_an_error_counts_beyond_the_references_own(self):
        row = {"frequencies_hz": [102.0, 200.0], "estimate": 0.01}
        outcomes.compare(row, {"frequencies_hz": [100.0, 199.0], "error": 0.005})
        self.assertAlmostEqual(row["true_error"], 0.02)
        self.assertAlmostEqual(row["error_over_estimate"], 1.5)

    def test_the_summary_holds_rows_against_the_bars(self):
        row = {"outcome": outcomes.MET, "wall_s": 30.0, "first_answer_s": 3.0, "rigid_motions": 6}
        rows = [dict(row) for _ in range(19)] + [{"outcome": outcomes.CRASH, "wall_s": 1.0}]
        held = {words: holds for words, _, _, holds in outcomes.summary_of(rows)}
        self.assertTrue(held["parts with an answer"])
        self.assertFalse(held["crashes and internal errors"])
        self.assertFalse(any(holds for *_, holds in outcomes.summary_of(rows[17:])[:1]))  # two of three

    def test_the_first_answer_is_the_first_estimate_of_the_log(self):
        log = ["2026-11-26T23:59:58+00:00 debug stage: forecast",
               "2026-11-27T00:00:01+00:00 info level 0, order 3: 9414 degrees of freedom",
               "2026-11-27T00:00:03+00:00 info level 0, order 4: 20775 degrees of freedom, frequencies changed by 1.05e-01",
               "2026-11-27T00:00:09+00:00 info level 0, order 5: 38787 degrees of freedom, frequencies changed by 1e-02"]
        self.assertEqual(outcomes.seconds_to_first_answer(log), 5.0)
        self.assertIsNone(outcomes.seconds_to_first_answer(log[:2]))
        self.assertIsNone(outcomes.seconds_to_first_answer([]))
        self.assertEqual(outcomes.seconds_to_first_answer(["", *log]), 5.0)
        late = {"outcome": outcomes.MET, "wall_s": 11.0, "first_answer_s": None, "rigid_motions": 6}
        self.assertFalse({words: holds for words, _, _, holds in outcomes.summary_of([late])}["first answers within 10 s"])

    def test_the_limit_of_two_meshes(self):
        # f = 100 (1 + 0.1 h²) with h = 0.4 and 0.2, so eight times as many tetrahedra
        coarse, fine = ({"tets": n, "frequencies_hz": [100.0 * (1 + 0.1 * h * h)]}
                        for n, h in ((1000, 0.4), (8000, 0.2)))
        found = reference.extrapolated(coarse, fine)
        self.assertAlmostEqual(found["frequencies_hz"][0], 100.0)
        self.assertAlmostEqual(found["error"], 0.004)


class EqualError(unittest.TestCase):
    def test_seconds_are_a_power_of_the_error_between_two_meshes(self):
        power_law = [(3.0 * error**-1.5, error) for error in (0.1, 0.03, 0.004)]
        seconds, reached = equal_error.seconds_at(power_law, 0.01)
        self.assertTrue(reached)
        self.assertAlmostEqual(seconds, 3000.0, places=6)

    def test_the_first_mesh_that_is_exact_enough_counts_whole(self):
        self.assertEqual(equal_error.seconds_at([(2.0, 0.005), (9.0, 0.001)], 0.01), (2.0, True))

    def test_an_error_that_rises_again_does_not_count(self):
        seconds, _ = equal_error.seconds_at([(1.0, 0.02), (2.0, 0.04), (8.0, 0.01)], 0.01)
        self.assertAlmostEqual(seconds, 8.0)

    def test_without_a_mesh_that_is_exact_enough_the_last_one_is_a_lower_bound(self):
        self.assertEqual(equal_error.seconds_at([(1.0, 0.1), (5.0, 0.05)], 0.01), (5.0, False))

    def test_medians_of_thin_parts_and_of_all_are_held_against_their_bars(self):
        row = {"thinness": 0.01, "own_s": 1.0, "peers_s": 12.0}
        thick = {"thinness": 0.2, "own_s": 1.0, "peers_s": 1.5}
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertTrue(equal_error.show_median([row, thick, {"failure": "none"}], "thin"))
            self.assertTrue(equal_error.show_median([row, thick], "all"))
            self.assertFalse(equal_error.show_median([thick], "all"))


class Sweep(unittest.TestCase):
    def test_units_follow_names_and_formats(self):
        self.assertIsNone(sweep.unit_of(pathlib.Path("a.STEP"), "mm"))
        self.assertEqual(sweep.unit_of(pathlib.Path("a.inch.ascii.stl"), "mm"), "inch")
        self.assertEqual(sweep.unit_of(pathlib.Path("a.stl"), "m"), "m")

    def test_coarse_files_come_first_and_others_are_left_out(self):
        with tempfile.TemporaryDirectory() as name:
            for file in ("b.step", "a.fine.off", "c.coarse.stl", "volumes.json"):
                (pathlib.Path(name) / file).write_text("")
            found = sweep.files_in(pathlib.Path(name), re.compile(""))
            self.assertEqual([path.name for path in found], ["c.coarse.stl", "b.step", "a.fine.off"])
            self.assertEqual(len(sweep.files_in(pathlib.Path(name), re.compile("fine"))), 1)

    def test_the_message_is_the_programs_error(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "stderr.txt").write_text("stage: mesh\nerror: part.file: open edges\n  case.toml:2\n")
            done = types.SimpleNamespace(failure="exit 3: stage: mesh")
            self.assertEqual(sweep.last_message(done, folder), "error: part.file: open edges")

    def test_a_page_shows_every_row_and_escapes_texts(self):
        kept = {"time_s": 30.0, "processor_time_s": 60.0, "memory_gb": 6.0, "threads": 2, "tolerance": 0.01,
                "machine": {"processor": "any"}}
        rows = [{"file": "a.stl", "outcome": outcomes.MET, "wall_s": 1.0, "processor_s": 1.0, "rigid_motions": 6, "estimate": 0.004},
                {"file": "b<c>.stl", "outcome": outcomes.REFUSED, "wall_s": 1.0, "processor_s": 1.0, "message": "1 < 2"}]
        text = page.page(kept, rows)
        self.assertIn("b&lt;c&gt;.stl", text)
        self.assertIn("1 &lt; 2", text)
        self.assertIn("0.004", text)
        self.assertNotIn("http", text)  # nothing to load


if __name__ == "__main__":
    unittest.main()
