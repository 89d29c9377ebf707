#!/usr/bin/env python3
"""Checks with the metrics of the font that no text of a picture overlaps another, crosses the border of a drawing,
colour bar or square, or leaves the page.

  text_boxes.py pstripack work-folder font-folder picture.svg...
"""
import math
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

from PIL import ImageFont

ASCENT, DESCENT = 0.76, 0.236  # of letters such as d and p, in parts of the size


def name_of(element):
    return element.tag.split("}")[1]


def text_box(element, x0, y0, styles, fonts, bold):
    kind = styles.get(element.get("class", ""), "")
    size = float(element.get("font-size") or re.search(r"font-size: (\d+)px", kind)[1])
    text = "".join(element.itertext())
    font = fonts[bold or "bold" in kind]
    width = font.getlength(text) / font.size * size
    x, y = x0 + float(element.get("x")), y0 + float(element.get("y"))
    left = x - {"start": 0, "middle": 0.5, "end": 1}[element.get("text-anchor", "start")] * width
    return text, (left, y - ASCENT * size, left + width, y + DESCENT * size)


def contents(root, styles, fonts):
    """Boxes of texts, rectangles (left, top, right, bottom) and circles (x, y, radius) of drawings."""
    texts, rectangles, circles = [], [], []

    def visit(element, x0, y0, bold):
        bold = bold or element.get("font-weight") == "bold"
        for child in element:
            name = name_of(child)
            if name == "svg":
                visit(child, x0 + float(child.get("x")), y0 + float(child.get("y")), bold)
            elif name == "g":
                visit(child, x0, y0, bold)
            elif name == "text":
                texts.append(text_box(child, x0, y0, styles, fonts, bold))
            elif child.get("class") in ("drawing", "panel") and name == "rect":
                x, y, w, h = (float(child.get(key, 0)) for key in ("x", "y", "width", "height"))
                rectangles.append((x0 + x, y0 + y, x0 + x + w, y0 + y + h))
            elif child.get("class") == "drawing" and name == "circle":
                circles.append(tuple(float(child.get(key)) for key in ("cx", "cy", "r")))
    visit(root, 0, 0, False)
    return texts, rectangles, circles


def overlap(a, b):
    return a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3]


def inside(a, b):
    return b[0] <= a[0] and b[1] <= a[1] and a[2] <= b[2] and a[3] <= b[3]


def crosses_circle(box, circle):
    x, y, r = circle
    near = math.hypot(max(box[0] - x, 0, x - box[2]), max(box[1] - y, 0, y - box[3]))
    far = math.hypot(max(x - box[0], box[2] - x), max(y - box[1], box[3] - y))
    return near < r < far


def problems_of(path, fonts):
    root = xml.parse(path).getroot()
    style = next((e.text for e in root if name_of(e) == "style"), "")
    styles = dict(re.findall(r"\.(\w+) {(.*?)}", style))
    texts, rectangles, circles = contents(root, styles, fonts)
    page = (0, 0, *(float(v) for v in (root.get("viewBox") or f"0 0 {root.get('width')} {root.get('height')}").split()[2:]))
    if not texts or not (rectangles or circles):
        yield "has no texts or no drawing"
    for i, (text, box) in enumerate(texts):
        if not inside(box, page):
            yield f"'{text}' leaves the page"
        for other, other_box in texts[:i]:
            if overlap(box, other_box):
                yield f"'{text}' overlaps '{other}'"
        if any(overlap(box, r) and not inside(box, r) for r in rectangles) or any(crosses_circle(box, c) for c in circles):
            yield f"'{text}' crosses the border of a drawing"


def make_pictures(pstripack, work):
    def run(*arguments):
        done = subprocess.run([pstripack, "-q", *arguments], cwd=work, text=True, capture_output=True,
                              env=os.environ | {"OMP_NUM_THREADS": "1"})
        if done.returncode != 0:
            sys.exit(f"text_boxes.py: {' '.join(arguments)}: {done.stderr}")
        return done.stdout

    # Columns of every kind: wide numbers, small ones, over many decades, with gaps, few and many words.
    rows = run("points", "random", "300", "-o", "-", "--to", "lonlat").splitlines()
    words = ["a b", "c", "a name that is rather long, as names of places sometimes are"] + [str(k) * 9 for k in range(9)]
    table = ["lon,lat,depth,wide,small,decades,same,negative,few,many"]
    for i, row in enumerate(rows):
        values = [f"{i % 90 / 3:g}" if i % 5 else "", 1.6e9 + i, 1e-7 * (i + 1), 10 ** (i % 30 - 15), 5, -1e6 * (i + 1),
                  words[i % 3], words[i % len(words)]]
        table.append(",".join(row.split() + [f'"{v}"' if isinstance(v, str) else f"{v!r}" for v in values]))
    long_name = "a table of many columns whose name is so long that a picture has no room for it " * 2
    (work / f"{long_name}.csv").write_text("\n".join(table) + "\n")
    run("points", "cap:0.3", "400", "-o", "region.txt")
    run("points", "cap:1e-6", "400", "-o", "tiny.txt")
    run("points", "variable:10", "1000", "-o", "variable.txt")
    made = []

    def plot(source, *options):
        made.append(work / f"{len(made)}.svg")
        run("plot", source, *options, "-o", made[-1].name)

    for view in ("orthographic", "lonlat", "lonlat:180,0"):
        for colour in ("area", "degree", "owner:12", "owner:64", "owner:40:stripes", "depth", "wide", "small", "decades",
                       "same", "negative", "few", "many", "line"):
            plot(f"{long_name}.csv", "--what", "cells", "--view", view, "--colour", colour)
    for view in ("orthographic", "lonlat"):
        for what, colour in (("triangles", "none"), ("cells", "area"), ("cells", "owner:5")):
            plot("region.txt", "--what", what, "--colour", colour, "--view", view)
        plot("tiny.txt", "--view", view)
    for centre, radius in (("10,50", "20"), ("179.9,-89.5", "3"), ("-120.123,0", "60"), ("33,80", "1e-5"), ("5,5", "89")):
        for view in ("orthographic", "lonlat"):
            plot("variable.txt", "--view", f"{view}:{centre}", "--zoom", radius, "--colour", "area")
    for width in ("300", "450"):
        for colour in ("area", "owner:12", "few"):
            for view in ("orthographic", "lonlat"):
                plot(f"{long_name}.csv", "--what", "cells", "--colour", colour, "--width", width, "--view", view)
        plot("region.txt", "--width", width)
        plot("region.txt", "--width", width, "--what", "cells", "--colour", "area", "--range", "123,45678.9", "--dots")
        plot("variable.txt", "--width", width, "--box", "170,-170,-30.5,-10.25", "--colour", "area", "--range", "5e5,7e5")
    return made


def main():
    pstripack, work, fonts, *pictures = sys.argv[1:]
    work = Path(work)
    work.mkdir(parents=True, exist_ok=True)
    fonts = {bold: ImageFont.truetype(f"{fonts}/DejaVuSans{'-Bold' if bold else ''}.ttf", 2048) for bold in (False, True)}
    paths = make_pictures(pstripack, work) + [Path(p) for p in pictures]
    problems = [f"{path}: {problem}" for path in paths for problem in problems_of(path, fonts)]
    print("\n".join(problems[:40]), f"\n{len(paths)} pictures, {len(problems)} problems")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
