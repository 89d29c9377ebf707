#!/usr/bin/env python3
"""usage: check_figures.py FOLDER PICTURES DOCUMENT...

Fails unless the documents embed every picture of the folder and no other one but those of the page PICTURES, and each is
there as SVG and PNG, is well-formed, and says what is projected, or that nothing is, or that it is of one process."""
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

NOTES = ("projected from processor time on the critical path", "One process.", "nothing is projected")


def main():
    if len(sys.argv) < 4:
        print(__doc__, file=sys.stderr)
        sys.exit(2)
    folder, (others, *documents) = Path(sys.argv[1]), [Path(name).read_text() for name in sys.argv[2:]]
    embedded = {Path(name).stem for document in documents for name in re.findall(r"\]\(figures/([^)]+)\)", document)
                if f"figures/{name}" not in others}
    wrong = [f"{svg.name} is in no document" for svg in folder.glob("*.svg") if svg.stem not in embedded]
    for name in sorted(embedded):
        svg, png = folder / f"{name}.svg", folder / f"{name}.png"
        if not svg.exists() or not png.exists():
            wrong.append(f"{name}: there is no SVG or no PNG")
            continue
        words = " ".join("".join(ElementTree.parse(svg).getroot().itertext()).split())
        if not any(note in words for note in NOTES):
            wrong.append(f"{name}.svg does not say what is projected")
        if not png.read_bytes().startswith(b"\x89PNG"):
            wrong.append(f"{name}.png is no PNG")
    if wrong or not embedded:
        sys.exit("\n".join(wrong or ["the documents embed no figure"]))


if __name__ == "__main__":
    main()
