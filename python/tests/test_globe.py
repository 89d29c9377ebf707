import json
import re
from html import unescape

import numpy as np
import pytest

from pstripack import Delaunay
from pstripack._globe import MOST_NODES_IN_NOTEBOOKS


def data_of(page):
    return json.loads(re.search(r'(?s)<script type="application/json" id="data">(.*?)</script>', page)[1])


def test_the_page_has_the_numbers_of_the_mesh(tmp_path):
    lon, lat = np.array([0, 90.5, 180, 270, 0, 0, 12.25]), np.array([0, 0, 0, 0, 90, -90, 55.125])
    mesh = Delaunay.from_lonlat(lon, lat)
    values = np.array([1.5, np.nan, 3, 4, 5, 6, 7])
    globe = mesh.globe(values, tmp_path / "globe.html", title="Hütte", name="height", unit="m")
    assert (tmp_path / "globe.html").read_text(encoding="utf-8") == globe.html
    data = data_of(globe.html)
    assert (data["title"], data["name"], data["unit"], data["legend"], data["first"]) == ("Hütte", "height", "m", "height, m", 0)
    assert np.allclose((np.array(data["lon"]) - lon + 180) % 360, 180, atol=1e-9)
    assert np.allclose(data["lat"], lat, atol=1e-9)
    assert np.array_equal(np.array(data["numbers"], float), values, equal_nan=True)
    corners = np.array(data["triangles"]).reshape(-1, 3)
    corners[:, 0] = np.cumsum(corners[:, 0])
    corners[:, 1:] += corners[:, :1]
    assert np.array_equal(corners, mesh.simplices)
    assert data_of(mesh.globe().html)["legend"].startswith("area of a cell")


def test_cells_of_the_boundary_have_no_area():
    mesh = Delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]])
    assert data_of(mesh.globe().html)["counts"][-1] == 3


def test_notebooks_show_globes_of_meshes_that_are_not_too_large():
    mesh = Delaunay(np.random.default_rng(5).normal(size=(30, 3)))
    shown = mesh._repr_html_()
    assert unescape(re.fullmatch(r'<iframe srcdoc="([^"]*)".*></iframe>', shown)[1]) == mesh.globe().html
    many = Delaunay(np.random.default_rng(5).normal(size=(MOST_NODES_IN_NOTEBOOKS + 1, 3)))
    assert "more than 20000 nodes" in many._repr_html_() and repr(many)[1:-1] in many._repr_html_()


def test_wrong_arguments_are_refused(tmp_path):
    mesh = Delaunay([[1, 0, 0], [0, 1, 0], [0, 0, 1]])
    with pytest.raises(ValueError, match="one for each of 3 nodes"):
        mesh.globe([1, 2])
    with pytest.raises(RuntimeError, match="no.shp: cannot be opened"):
        mesh.globe(coasts=tmp_path / "no.shp")
