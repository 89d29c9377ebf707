#!/usr/bin/env python3
"""Makes a static site of all documents and interfaces with Doxygen.

  make_site.py DOXYGEN OUT [PSTRIPACK]     in OUT/html; ends with 1 if Doxygen has a warning

With the program pstripack the first page has a globe of the tutorial's stations in place of its picture.

Doxygen gets copies, in OUT/pages: GitHub's anchors as labels, links between pages as references, files that pages link
to beside the site; and comments of the C headers marked as documentation.
"""
import json
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
        if level == "#":  # code in a title would show as HTML where the title is a link
            return f"# {text.replace('`', '')} {{#{label(path)}}}"
        return f"{level} {text} {{#{label(path, anchor)}}}"

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

    # Doxygen 1.9: for some fragments of Fortran it reads beyond their end, and may crash, so that they have no colours. It
    # takes a reference whose text has two lines, and all behind it, for text; code in it has its backticks.
    text = page.rewritten(heading, link).replace("```fortran\n", "```\n")
    text = re.sub(r"(?ms)^```.*?^```|`[^`\n]+`", in_two_backticks, text)
    return re.sub(r"\[[^\[\]]*\]\(@ref", lambda match: match[0].replace("\n", " ").replace("`", ""), text)


def in_two_backticks(code):
    """Code with ', which for Doxygen ends what one backtick begins."""
    return f"`{code[0]}`" if "'" in code[0] and not code[0].startswith("```") else code[0]


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


def globe_in_place_of_the_picture(text, program, html):
    """README with a globe, if it can be made."""
    command = [program, "plot", ROOT / "examples/stations/stations.csv", "--what", "cells", "--colour", "temperature",
               "-o", html / "globe.html"]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        print(f"no globe on the first page: {done.stderr.strip()}")
        return text
    globe = '@htmlonly<iframe class="globe" src="globe.html" title="temperature at 48 stations, a globe to turn"></iframe>@endhtmlonly\n'
    return re.sub(r"<img [^>]*>\n", globe, text, count=1)


def plain(text):
    """Without targets of links, code fences and lines of tables."""
    text = re.sub(r"\]\([^)\s]*\)|<img[^>]*>|^```\w*$|^[-| ]+$", " ", text, flags=re.MULTILINE)
    return " ".join(re.sub(r"\*\*|[`\[\]]", "", text.replace("|", " ")).split())


def add_search(pages, html):
    """The page that searches all sections, and its box on every other page."""
    sections = [(f"{label(path)}.html#{label(path, anchor)}" if number else f"{label(path)}.html",
                 heading if not number else f"{page.title}: {heading}", plain(text))
                for path, page in pages.items() for number, (heading, anchor, text) in enumerate(page.sections())]
    sections += [(path.replace("_", "__").replace(".", "_8") + ".html", path, plain((ROOT / folder / path).read_text()))
                 for folder, path in (each.rsplit("/", 1) for each in INTERFACES)]
    text = json.dumps([(address.replace("mainpage.html", "index.html"), *rest) for address, *rest in sections])
    box = '<form action="search.html"><input type="search" name="q" placeholder="Search" aria-label="words to find"></form>'
    for path in html.glob("*.html"):
        page = path.read_text()
        path.write_text(page.replace('<div id="titlearea">', '<div id="titlearea">' + box))
    template = (Path(__file__).parent / "search.html").read_text()
    (html / "search.html").write_text(template.replace("SECTIONS", text.replace("</", "<\\/"), 1))


def taken_for_text(pages, html):
    """Headings that the site lacks, and its pages with commands that Doxygen did not understand."""
    texts = {path.name: path.read_text() for path in html.glob("*.html")}
    whole = "".join(texts.values())
    labels = [label(path, anchor) for path, page in pages.items() for anchor in page.anchors[1:]]
    return ([each for each in labels if f'id="{each}"' not in whole]
            + [name for name, text in texts.items() if re.search(r"@ref|@section|\\ilinebr", text)])


def main():
    doxygen, out = sys.argv[1], Path(sys.argv[2]).resolve()
    html = out / "html"
    for folder in html, out / "pages":
        shutil.rmtree(folder, ignore_errors=True)
    html.mkdir(parents=True)
    pages = {path: MarkdownPage(path) for pattern in PAGES for path in sorted(ROOT.glob(pattern))}
    inputs = {path: prepared_page(path, page, pages, html) for path, page in pages.items()}
    if len(sys.argv) > 3:
        inputs[ROOT / "README.md"] = globe_in_place_of_the_picture(inputs[ROOT / "README.md"], sys.argv[3], html)
    inputs |= {ROOT / path: prepared_interface((ROOT / path).read_text()) for path in INTERFACES}
    for path, text in inputs.items():
        copy = out / "pages" / (path.relative_to(ROOT) if path in pages else path.name)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text(text)
    settings = (Path(__file__).parent / "Doxyfile").read_text()
    settings += f'INPUT = "{out}/pages"\nSTRIP_FROM_PATH = "{out}/pages"\nOUTPUT_DIRECTORY = "{out}"\n'
    settings += f'IMAGE_PATH = "{html}"\nHTML_EXTRA_STYLESHEET = "{Path(__file__).parent}/site.css"\n'
    try:
        subprocess.run([doxygen, "-"], input=settings, text=True, check=True)
    except subprocess.CalledProcessError as error:
        sys.exit(str(error))
    wrong = taken_for_text(pages, html)
    if wrong:
        sys.exit(f"Doxygen took headings, links or tables for text: {', '.join(wrong)}")
    add_search(pages, html)


if __name__ == "__main__":
    main()
