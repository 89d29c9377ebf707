"""docs/api/python.md: the reference of the Python package, which make-api.py makes from the docstrings.

Docstrings have the sections of numpydoc. The sources are read, not imported, so that nothing need be built. A function
must have a section Parameters with its parameters, a section Returns if it returns something, and Examples.
"""
import ast
import inspect
import re
import sys
import textwrap

HEAD = """# Python reference

The docstrings, which `help(Delaunay)` shows, too. [python.md](../python.md) has examples by task."""
TAIL = "Made by `docs/api/make-api.py` from `python/src/pstripack`."
TYPES = {"Floats": "float64 array", "Ints": "int32 array", "Any": "", "List[List[int]]": "list of lists"}


def sections(docstring):
    """Title -> text. The text before the first section has the title ""."""
    parts = re.split(r"(?m)^(\w+)\n-+\n", inspect.cleandoc(docstring))
    return {"": parts[0].strip()} | {title: text.strip("\n") for title, text in zip(parts[1::2], parts[2::2])}


def entries(text):
    """(names, type, description) of each entry of a section."""
    for entry in re.findall(r"(?m)^\S.*(?:\n(?: .*)?$)*", text):
        head, _, body = entry.partition("\n")
        names, _, kind = head.partition(" : ")
        yield names, kind, " ".join(body.split())


def attributes(source):
    """(name, type, comment) of lines `name: type` that have a comment #: behind or above them."""
    pattern = r"(?m)^((?: *#: .*\n)*) +(?:self\.)?(\w+)(?:: ([^=#\n]+?))?(?: = [^#\n]*?)?(?:  #: (.*))?$"
    return [(name, kind, " ".join((above or behind).replace("#:", " ").split()))
            for above, name, kind, behind in re.findall(pattern, source) if (above or behind) and not name.startswith("_")]


def has_decorator(function, name):
    return any(name in (getattr(d, "id", ""), getattr(d, "attr", "")) for d in function.decorator_list)


def public_functions(node):
    return [each for each in node.body if isinstance(each, ast.FunctionDef) and not each.name.startswith("_")
            and not has_decorator(each, "abstractmethod")]


def signature(function, is_method):
    """The arguments without their types, and their names."""
    arguments = function.args
    for each in (*arguments.args, *arguments.kwonlyargs, *filter(None, [arguments.kwarg])):
        each.annotation = None
    arguments.args = arguments.args[is_method:]
    names = [each.arg for each in (*arguments.args, *arguments.kwonlyargs)]
    return ast.unparse(arguments), names + [f"**{each.arg}" for each in filter(None, [arguments.kwarg])]


class Page:
    def __init__(self, folder):
        self.known, trees = {}, {path: ast.parse(path.read_text()) for path in sorted(folder.glob("*.py"))}
        for path, tree in trees.items():
            lines = path.read_text().splitlines()
            self.known |= {node.name: (node, "\n".join(lines[node.lineno - 1:node.end_lineno])) for node in tree.body
                           if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        init = trees[folder / "__init__.py"]
        names = next(ast.literal_eval(node.value) for node in init.body if isinstance(node, ast.Assign))
        names = sorted((name for name in {*names, "Globe"} if not name.startswith("_")), key=self.place_of)
        self.text, self.owner = [HEAD], ""
        self.add_docstring(ast.get_docstring(init))
        for name in names:
            self.add(name)
        self.text = "\n\n".join(self.text + [TAIL]) + "\n"

    def place_of(self, name):
        """Delaunay, other classes, functions, exceptions."""
        node = self.known[name][0]
        return name != "Delaunay", name.endswith("Error"), not isinstance(node, ast.ClassDef), name

    def inline(self, text):
        """Roles become links, double backticks single ones."""
        def link(match):
            name = match[1] if match[1] in self.known or "." in match[1] else f"{self.owner}.{match[1]}"
            anchor = re.sub("[^a-z0-9_]", "", name.lower())
            return f"[`{match[1]}`](#{anchor})"

        return re.sub(r"``([^`]*)``", r"`\1`", re.sub(r":\w+:`([^`]*)`", link, text))

    def add_docstring(self, docstring):
        for title, text in sections(docstring).items():
            if not title:
                self.text += [textwrap.fill(self.inline(part), 118) for part in re.split(r"\n\n+", text)]
                continue
            self.text.append(f"**{title}**")
            if title == "Examples":
                self.text.append(f"```\n{text}\n```")
            elif title == "Notes":
                self.text.append(textwrap.fill(self.inline(text), 118))
            else:
                self.text.append("\n".join(
                    textwrap.fill(f"- `{names}`" + (f" ({self.inline(kind)})" if kind else "") + (f": {self.inline(body)}" if body else ""),
                                  118, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False)
                    for names, kind, body in entries(text)))

    def add_function(self, name, function, docstring, is_method):
        """A function, or the constructor of a class."""
        arguments, parameters = signature(function, is_method)
        said = sections(docstring or "")
        documented = [each for names, _, _ in entries(said.get("Parameters", "")) for each in names.split(", ")]
        returns = function.returns is not None and ast.unparse(function.returns) != "None"
        if sorted(documented) != sorted(parameters) or returns > ("Returns" in said) or returns > ("Examples" in said):
            sys.exit(f"{name}: the docstring has the parameters {documented}, not {parameters}, or no Returns, or no Examples")
        self.text.append("```\n" + textwrap.fill(f"{name}({arguments})", 110, subsequent_indent="    ") + "\n```")
        self.add_docstring(docstring)

    def add(self, name):
        """A function, or a class with what its bases in this package have."""
        node, _ = self.known[name]
        self.text.append(f"## {name}")
        if isinstance(node, ast.FunctionDef):
            return self.add_function(name, node, ast.get_docstring(node), False)
        self.owner = name
        docstring = ast.get_docstring(node)
        init = next((each for each in node.body if getattr(each, "name", "") == "__init__"), None)
        if init and "Parameters" in sections(docstring):
            self.add_function(name, init, docstring, True)
        else:
            self.add_docstring(docstring)
        self.add_members(name, docstring)
        for base in [base.id for base in node.bases if isinstance(base, ast.Name)]:
            self.add_base(base)

    def add_base(self, base):
        if base not in self.known or base.endswith("Error"):
            return
        node, _ = self.known[base]
        for further in [each.id for each in node.bases]:
            if f"## {self.owner}: {further.lower()}" not in self.text:
                self.add_base(further)
        self.text.append(f"## {self.owner}: {base.lower()}")
        docstring = ast.get_docstring(node).replace("Part of :class:`Delaunay`. ", "")
        self.add_docstring(docstring)
        self.add_members(base, docstring)

    def add_members(self, name, docstring):
        node, source = self.known[name]
        functions = public_functions(node)
        rows = attributes(source) + [(each.name, ast.unparse(each.returns), " ".join(ast.get_docstring(each).split()))
                                     for each in functions if has_decorator(each, "property")]
        if rows and "Attributes" not in sections(docstring):
            self.text.append("\n".join(["| attribute | type | |", "| --- | --- | --- |"] + [
                f"| `{row[0]}` | {TYPES.get(row[1], row[1].split('[')[0].lower())} | {self.inline(row[2])} |" for row in rows]))
        for each in functions:
            if not has_decorator(each, "property"):
                self.text.append(f"### {self.owner}.{each.name}")
                is_method = not has_decorator(each, "staticmethod")
                self.add_function(f"{self.owner}.{each.name}", each, ast.get_docstring(each), is_method)


def python_page(root):
    return Page(root / "python/src/pstripack").text
