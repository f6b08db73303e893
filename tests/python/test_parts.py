"""Meshes, full models and their reductions: closed forms, invariants, SciPy as an independent algorithm."""

import numpy as np
import pytest
import scipy.sparse.linalg
import thinwall

LENGTH, WIDTH, THICKNESS = 0.2, 0.01, 0.002
E, RHO = 210e9, 7850.0
# ν = 0: a strip of any width bends as a beam, at its clamped end too.
BEAM = thinwall.Material(youngs_modulus_Pa=E, poisson_ratio=0.0, density_kg_m3=RHO)
TIP = thinwall.Point("P", (LENGTH, WIDTH / 2, THICKNESS / 2), "z", region="x_max")


def bending_hz(wave_number):
    """Euler and Bernoulli's beam; shear and rotary inertia lower the lowest modes by less than (thickness / length)²."""
    return wave_number**2 / (2 * np.pi) * np.sqrt(E * THICKNESS**2 / (12 * RHO * LENGTH**4))


@pytest.fixture(scope="module", name="strip")
def clamped_strip():
    mesh = thinwall.box_mesh((LENGTH, WIDTH, THICKNESS), 0.02)
    return thinwall.assemble(mesh, BEAM, fixed=["x_min"])


@pytest.fixture(scope="module", name="free")
def free_block():
    mesh = thinwall.box_mesh((0.05, 0.03, 0.004), 0.02, layers=0)
    return thinwall.assemble(mesh, thinwall.Material(70e9, 0.33, 2700.0), order=2)


def test_meshes_hold_the_volume_of_their_parts():
    box = thinwall.box_mesh((0.002, 0.1, 0.05), 0.02)
    assert box.volume_m3 == pytest.approx(0.002 * 0.1 * 0.05, rel=1e-12)
    corners = box.vertices[box.tets]
    sixfold = np.linalg.det(corners[:, 1:] - corners[:, :1])
    assert np.all(sixfold > 0)
    assert sixfold.sum() / 6 == pytest.approx(box.volume_m3, rel=1e-12)
    square = [(0, 0), (0.1, 0), (0.1, 0.1), (0, 0.1)]
    hole = [(0.04, 0.04), (0.06, 0.04), (0.06, 0.06), (0.04, 0.06)]
    pocket = [(0.01, 0.01), (0.03, 0.01), (0.03, 0.09), (0.01, 0.09)]
    plate = thinwall.prism_mesh(square, 0.004, 0.03, holes=[hole], zones=[(pocket, 0.0, 0.001)])
    assert plate.volume_m3 == pytest.approx((0.01 - 4e-4 - 1.6e-3) * 0.004 + 1.6e-3 * 0.001, rel=1e-12)


def test_a_mesh_of_a_file_keeps_its_unit(tmp_path):
    deck = tmp_path / "tet.inp"
    deck.write_text("*NODE\n1, 0, 0, 0\n2, 60, 0, 0\n3, 0, 50, 0\n4, 0, 0, 40\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n")
    mesh = thinwall.read_mesh(deck, "mm")
    assert mesh.volume_m3 == pytest.approx(0.06 * 0.05 * 0.04 / 6, rel=1e-12)
    assert mesh.order == 1


def test_a_mesh_of_order_two_keeps_its_nodes(tmp_path):
    corners = np.array([(0, 0, 0), (60, 0, 0), (0, 50, 0), (0, 0, 40)], float)
    middles = [(corners[a] + corners[b]) / 2 for a, b in ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))]
    nodes = "".join(f"{i}, {x}, {y}, {z}\n" for i, (x, y, z) in enumerate([*corners, *middles], start=1))
    deck = tmp_path / "tet10.inp"
    deck.write_text(f"*NODE\n{nodes}*ELEMENT, TYPE=C3D10\n1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10\n")
    mesh = thinwall.read_mesh(deck, "mm")
    assert mesh.order == 2
    model = thinwall.assemble(mesh, BEAM)
    assert model.positions.shape == (10, 3) and model.K.shape == (30, 30)
    assert model.mass_kg == pytest.approx(RHO * 0.06 * 0.05 * 0.04 / 6, rel=1e-9)
    with pytest.raises(thinwall.InputError, match="order is 2"):
        thinwall.assemble(mesh, BEAM, order=4)


def test_a_strip_bends_as_a_beam(strip):
    modes = thinwall.modes(strip, count=8, verify=True)
    assert strip.mass_kg == pytest.approx(RHO * LENGTH * WIDTH * THICKNESS, rel=1e-9)
    for wave_number in (1.8751040687, 4.6940911330):
        nearest = modes.frequency_hz[np.argmin(abs(modes.frequency_hz - bending_hz(wave_number)))]
        assert nearest == pytest.approx(bending_hz(wave_number), rel=2e-3)
    assert np.all(modes.residual < 1e-5)


def test_shapes_are_orthonormal_in_mass_and_held_where_the_part_is(strip):
    modes = thinwall.modes(strip, count=4)
    assert np.allclose(modes.shapes.T @ (strip.M @ modes.shapes), np.eye(4), atol=1e-9)
    u = strip.displacements(modes.shapes[:, 0])
    foot = strip.positions[:, 0] < 1e-12
    assert foot.any() and np.all(u[foot] == 0)
    assert np.argmax(abs(u[:, 2])) == np.argmax(abs(u).max(axis=1))  # the lowest mode bends through the thickness


def test_scipy_finds_the_same_modes_from_the_same_matrices(free):
    lowest = thinwall.modes(free, count=4)
    assert free.rigid_motions == 6 and np.all(lowest.frequency_hz[:6] == 0)
    shift = -(2 * np.pi * 100.0) ** 2
    values = scipy.sparse.linalg.eigsh(free.K, k=10, M=free.M, sigma=shift, which="LM", return_eigenvectors=False)
    hz = np.sqrt(np.sort(values)[6:]) / (2 * np.pi)
    assert hz == pytest.approx(lowest.frequency_hz[6:], rel=1e-7)


def test_a_free_part_translates_without_force_and_with_its_mass(free):
    along = np.zeros(free.K.shape[0])
    along[free.free_rows % 3 == 1] = 1.0
    assert np.linalg.norm(free.K @ along) < 1e-9 * abs(free.K).max()
    assert along @ (free.M @ along) == pytest.approx(free.mass_kg, rel=1e-9)


def test_arrays_are_views_that_outlive_their_names():
    mesh = thinwall.box_mesh((0.05, 0.03, 0.004), 0.03, layers=0)
    model = thinwall.assemble(mesh, BEAM, ["x_min"], order=1)
    K = model.K
    assert np.shares_memory(K.data, model.K.data) and np.shares_memory(K.indices, model.K.indices)
    assert np.shares_memory(mesh.vertices, mesh.vertices)
    shapes = thinwall.modes(model, count=2).shapes
    with pytest.raises(ValueError):
        K.data[0] = 1.0
    with pytest.raises(ValueError):
        shapes[0, 0] = 1.0
    before = K.data.copy(), shapes.copy()
    del model, mesh
    assert np.array_equal(before[0], K.data) and np.array_equal(before[1], shapes)


def test_craig_bampton_is_the_projection_that_it_says(strip):
    reduced = thinwall.craig_bampton(strip, [TIP], modes=10)
    T, model = reduced.T, reduced.model
    assert model.dofs == ["P.z"] + [f"mode {i + 1}" for i in range(10)]
    assert np.allclose(T.T @ (strip.K @ T), model.K, rtol=1e-9, atol=1e-9 * abs(model.K).max())
    assert np.allclose(T.T @ (strip.M @ T), model.M, rtol=1e-9, atol=1e-9 * abs(model.M).max())
    # The tip's static stiffness is a cantilever's, 3 E I / L³.
    stiffness = 3 * E * WIDTH * THICKNESS**3 / 12 / LENGTH**3
    assert model.K[0, 0] == pytest.approx(stiffness, rel=2e-3)


@pytest.mark.parametrize("method", ["craig_bampton", "rubin", "macneal", "craig_chang", "dual_craig_bampton"])
def test_every_reduction_keeps_the_receptance_of_the_tip(strip, method):
    reduced = thinwall.reduce(strip, [TIP], method, modes=12)
    between = np.array([20.0, 150.0])
    H = thinwall.receptances(reduced, between).entry("P.z", "P.z").real
    # Force on the tip of Euler and Bernoulli's beam: L³/(E I λ³) (sin cosh − cos sinh)/(1 + cos cosh).
    lam = np.sqrt(between / bending_hz(1.0))
    s, c, sh, ch = np.sin(lam), np.cos(lam), np.sinh(lam), np.cosh(lam)
    EI = E * WIDTH * THICKNESS**3 / 12
    assert H == pytest.approx(LENGTH**3 / (EI * lam**3) * (s * ch - c * sh) / (1 + c * ch), rel=5e-3)


@pytest.mark.parametrize("method", ["craig_bampton", "rubin"])
def test_a_free_part_is_reduced_by_points_that_hold_it(free, method):
    points = [thinwall.Point(name, at) for name, at in (("A", (0, 0, 0)), ("B", (0.05, 0, 0)), ("C", (0, 0.03, 0)))]
    if method == "craig_bampton":
        model = thinwall.craig_bampton(free, points, modes=20).model
    else:
        model = thinwall.reduce(free, points, method, modes=20)
    hz = np.sqrt(np.abs(np.sort(np.linalg.eigvals(np.linalg.solve(model.M, model.K)).real))) / (2 * np.pi)
    full = thinwall.modes(free, count=2).frequency_hz[6:]
    assert np.all(hz[:6] < 1e-3 * full[0])
    assert hz[6:8] == pytest.approx(full, rel=1e-3)


def test_damping_is_that_which_was_asked_for(strip):
    reduced = thinwall.craig_bampton(strip, [TIP], modes=8).model
    damped = thinwall.with_modal_damping(reduced, 0.02, ratios=[0.005])
    modal = thinwall.to_modal(damped)
    assert modal.damping_ratio[0] == pytest.approx(0.005, rel=1e-9)
    assert modal.damping_ratio[1:] == pytest.approx(0.02, rel=1e-9)
    rayleigh = thinwall.with_rayleigh_damping(reduced, 2.0, 1e-6)
    assert np.allclose(rayleigh.C, 2.0 * reduced.M + 1e-6 * reduced.K)
    assert np.allclose(thinwall.with_structural_damping(reduced, 0.01).D, 0.01 * reduced.K)


def test_a_region_is_held_along_some_axes_only():
    mesh = thinwall.box_mesh((0.05, 0.03, 0.004), 0.03, layers=0)
    all_free = thinwall.assemble(mesh, BEAM, order=1)
    held = thinwall.assemble(mesh, BEAM, [(thinwall.Block((-1e-6, -1, -1), (1e-6, 1, 1)), "xz")], order=1)
    lost = set(all_free.free_rows) - set(held.free_rows)
    on_foot = {3 * n + axis for n in np.flatnonzero(mesh.vertices[:, 0] < 1e-9) for axis in (0, 2)}
    assert lost == on_foot
