"""Values of NetCDF variables as netCDF4-python and xarray read them: type x packing x missing x order x group.
Where the two agree, pstripack must agree; where they differ, the rule must be one of RULES, which
docs/pstripack.md has. Usage: netcdf_values.py PSTRIPACK FOLDER"""
import csv
import itertools
import subprocess
import sys

import netCDF4
import numpy as np
import xarray

pstripack, folder = sys.argv[1:]
N = 7
TYPES = ["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"]
PACKINGS = [{}, {"scale_factor": 0.5}, {"add_offset": 10.0}, {"scale_factor": 0.25, "add_offset": -3.0}]
MISSING = ["nothing", "fill", "missing_value", "double missing_value", "vector", "fill and missing_value",
           "valid_min and valid_max", "valid_range", "library's fill", "_Unsigned"]
# Which of the two readers is followed where they differ.
RULES = {"valid_min and valid_max": "netCDF4", "valid_range": "netCDF4", "library's fill": "netCDF4"}


def raw_values(kind, missing):
    """Numbers of the type: 1 to 100, the largest, and some that an attribute calls missing."""
    values = np.array([1, 2, 3, 5, 90, 100, 4], dtype=kind)
    if missing == "_Unsigned":
        values[2] = -56
    if missing == "library's fill" and kind[1] != "1":
        values[3] = netCDF4.default_fillvals[kind]
    return values


def write(file, name, kind, packing, missing, order, values):
    dimensions = {"n": ("n",), "1n": ("one", "n"), "n1": ("n", "one")}[order]
    fill = values.dtype.type(5) if missing.startswith("fill") else None
    v = file.createVariable(name, kind, dimensions, fill_value=fill)
    v.set_auto_maskandscale(False)
    if "double" in missing:
        v.missing_value = np.float64(90)
    elif "missing_value" in missing:
        v.missing_value = values.dtype.type(90)
    elif missing == "vector":
        v.missing_value = np.array([2, 90], dtype=kind)
    elif missing == "valid_range":
        v.valid_range = np.array([2, 99], dtype=kind)
    elif missing.startswith("valid"):
        v.valid_min, v.valid_max = values.dtype.type(2), values.dtype.type(99)
    elif missing == "_Unsigned":
        v.setncattr("_Unsigned", "true")
    v.setncatts(packing)
    v[:] = values.reshape({"n": (N,), "1n": (1, N), "n1": (N, 1)}[order])


def by_netcdf4(name, group):
    with netCDF4.Dataset(name) as file:
        return {v: np.ma.filled(x[:].astype(float), np.nan).ravel()
                for v, x in (file[group] if group else file).variables.items()}


def by_xarray(name, group):
    with xarray.open_dataset(name, group=group or None, decode_times=False) as file:
        return {str(v): np.asarray(x.values, dtype=float).ravel() for v, x in file.variables.items()}


def by_pstripack(name):
    table = subprocess.run([pstripack, "convert", name, "-o", "-", "--to", "csv"], capture_output=True, text=True, check=True)
    rows = list(csv.reader(table.stdout.splitlines()))
    return {name: np.array([float(row[k]) if row[k] else np.nan for row in rows[1:]])
            for k, name in enumerate(rows[0])}


def same(a, b):
    return np.allclose(a, b, rtol=1e-6, atol=0, equal_nan=True)


count, differ = 0, {}
for kind, missing in itertools.product(TYPES, MISSING):
    if missing == "_Unsigned" and kind[0] != "i":
        continue
    order, group = ["n", "1n", "n1"][count % 3], ["", "observations"][count // 3 % 2]
    name = f"{folder}/{count}.nc"
    values = raw_values(kind, missing)
    with netCDF4.Dataset(name, "w") as file:
        file.createDimension("n", N)
        file.createDimension("one", 1)
        place = file.createGroup(group) if group else file
        for axis, units in (("lon", "degrees_east"), ("lat", "Degrees North")):
            v = place.createVariable(axis, "i2", ("n",))
            v.units, v.scale_factor = units, 0.5
            v.set_auto_maskandscale(False)
            v[:] = np.arange(N)
        for k, packing in enumerate(PACKINGS):
            write(place, f"v{k}", kind, packing, missing, order, values)
    ours, one, other = by_pstripack(name), by_netcdf4(name, group), by_xarray(name, group)
    assert same(ours["lon"], np.arange(N) / 2), (name, ours["lon"])
    for v in (f"v{k}" for k in range(len(PACKINGS))):
        what = f"{name}: {kind}, {missing}, {v}: ours {ours[v]}, netCDF4 {one[v]}, xarray {other[v]}"
        if same(one[v], other[v]):
            assert same(ours[v], one[v]), what
        else:
            differ[missing] = differ.get(missing, 0) + 1
            assert missing in RULES, what
            assert same(ours[v], {"netCDF4": one, "xarray": other}[RULES[missing]][v]), what
    count += 1
assert set(differ) == set(RULES), differ
print(f"{count} files as netCDF4 and xarray read them; where these differ, by the rule: {differ}")
