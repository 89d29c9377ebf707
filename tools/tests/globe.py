"""Checks globes: the data in them against what other commands write, and, given a browser, what its user sees.

globe.py PSTRIPACK FOLDER [CHROMIUM]
"""
import csv
import json
import math
import os
import re
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM, FOLDER = sys.argv[1], Path(sys.argv[2]).resolve()


def run(*arguments):
    return subprocess.run([PROGRAM, "-q", *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def table(name):
    with open(FOLDER / name, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def triangles(values):
    result, first = [], 0
    for k in range(0, len(values), 3):
        first += values[k]
        result.append((first, first + values[k + 1], first + values[k + 2]))
    return result


def data_of(name):
    """The data of a globe, which loads nothing else."""
    text = (FOLDER / name).read_text(encoding="utf-8")
    assert not re.search(r"<(link|img|iframe)|<[^>]*\s(src|href)=", text) and text.count("<script") == 2
    return json.loads(re.search(r'(?s)<script type="application/json" id="data">(.*?)</script>', text)[1])


def write_shapefile(name, lines):
    records = b""
    for number, line in enumerate(lines):
        shape = struct.pack("<i4d3i", 3, 0, 0, 0, 0, 1, len(line), 0) + b"".join(struct.pack("<2d", *p) for p in line)
        records += struct.pack(">2i", number + 1, len(shape) // 2) + shape
    header = struct.pack(">7i", 9994, 0, 0, 0, 0, 0, 50 + len(records) // 2) + struct.pack("<2i8d", 1000, 3, *[0] * 8)
    (FOLDER / name).write_bytes(header + records)


def make_inputs():
    os.chdir(FOLDER)
    run("points", "random", 300, "-o", "nodes.txt", "--to", "lonlat")
    rows = [line.split() for line in Path("nodes.txt").read_text().splitlines() if not line.startswith("#")]
    with open("nodes.csv", "w", encoding="utf-8") as file:
        file.write("lon,lat,height,kind\n")
        for k, (lon, lat) in enumerate(rows):
            file.write(f"{float(lon) % 360!r},{lat},{'' if k == 7 else k * k / 7 - 1000},{'Où</script>' if k % 3 else 'b'}\n")
    # Also land that is cut at the antimeridian and continued to the pole: the cuts are no coast.
    write_shapefile("coast.shp", [[(0, 0), (20, 1.00001), (170, -60)], [(-170.5, 80), (10, 89)],
                                  [(180, -80), (0, -70), (-180, -80), (-180, -90), (180, -90), (180, -80)]])
    whole = Path("coast.shp").read_bytes()
    for size in 0, 50, 99, 104, 110, 150, len(whole) - 1:
        Path("short.shp").write_bytes(whole[:size])
        done = subprocess.run([PROGRAM, "plot", "nodes.csv", "--coast-file", "short.shp", "-o", "short.svg"], capture_output=True, text=True)
        assert done.returncode == 1 and "short.shp: not a shapefile (.shp) of lines or polygons" in done.stderr, (size, done)
    run("points", "cap:0.3", 200, "-o", "region.txt")


def check_data():
    run("plot", "nodes.csv", "--what", "cells", "--colour", "height", "--coast-file", "coast.shp", "--title",
        "</script><b>Où\\", "-o", "cells.html")
    data, given = data_of("cells.html"), table("nodes.csv")
    assert data["title"] == "</script><b>Où\\" and data["first"] == 1 and data["cells"] is True
    for name in "lon", "lat":
        assert all(abs(x - float(row[name])) < 1e-9 for x, row in zip(data[name], given, strict=True))
    run("triangulate", "nodes.csv", "-o", "mesh.off")
    numbers = [line.split() for line in Path("mesh.off").read_text().splitlines()]
    assert triangles(data["triangles"]) == [tuple(map(int, line[1:])) for line in numbers if line[0] == "3" and len(line) == 4]
    heights = data["numbers"]
    assert heights == [float(row["height"]) if row["height"] else None for row in given] and heights[7] is None
    # The colours divide the scale, which ends at the first and the last tick, into 64 steps; the 65th is for no value.
    assert len(data["colours"]) == 65 and data["ticks"][0] == [0, "-2000"] and data["ticks"][-1][0] == 1
    low, high = float(data["ticks"][0][1]), float(data["ticks"][-1][1])
    for height, shade in zip(heights, data["shades"], strict=True):
        assert shade == 64 if height is None else abs(shade / 63 - (height - low) / (high - low)) < 0.5001 / 63
    assert [line for line in data["coasts"] if len(line) > 2] == [
        [0, 0, 2000000, 100001, 15000000, -6100001], [-17050000, 8000000, 18050000, 900000],
        [-18000000, -8000000, 18000000, 1000000, -18000000, -1000000]], data["coasts"]

    run("plot", "nodes.csv", "--what", "cells", "--colour", "kind", "--view", "orthographic:10,50", "--zoom", 20, "-o", "kinds.html")
    data = data_of("kinds.html")
    assert data["words"] == [row["kind"] for row in given] and data["labels"][:2] == ["Où</script>", "b"], data["labels"]
    assert data["centre"] == [10, 50] and data["radius"] == 20 and "ticks" not in data

    # A region.
    (FOLDER / "region.html").write_text(run("plot", "region.txt", "--to", "html", "-o", "-"))
    data = data_of("region.html")
    assert data["cells"] is False and "shades" not in data

    run("points", "icosahedral", 40962, "-o", "many.txt")
    run("plot", "many.txt", "--what", "cells", "--colour", "area", "-o", "many.html")
    assert (FOLDER / "many.html").stat().st_size < 3e6


class Browser:
    """Chromium without a window. It takes commands of its DevTools protocol from a pipe: JSON, each ended by a zero byte."""

    def __init__(self, program, profile):
        theirs_in, self.out = os.pipe()
        self.into, theirs_out = os.pipe()

        def connect():  # the browser reads from 3 and writes to 4
            os.dup2(os.dup2(theirs_in, 100), 3)
            os.dup2(os.dup2(theirs_out, 101), 4)

        self.process = subprocess.Popen([program, "--headless", "--no-sandbox", "--use-angle=swiftshader",
                                         "--enable-unsafe-swiftshader", "--remote-debugging-pipe", f"--user-data-dir={profile}"],
                                        preexec_fn=connect, close_fds=False, stderr=subprocess.DEVNULL)
        os.close(theirs_in), os.close(theirs_out)
        self.number, self.session, self.events, self.buffer = 0, {}, [], b""
        page = next(t for t in self("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = {"sessionId": self("Target.attachToTarget", targetId=page["targetId"], flatten=True)["sessionId"]}
        for domain in "Page", "Runtime", "Log", "Network":
            self(domain + ".enable")

    def message(self):
        while b"\0" not in self.buffer:
            self.buffer += os.read(self.into, 1 << 20) or sys.exit("globe: Chromium has ended")
        text, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(text)

    def __call__(self, method, **params):
        self.number += 1
        os.write(self.out, json.dumps({"id": self.number, "method": method, "params": params, **self.session}).encode() + b"\0")
        while True:
            answer = self.message()
            if answer.get("id") == self.number:
                return answer["result"]
            self.events.append(answer)

    def js(self, expression):
        answer = self("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    def open(self, name, width=900, height=800):
        """Opens a globe. It must load nothing else and say nothing."""
        self("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self("Page.navigate", url="about:blank")  # so that another address after # loads the file again
        self.js("0")
        self.events.clear()
        self("Page.navigate", url=f"file://{FOLDER}/{name}")
        while not any(event["method"] == "Page.loadEventFired" for event in self.events):
            self.events.append(self.message())
        self.after_drawing()
        said = [e for e in self.events if e["method"] in ("Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded")]
        asked = [e["params"]["request"]["url"] for e in self.events if e["method"] == "Network.requestWillBeSent"]
        assert not said and len(asked) == 1, (said, asked)
        return self.js("globe.opened") / 1000

    def after_drawing(self):
        self.js("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def text(self, name):
        self.after_drawing()
        return self.js(f"document.getElementById('{name}').innerText")

    def mouse(self, kind, x, y, **more):
        self("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def key(self, key, **more):
        for kind in "keyDown", "keyUp":
            self("Input.dispatchKeyEvent", type=kind, key=key, code=key, **more)

    def close(self):
        self("Browser.close")
        self.process.wait()


def digits(value, places=6):
    """12,345.7, as the page shows numbers."""
    return f"{float(f'{value:.{places}g}'):,.10f}".rstrip("0").rstrip(".")


def check_in_browser(program):
    run("plot", "nodes.csv", "--what", "cells", "--colour", "height", "--coast-file", "coast.shp", "-o", "cells.html")
    run("plot", "region.txt", "--what", "cells", "--colour", "area", "-o", "region.html")
    run("plot", "nodes.csv", "-o", "triangles.html")
    run("voronoi", "nodes.csv", "-o", "cells.csv")
    run("triangulate", "nodes.csv", "-o", "triangles.csv")
    data, cells = data_of("cells.html"), table("cells.csv")
    lon, lat = data["lon"], data["lat"]
    corners = triangles(data["triangles"])
    browser = Browser(program, tempfile.mkdtemp(dir=FOLDER))

    # The node in the middle of the view, with what other commands write about it.
    def near(x, y):
        def cosine(k):
            a, b = math.radians(lat[k]), math.radians(y)
            return math.sin(a) * math.sin(b) + math.cos(a) * math.cos(b) * math.cos(math.radians(lon[k] - x))
        return max(range(len(lon)), key=cosine)

    for x, y in (10, 50), (-130, -20.5), (179.9, 0), (0, 90), (77, -89):
        browser.open(f"cells.html#{x},{y},30")
        k = near(x, y)
        beside = {corner + 1 for triangle in corners if k in triangle for corner in triangle if corner != k}
        height = cells[k]["height"]
        east = (lon[k] + 180) % 360 - 180
        said = browser.text("node")
        place = re.search(r"([0-9.]+)° ([NS]), ([0-9.]+)° ([EW])", said)
        assert abs(float(place[1]) * (1 if place[2] == "N" else -1) - lat[k]) <= 0.5000001e-6
        assert abs(float(place[3]) * (1 if place[4] == "E" else -1) - east) <= 0.5000001e-6
        start, numbers = said.replace(place[0], "place").rsplit(": ", 1)
        assert start == (f"node {k + 1}; place; height: {digits(float(height)) if height else 'none'}; "
                         f"cell {digits(float(cells[k]['area_km2']))} km²; {len(beside)} neighbours")
        assert set(map(int, numbers.split())) == beside, (said, beside)

    # Mouse, search, keys. After a drag to the right the view is further west.
    browser.open("cells.html#10,50,30")
    browser.mouse("mousePressed", 450, 350, button="left", buttons=1)
    browser.mouse("mouseMoved", 550, 350, button="left", buttons=1)
    browser.mouse("mouseReleased", 550, 350, button="left")
    west = browser.js("globe.view.lon")
    assert west < 0, west
    browser.mouse("mouseWheel", 450, 350, deltaX=0, deltaY=-100)
    browser.after_drawing()
    assert browser.js("globe.view.half") < 0.49
    browser.js("document.getElementById('number').focus()")
    browser("Input.insertText", text="17")
    browser.key("Enter", text="\r", windowsVirtualKeyCode=13)
    assert browser.text("node").startswith("node 17; ") and abs(browser.js("globe.view.lat") - lat[16]) < 1e-9
    browser.js("document.getElementById('globe').focus()")
    for key, value, sign in ("ArrowRight", "lon", 1), ("ArrowUp", "lat", 1), ("ArrowLeft", "lon", -1), ("ArrowDown", "lat", -1), ("+", "half", -1):
        before = browser.js(f"globe.view.{value}")
        browser.key(key)
        assert (browser.js(f"globe.view.{value}") - before) * sign > 0, key
    browser.key("Home")
    assert browser.text("view") == "above 30° N, 0° E" and browser.text("node").startswith(f"node {near(0, 30) + 1}; ")
    assert len(browser("Page.captureScreenshot")["data"]) > 60000  # of one colour: a tenth

    # Keys work before a click. Nodes 5 cm apart: their cells do not overlap, and the middle one is under the middle.
    side = 0.05 / 6371e3 * 180 / math.pi
    (FOLDER / "plots.csv").write_text("lon,lat\n" + "".join(
        f"{8.55 + i * side * 1.5!r},{47.3 + j * side!r}\n" for j in (-1, 0, 1) for i in (-1, 0, 1)))
    run("plot", "plots.csv", "--what", "cells", "-o", "plots.html")
    browser.open("plots.html")
    browser.key("Home")
    assert browser.text("node").startswith("node 5; "), browser.text("node")
    middle = browser.js("globe.star(4).cell")
    centre = [sum(corner[k] for corner in middle) / len(middle) for k in range(3)]
    assert all(math.dist(corner, centre) < 0.05 / 6371e3 for corner in middle), middle

    # Python counts from 0, and no address names node 0.
    page = (FOLDER / "cells.html").read_text(encoding="utf-8")
    (FOLDER / "zero.html").write_text(page.replace('"first":1,', '"first":0,'), encoding="utf-8")
    browser.open("zero.html")
    assert browser.text("view") == "above 30° N, 0° E" and browser.text("node") == ""
    browser.open("zero.html#0")
    assert browser.text("node").startswith("node 0; ")

    # Triangles, with their areas; a region, outside of which there is nothing; points, and cells from near.
    browser.open("triangles.html#10,50,30")
    found = re.search(r"triangle (\d+): ([0-9.,]+) km²", browser.text("node"))
    assert near(10, 50) in corners[int(found[1]) - 1] and found[2] == digits(float(table("triangles.csv")[int(found[1]) - 1]["area_km2"])), found
    browser.open("region.html", 360, 640)
    browser.mouse("mouseMoved", 180, 300)
    assert browser.text("node").startswith("node ")
    browser.mouse("mouseMoved", 5, 300)
    assert browser.text("node") == ""
    seconds = browser.open("many.html")
    print(f"globe: 40962 nodes, {(FOLDER / 'many.html').stat().st_size / 1e6:.1f} MB, open in {seconds:.1f} s")
    assert seconds < 20
    browser.close()


FOLDER.mkdir(parents=True, exist_ok=True)
make_inputs()
check_data()
if len(sys.argv) > 3:
    check_in_browser(sys.argv[3])
print("globe: all checks passed")
