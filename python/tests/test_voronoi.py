import copy
import pickle

import numpy as np
import pytest
import scipy.spatial
from nodes import in_cap, random_nodes
from pstripack import Delaunay, SphericalVoronoi, to_xyz

RANDOM, CAP = random_nodes(500), in_cap(200)
CASES = {
    "sphere": (RANDOM, {}),
    "cap": (CAP, {}),
    "radius_and_center": (RANDOM * 6371.0 + [1e3, -2e3, 5e2], {"radius": 6371.0, "center": [1e3, -2e3, 5e2]}),
    "cap_with_radius": (CAP * 0.25, {"radius": 0.25}),
    "four": (random_nodes(4, 3), {}),
    "threshold": (RANDOM * 1.0005, {"threshold": 1e-3}),
}


def canonical(cycle):
    """A form that does not depend on the direction or the start of the cycle."""
    start = cycle.index(min(cycle))
    forth = cycle[start:] + cycle[:start]
    return min(forth, forth[:1] + forth[:0:-1])


@pytest.mark.parametrize("case", CASES)
class TestAgainstScipy:
    def both(self, case):
        points, options = CASES[case]
        return SphericalVoronoi(points, **options), scipy.spatial.SphericalVoronoi(points, **options)

    def test_attributes(self, case):
        ours, theirs = self.both(case)
        assert isinstance(ours.radius, float) and ours.radius == theirs.radius
        assert np.array_equal(ours.points, theirs.points) and np.array_equal(ours.center, theirs.center)
        assert ours.vertices.shape == theirs.vertices.shape and ours.vertices.dtype == theirs.vertices.dtype
        assert isinstance(ours.regions, list) and all(isinstance(r, list) for r in ours.regions)
        assert all(isinstance(v, int) for r in ours.regions for v in r)

    def test_vertices_and_regions(self, case):
        ours, theirs = self.both(case)
        distance, number = scipy.spatial.cKDTree(theirs.vertices).query(ours.vertices)
        assert distance.max() < 2e-3 * ours.radius if case == "threshold" else distance.max() < 1e-9 * ours.radius
        assert len(set(number.tolist())) == len(number)
        ours.sort_vertices_of_regions()
        theirs.sort_vertices_of_regions()
        for one, other in zip(ours.regions, theirs.regions):
            assert canonical([int(number[v]) for v in one]) == canonical([int(v) for v in other])
        assert len(ours.regions) == len(theirs.regions)

    def test_areas(self, case):
        ours, theirs = self.both(case)
        assert ours.calculate_areas() == pytest.approx(theirs.calculate_areas(), rel=1e-2 if case == "threshold" else 1e-7)
        assert ours.calculate_areas().sum() == pytest.approx(4 * np.pi * ours.radius**2, rel=1e-12)


def test_regions_are_counterclockwise_from_the_beginning():
    diagram = SphericalVoronoi(RANDOM)
    for point, region in zip(RANDOM, diagram.regions):
        corners = diagram.vertices[region]
        assert np.all(np.cross(corners, np.roll(corners, -1, axis=0)) @ point > 0)


def test_regions_as_arrays_are_those_of_the_lists():
    diagram = SphericalVoronoi(RANDOM)
    indptr, indices = diagram.region_vertices
    assert [indices[a:b].tolist() for a, b in zip(indptr, indptr[1:])] == diagram.regions
    assert diagram.regions is diagram.regions


def test_where_many_regions_meet():
    """A longitude-latitude grid: each vertex belongs to four regions and occurs twice, as in scipy."""
    lon, lat = np.meshgrid(np.arange(0, 360, 30), np.arange(-75, 90, 30))
    points = to_xyz(lon.ravel(), lat.ravel())
    ours, theirs = SphericalVoronoi(points), scipy.spatial.SphericalVoronoi(points)
    assert ours.vertices.shape == theirs.vertices.shape
    assert ours.calculate_areas() == pytest.approx(theirs.calculate_areas(), rel=1e-9)


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda diagram: pickle.loads(pickle.dumps(diagram))])
def test_copies_and_pickles_are_the_same(again):
    points = 2 * random_nodes(100) + [1, 2, 3]
    diagram = SphericalVoronoi(points, radius=2, center=[1, 2, 3], threads=2)
    other = again(diagram)
    assert other is not diagram and other.regions == diagram.regions
    assert np.array_equal(other.vertices, diagram.vertices)
    assert np.array_equal(other.calculate_areas(), diagram.calculate_areas())
    mesh = Delaunay(points)
    mesh.simplices
    other_mesh = again(mesh)
    assert np.array_equal(other_mesh.simplices, mesh.simplices) and np.array_equal(other_mesh.points, points)
    assert np.array_equal(other_mesh.nearest(points), np.arange(100))


def test_the_points_are_a_copy():
    points = RANDOM.copy()
    diagram = SphericalVoronoi(points)
    points[:] = 0
    assert np.array_equal(diagram.points, RANDOM)
    assert diagram.calculate_areas().sum() == pytest.approx(4 * np.pi)


WRONG = {
    "duplicates": (np.vstack([RANDOM, RANDOM[7]]), {}, "Duplicate generators present: points 7 and 500", (7, 500)),
    "too_near": (np.vstack([RANDOM, RANDOM[7] + [5e-7, 0, 0]]), {}, "Duplicate generators present", (7, 500)),
    "within_a_threshold": (np.vstack([RANDOM[:50], -RANDOM[:50]]), {"threshold": 0.5}, "Duplicate generators present",
                           None),
    "radius": (RANDOM, {"radius": 2}, "Radius inconsistent with generators: point 0", (0,)),
    "center": (RANDOM, {"center": [1, 0, 0]}, "Radius inconsistent with generators", (0,)),
    "one_off": (np.vstack([RANDOM, [0, 0, 1.1]]), {}, "Radius inconsistent with generators: point 500", (500,)),
    "nan": (np.vstack([RANDOM, [0, 0, np.nan]]), {}, r"point 500 .* is \(0, 0, nan\): .* finite", (500,)),
    "infinite": (np.vstack([2 * RANDOM, [0, -np.inf, 2]]), {"radius": 2}, r"point 500 .* is \(0, -inf, 2\): .* finite", (500,)),
    "plane": (to_xyz(np.arange(0, 360, 10), np.full(36, 30)), {}, "Rank of input points must be at least 3", None),
    "great_circle": (to_xyz(np.arange(0, 360, 10), np.zeros(36)), {}, "Rank of input points must be at least 3", None),
    "three": (np.eye(3), {}, "Rank of input points must be at least 3", None),
    "none": (np.empty((0, 3)), {}, "Rank of input points must be at least 3", None),
    "radius_none": (RANDOM, {"radius": None}, "radius", None),
    "plane_points": (RANDOM[:, :2], {}, r"shape \(n, 3\)", None),
}


@pytest.mark.parametrize("case", WRONG)
def test_wrong_input_is_a_value_error_as_in_scipy(case):
    points, options, message, nodes = WRONG[case]
    with pytest.raises(ValueError, match=message) as caught:
        SphericalVoronoi(points, **options)
    if nodes is not None:
        assert caught.value.nodes == nodes
    if case not in ("none", "plane_points", "nan", "infinite"):
        with pytest.raises(ValueError):
            scipy.spatial.SphericalVoronoi(points, **options)


def test_points_in_almost_one_plane_are_judged_as_by_scipy():
    circle = to_xyz(np.arange(0, 360, 10), np.full(36, 30))
    for lift in 1e-4, 1e-5, 1e-6, 3e-7, 1e-7, 1e-8:
        points = circle + lift * np.random.default_rng(3).normal(size=circle.shape)
        points /= np.linalg.norm(points, axis=1)[:, np.newaxis]
        outcomes = []
        for diagram in SphericalVoronoi, scipy.spatial.SphericalVoronoi:
            try:
                diagram(points)
                outcomes.append("done")
            except ValueError as error:
                outcomes.append(str(error)[:20])
        assert outcomes[0] == outcomes[1], lift
