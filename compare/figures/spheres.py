"""Pictures of triangles on spheres, coloured by their owner: orthographic, as SVG and PNG."""
import csv
import math
import subprocess

from charts import PALETTE

RADIUS, MARGIN, ABOVE, BELOW = 250, 12, 60, 30
STITCHED, STITCHED_COLOUR = -1, "#333333"  # a triangle without a single owner
LATITUDE, LONGITUDE = math.radians(35), math.radians(20)  # of the eye


def read(path):
    """owner -> triangles, each of three points."""
    triangles = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            corners = [tuple(float(row[f"{axis}{corner}"]) for axis in "xyz") for corner in "123"]
            triangles.setdefault(int(row["owner"]), []).append(corners)
    return triangles


def colours(triangles):
    """A colour for each owner, if possible different from those of the neighbouring owners."""
    owners_at, around = {}, {owner: set() for owner in triangles}
    for owner in triangles.keys() - {STITCHED}:
        for corner in (corner for corners in triangles[owner] for corner in corners):
            owners_at.setdefault(corner, set()).add(owner)
    for corners in (corners for own in triangles.values() for corners in own):
        owners = set().union(*(owners_at.get(corner, ()) for corner in corners))
        for owner in owners:
            around[owner] |= owners - {owner}
    chosen = {STITCHED: STITCHED_COLOUR}
    for owner in sorted(triangles.keys() - {STITCHED}):
        taken = [chosen.get(other) for other in around[owner]]
        # Choose the colour that is rarest among the neighbours, then the one that is rarest overall.
        chosen[owner] = min(PALETTE, key=lambda c: (taken.count(c), list(chosen.values()).count(c)))
    return chosen


def _dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def _sphere(triangles, centre_x, centre_y):
    east = (-math.sin(LONGITUDE), math.cos(LONGITUDE), 0)
    eye = (math.cos(LATITUDE) * math.cos(LONGITUDE), math.cos(LATITUDE) * math.sin(LONGITUDE), math.sin(LATITUDE))
    north = tuple(eye[(i + 1) % 3] * east[(i + 2) % 3] - eye[(i + 2) % 3] * east[(i + 1) % 3] for i in range(3))

    def place(p):  # integers, in tenths of a pixel, keep the file small
        return round(10 * (centre_x + RADIUS * _dot(p, east))), round(10 * (centre_y - RADIUS * _dot(p, north)))

    def outline(corners):
        (x, y), *others = map(place, corners)
        return f"M{x} {y}L" + " ".join(f"{u} {v}" for u, v in others) + "Z"

    yield f'<circle cx="{centre_x}" cy="{centre_y}" r="{RADIUS}" fill="#eeeeee"/>'
    yield '<g transform="scale(0.1)" stroke="#ffffff" stroke-width="3">'
    chosen = colours(triangles)
    for owner, own in sorted(triangles.items()):
        path = "".join(outline(corners) for corners in own if all(_dot(p, eye) > 0 for p in corners))
        yield f'<path d="{path}" fill="{chosen[owner]}"/>'
    yield "</g>"


def draw(path, title, spheres, note):
    """Writes path.svg and path.png: spheres is a list of (caption, triangles of read())."""
    side = 2 * (RADIUS + MARGIN)
    width, height = side * len(spheres), side + ABOVE + BELOW

    def text(x, y, size, words):
        return f'<text x="{x}" y="{y}" font-size="{size}" text-anchor="middle">{words}</text>'

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
             f'viewBox="0 0 {width} {height}" font-family="DejaVu Sans, sans-serif">',
             '<rect width="100%" height="100%" fill="#ffffff"/>',
             text(width / 2, 24, 17, title), text(width / 2, height - 10, 12, note)]
    for i, (caption, triangles) in enumerate(spheres):
        x = side * (i + 0.5)
        parts += [text(x, 50, 14, caption), *_sphere(triangles, x, ABOVE + side / 2)]
    with open(f"{path}.svg", "w") as file:
        file.write("\n".join(parts) + "\n</svg>\n")
    subprocess.run(["rsvg-convert", "-o", f"{path}.png", f"{path}.svg"], check=True)
