#!/usr/bin/env python3
"""Makes a static site of all documents and interfaces with Doxygen.

  make_site.py DOXYGEN OUT     in OUT/html; ends with 1 if Doxygen has a warning

Doxygen gets copies, in OUT/pages: GitHub's anchors as labels, links between pages as references, files that pages link
to beside the site; and comments of the C headers marked as documentation.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

from markdown_page import MarkdownPage

ROOT = Path(__file__).resolve().parents[2]
PAGES = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "SECURITY.md", "docs/**/*.md", "examples/README.md",
         "src/README.md", "tests/README.md"]
INTERFACES = ["src/cxx/capi/pstripack.h", "src/cxx/capi/pstripack_mpi.h", "src/fortran/pstripack.f90",
              "src/fortran/pstripack_mpi.f90"]


def label(path, anchor=""):
    """Doxygen's name of a page or a heading; of a page it is the name of the HTML file."""
    name = path.relative_to(ROOT).with_suffix("").as_posix().replace("/", "-")
    return f"{name}--{anchor}" if anchor else "mainpage" if name == "README" else name


def prepared_page(path, page, pages, html):
    def heading(level, text, anchor):
        return f"{level} {text} {{#{label(path) if level == '#' else label(path, anchor)}}}"

    def link(target):
        if re.match(r"\w+:", target):
            return target
        file, _, anchor = target.partition("#")
        file = (path.parent / file).resolve() if file else path
        if file not in pages:
            copy = html / "files" / file.relative_to(ROOT)
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, copy)
            return copy.relative_to(html).as_posix()
        title = not anchor or anchor == pages[file].anchors[0]
        return f"@ref {label(file) if title else label(file, anchor)}"

    # Fortran without colours: for some fragments Doxygen 1.9 reads beyond their end, and may crash.
    return page.rewritten(heading, link).replace("```fortran\n", "```\n")


def prepared_interface(text):
    """Comments before and after declarations for Doxygen, indented lists in them as they are."""
    text = re.sub(r"(?m)^/\*(?=[ \n])", "/**", text)
    text = re.sub(r"(?m)^( *\S.*)/\* ", r"\1/**< ", text)
    if text.startswith("/** "):
        text = text.replace("/** ", "/** @file\n * ", 1)
    # Doxygen hides the types of a module that is private by default; bindings to C are nobody's business.
    text = re.sub(r"(?m)^ +private$|(?s:^  interface$.*?^  end interface$)", "", text)
    return re.sub(r"(?m)(?:^( *!>| \*)   .*\n)+", as_code, text)


def as_code(block):
    """Indented lines of a comment, so deep that Markdown shows them as they are."""
    prefix, end = block[1], ""
    text = block[0]
    if text.endswith(" */\n"):
        text, end = text[:-4] + "\n", "/"
    lines = [line.replace(prefix, prefix + "    ", 1) for line in text.splitlines()]
    return "\n".join([prefix, *lines, prefix + end]) + "\n"


def main():
    doxygen, out = sys.argv[1], Path(sys.argv[2]).resolve()
    html = out / "html"
    for folder in html, out / "pages":
        shutil.rmtree(folder, ignore_errors=True)
    html.mkdir(parents=True)
    pages = {path: MarkdownPage(path) for pattern in PAGES for path in sorted(ROOT.glob(pattern))}
    inputs = {path: prepared_page(path, page, pages, html) for path, page in pages.items()}
    inputs |= {ROOT / path: prepared_interface((ROOT / path).read_text()) for path in INTERFACES}
    for path, text in inputs.items():
        copy = out / "pages" / (path.relative_to(ROOT) if path in pages else path.name)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text(text)
    settings = (Path(__file__).parent / "Doxyfile").read_text()
    settings += f'INPUT = "{out}/pages"\nSTRIP_FROM_PATH = "{out}/pages"\nOUTPUT_DIRECTORY = "{out}"\n'
    settings += f'IMAGE_PATH = "{html}"\n'
    try:
        subprocess.run([doxygen, "-"], input=settings, text=True, check=True)
    except subprocess.CalledProcessError as error:
        sys.exit(str(error))


if __name__ == "__main__":
    main()
