#!/usr/bin/env python3
"""Fails unless every linked file and picture exists, every anchor is a heading, and every page can be reached from
README.md by links.

  check_links.py ROOT          the Markdown pages of ROOT, of its docs, examples, src and tests
  check_links.py --html DIR    the links between the HTML pages of DIR
"""
import html.parser
import re
import sys
from pathlib import Path
from urllib.parse import unquote

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs/site"))
from markdown_page import MarkdownPage  # noqa: E402


class HtmlPage(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        text = path.read_text()
        self.anchors, self.links = set(), re.findall(r'\["([^"]+\.html[^"]*)", "', text)  # those that search.html finds
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id" or (tag == "a" and name == "name"):
                self.anchors.add(value)
            elif name in ("href", "src") and value and not value.startswith("javascript:"):
                self.links.append(value)


def check(root, pages):
    """The broken links as lines, and for each page the pages that it links."""
    problems, linked = [], {path: set() for path in pages}
    for path, page in pages.items():
        for link in page.links:
            if re.match(r"\w+:", link):
                continue
            file, _, anchor = unquote(link).partition("#")
            target = (path.parent / file).resolve() if file else path
            if not target.exists():
                problems.append(f"{path.relative_to(root)}: {link}: no such file")
            elif anchor and target in pages and anchor not in pages[target].anchors:
                problems.append(f"{path.relative_to(root)}: {link}: no such heading")
            linked[path].add(target)
    return problems, linked


def orphans(root, linked):
    reached, new = set(), [root / "README.md"]
    while new:
        page = new.pop()
        if page in linked and page not in reached:
            reached.add(page)
            new += linked[page]
    return [f"{page.relative_to(root)}: no link leads here from README.md" for page in linked if page not in reached]


def main():
    if sys.argv[1] == "--html":
        root = Path(sys.argv[2]).resolve()
        pages = {path: HtmlPage(path) for path in sorted(root.rglob("*.html"))}
        problems, _ = check(root, pages)
    else:
        root = Path(sys.argv[1]).resolve()
        files = [path for pattern in ("*.md", "docs/**/*.md", "examples/**/*.md", "src/*.md", "tests/*.md")
                 for path in sorted(root.glob(pattern))]
        pages = {path: MarkdownPage(path) for path in files}
        problems, linked = check(root, pages)
        problems += orphans(root, linked)
    if not pages:
        sys.exit(f"{root}: no pages")
    print("\n".join(problems) or f"{len(pages)} pages, {sum(len(page.links) for page in pages.values())} links")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
