"""A Markdown page: its headings and links, as GitHub sees them."""
import re

# Code is skipped, headings and links are found.
TOKEN = re.compile(r"^```.*?^```|`[^`\n]*`"
                   r"|^(?P<level>#+) (?P<heading>[^\n]*)$"
                   r"|(?<=\])\((?P<link>[^)\s]+)\)|<img src=\"(?P<picture>[^\"]+)\"", re.MULTILINE | re.DOTALL)


class MarkdownPage:
    def __init__(self, path):
        self.text = path.read_text()
        tokens = list(TOKEN.finditer(self.text))
        self.links = [token["link"] or token["picture"] for token in tokens if token["link"] or token["picture"]]
        self.anchors = []
        for token in tokens:
            if token["heading"]:
                self.anchors.append(self._new_anchor(token["heading"]))

    def _new_anchor(self, heading):
        heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        anchor = re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")
        same = [other for other in self.anchors if re.fullmatch(rf"{re.escape(anchor)}(-\d+)?", other)]
        return f"{anchor}-{len(same)}" if same else anchor

    @property
    def title(self):
        return re.sub(r"[`*]", "", re.search(r"^# (.*)$", self.text, re.MULTILINE)[1])

    def sections(self):
        """Of each heading: its text, its anchor, and the text below it."""
        headings = [token for token in TOKEN.finditer(self.text) if token["heading"]]
        ends = [token.start() for token in headings[1:]] + [len(self.text)]
        for token, anchor, end in zip(headings, self.anchors, ends):
            yield re.sub(r"[`*]", "", token["heading"]), anchor, self.text[token.end():end]

    def rewritten(self, heading, link):
        """The text with each heading replaced by heading(level, text, anchor), each target by link(target)."""
        anchors = iter(self.anchors)

        def replace(token):
            if token["heading"]:
                return heading(token["level"], token["heading"], next(anchors))
            for kind in "link", "picture":
                if token[kind]:
                    return token[0].replace(token[kind], link(token[kind]))
            return token[0]

        return TOKEN.sub(replace, self.text)
