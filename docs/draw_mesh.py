#!/usr/bin/env python3
"""Draws a mesh of scvt_legacy as an SVG, seen from a point above the sphere. Needs only Python.

usage: draw_mesh.py PREFIX LAT LON > mesh.svg      reads PREFIX_points.txt and PREFIX_triangles.txt
"""
import math
import sys


def main() -> None:
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    prefix, lat, lon = sys.argv[1], math.radians(float(sys.argv[2])), math.radians(float(sys.argv[3]))
    with open(prefix + "_points.txt") as f:
        points = [tuple(map(float, line.split())) for line in f]
    with open(prefix + "_triangles.txt") as f:
        triangles = [tuple(int(v) - 1 for v in line.split()[:3]) for line in f]

    radius, margin = 250, 6
    east = (-math.sin(lon), math.cos(lon), 0.0)
    eye = (math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat))
    north = tuple(eye[(i + 1) % 3] * east[(i + 2) % 3] - eye[(i + 2) % 3] * east[(i + 1) % 3] for i in range(3))

    def dot(a, b):
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]

    flat = [(margin + radius * (1 + dot(p, east)), margin + radius * (1 - dot(p, north)), dot(p, eye)) for p in points]
    size = 2 * (radius + margin)
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size} {size}" width="{size}" height="{size}">')
    print(f'<circle cx="{size / 2}" cy="{size / 2}" r="{radius}" fill="#f4f8fb" stroke="#8aa" stroke-width="1"/>')
    edges = set()
    for a, b, c in triangles:
        for s, t in ((a, b), (b, c), (c, a)):
            if flat[s][2] > 0 and flat[t][2] > 0:
                edges.add((min(s, t), max(s, t)))
    path = "".join(f"M{flat[s][0]:.1f} {flat[s][1]:.1f}L{flat[t][0]:.1f} {flat[t][1]:.1f}" for s, t in sorted(edges))
    print(f'<path d="{path}" fill="none" stroke="#1f5f8b" stroke-width="0.5"/>')
    print("</svg>")


if __name__ == "__main__":
    main()
