import signal
import threading

import numpy as np
import pytest
from nodes import in_cap, random_nodes
from pstripack import CoincidentNodesError, Delaunay, TriangulationError, scvt


def finer_at_the_pole(xyz):
    return 1 + 50 * np.exp(4 * (xyz[:, 2] - 1))


def test_cells_are_even_without_a_density():
    mesh = scvt(400, tolerance=1e-4)
    assert mesh.reason == "converged" and mesh.gradient <= 1e-4
    areas = Delaunay(mesh.points).cell_areas
    assert areas.max() / areas.min() < 1.6 and np.allclose(np.linalg.norm(mesh.points, axis=1), 1)


def test_cells_follow_the_density():
    shapes = []

    def density(xyz):
        shapes.append(xyz.shape)
        return finer_at_the_pole(xyz)

    mesh = scvt(400, density, tolerance=1e-3)
    areas = Delaunay(mesh.points).cell_areas
    product = areas**2 * finer_at_the_pole(mesh.points)  # area ~ density**(-1/2)
    assert product.max() / product.min() < 4 and areas.max() / areas.min() > 3
    assert all(len(shape) == 2 and shape[1] == 3 for shape in shapes)


def test_any_number_of_threads_gives_the_same_bytes():
    runs = [scvt(300, finer_at_the_pole, tolerance=1e-2, threads=threads) for threads in (1, 3)]
    assert np.array_equal(runs[0].points, runs[1].points) and runs[0].energy == runs[1].energy


def test_a_run_goes_on_from_generators_that_are_given():
    start = random_nodes(100)
    energies = [scvt(start, method="lloyd", max_evaluations=steps).energy for steps in (1, 5, 20)]
    assert energies == sorted(energies, reverse=True) and len(set(energies)) == 3
    assert np.array_equal(start, random_nodes(100))
    mesh = scvt(scvt(start, tolerance=1e-6).points, tolerance=1e-4)
    assert mesh.evaluations <= 2


def test_progress_is_told_and_may_stop_the_run():
    seen = []

    def progress(at):
        seen.append(at)
        return len(seen) == 3

    mesh = scvt(random_nodes(100), progress=progress)
    assert mesh.reason == "stopped" and len(seen) == 3
    assert seen[0].generators == 100 and seen[2].energy < seen[0].energy
    assert scvt(random_nodes(100), max_evaluations=2).reason == "evaluations"


class Broken(Exception):
    pass


def raising(*_):
    raise Broken


@pytest.mark.parametrize("options, kind", [
    ({"density": raising}, Broken), ({"progress": raising}, Broken),
    ({"density": lambda xyz: xyz}, ValueError), ({"density": lambda xyz: 1.0}, ValueError),
    ({"density": lambda xyz: "dense"}, ValueError), ({"density": lambda xyz: -np.ones(len(xyz))}, TriangulationError),
    ({"density": lambda xyz: np.full(len(xyz), np.nan)}, TriangulationError),
    ({"tolerance": 0}, ValueError), ({"tolerance": np.nan}, ValueError), ({"method": "gradient"}, ValueError),
    ({"seed": 0}, ValueError), ({"max_evaluations": 0}, ValueError), ({"threads": 0}, ValueError)])
def test_arguments_that_are_wrong(options, kind):
    with pytest.raises(kind):
        scvt(50, **options)


def test_widths_give_the_number_of_generators_and_the_density():
    def width(xyz):
        return 1400 - 500 * xyz[:, 2]

    mesh = scvt(width=width, tolerance=1e-2, well_centred=True)
    # The integral over z of 2 pi R^2 / (sqrt(3)/2 width^2).
    assert len(mesh.points) == round(2 * np.pi * 6371.22**2 / (np.sqrt(3) / 2) / 500 * (1 / 900 - 1 / 1900))
    same = scvt(344, lambda xyz: width(xyz) ** -4.0, tolerance=1e-2)
    assert mesh.reason == same.reason == "converged"
    assert mesh.points == pytest.approx(same.points, abs=0.05)
    assert len(scvt(width=lambda xyz: np.full(len(xyz), 2.0), radius=10, tolerance=1e-2).points) == 363
    assert len(scvt(20, width=width, tolerance=1e-2).points) == 20
    assert scvt(500, width=width, max_evaluations=1, well_centred=True).reason in ("evaluations", "not well centred")


def test_widths_that_are_wrong():
    for options in {}, {"density": np.ones, "width": np.ones}, {"width": np.ones, "radius": 0}:
        with pytest.raises(ValueError):
            scvt(**options)
    with pytest.raises(TriangulationError, match="the width is 0 at lon"):
        scvt(width=lambda xyz: np.zeros(len(xyz)))
    with pytest.raises(TriangulationError, match="the widths give 5.88e-05 cells, not 4"):
        scvt(width=lambda xyz: np.full(len(xyz), 1e6), radius=2012.24)
    with pytest.raises(Broken):
        scvt(width=raising)


def test_generators_that_are_wrong():
    for generators in 3, -1, 0, np.eye(3), np.zeros((5, 2)):
        with pytest.raises(ValueError):
            scvt(generators)
    with pytest.raises(TypeError):
        scvt(10.5)
    with pytest.raises(TriangulationError, match="hemisphere"):
        scvt(in_cap(50))
    with pytest.raises(CoincidentNodesError) as caught:
        scvt(np.vstack([random_nodes(20), random_nodes(20)[4:5]]))
    assert caught.value.nodes == (4, 20)


@pytest.mark.parametrize("value", [1e-310, 1e-200, 1e200, 1e308])
def test_densities_of_any_size(value):
    mesh = scvt(100, lambda xyz: np.full(len(xyz), value), tolerance=1e-3)
    assert mesh.reason == "converged" and mesh.gradient <= 1e-3
    assert mesh.energy / value == pytest.approx(0.2561, rel=1e-2)


def test_densities_beyond_what_doubles_hold():
    with pytest.raises(TriangulationError, match="the density is 1e-250 at lon .* the ratio is too large"):
        scvt(100, lambda xyz: np.where(xyz[:, 2] > -0.5, 1, 1e-250))
    with pytest.raises(TriangulationError, match="beyond the largest double"):
        scvt(4, lambda xyz: np.full(len(xyz), 1.7e308))


def test_generators_that_nearly_coincide():
    e = 6e-17
    mesh = scvt(np.vstack([random_nodes(30), [[e, 0, 1], [-e, 0, 1], [0, e, 1], [0, -e, 1]]]), tolerance=1e-2)
    assert mesh.reason == "converged" and mesh.gradient <= 1e-2


def test_the_keyboard_interrupts_a_run():
    timer = threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT))
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        timer.start()
        with pytest.raises(KeyboardInterrupt):
            scvt(random_nodes(20000), method="lloyd", tolerance=1e-300)  # would take many seconds
            pytest.fail("the run ended before the interrupt")
    finally:
        timer.join()
        signal.signal(signal.SIGINT, before)
