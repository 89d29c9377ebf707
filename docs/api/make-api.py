#!/usr/bin/env python3
"""Makes, from the table of routines in docs/api/routines/*.toml:

  docs/api/*.md                     a page per routine, README.md, the index by task, ier.md, all codes, and python.md,
                                    the reference of the Python package
  docs/man/man3/*.3                 the same as man pages
  src/fortran/stripack_module.F90   their interfaces, from stripack_module.F90.in
  src/fortran/plain_forwarders.h    those of its routines that only call their C function: all that
                                    stripack_abi.F90 does not have itself
  src/cxx/capi/plain_calls.h        the C functions that these call
  src/fortran/stripack.h.in         their prototypes for C and C++; CMake fills in the types of each library
  src/fortran/stripack.pyf          the signatures of libstripack for f2py

The codes and their meanings come from PSTRIPACK_CODES in src/cxx/capi/pstripack.h.

  make-api.py           writes them
  make-api.py --check   fails if they are not what it would write, if the routines in stripack_abi.F90 have
                        other arguments than the table, or if a code has another name or value elsewhere
  make-api.py --examples LIBRARY   prints the examples for a library as subroutines that compile

Needs Python 3.11 and nothing else. The files are committed: building needs no Python.
"""
import argparse
import itertools
import re
import sys
import textwrap
import tomllib
from pathlib import Path

from python_page import python_page

ROOT = Path(__file__).resolve().parents[2]
LIBRARIES = ["stripack", "stripack_r4", "stripack_8arg", "stripack_i8"]
COMMON = "0-common.toml"
WHERE = ", ".join(f"lib{library}" for library in LIBRARIES)
NO_BREAK = "\u00a0"
NEW_CODES = "New: a code that the original does not have; one line on stderr says why."


class Argument:
    """One line of `arguments`: names that share type, shape, use and meaning."""

    def __init__(self, line, common_meaning):
        names, kind, self.use, self.meaning = columns(line, 4)
        self.names = names.split(", ")
        self.type, self.shape = re.fullmatch(r"(\w+)(?:\((.*)\))?", kind).groups()
        self.is_list = not self.meaning
        self.meaning = self.meaning or common_meaning[self.names[0]]

    def __str__(self):
        return f"{self.type}({self.shape})" if self.shape else self.type


class Routine:
    def __init__(self, name, entry, common):
        self.name = name
        self.purpose = entry.pop("purpose")
        self.details = entry.pop("details", [])
        self.arguments = [Argument(line, common["meaning"]) for line in lines(entry.pop("arguments"))]
        self.absent = {library: names.split(", ") for library, names in entry.pop("absent", {}).items()}
        self.lout = entry.pop("lout", False)
        self.ident = entry.pop("ident", False)
        self.result = columns(entry.pop("result"), 2) if "result" in entry else None
        self.ier_name = entry.pop("ier_name", "IER")
        self.ier = [columns(line, 3) for line in lines(entry.pop("ier", ""))]
        self.differs = entry.pop("differs", [])
        self.threads = entry.pop("threads", common["default"]["threads"])
        self.cost = entry.pop("cost")
        self.example = entry.pop("example").strip("\n")
        self.see = entry.pop("see")
        self.source = entry.pop("source", common["default"]["source"])
        self.has_default = {key: getattr(self, key) == text for key, text in common["default"].items()}
        if entry:
            sys.exit(f"{name}: unknown keys {', '.join(entry)}")

    def names(self, library=None):
        """The arguments in order, as the library has them."""
        absent = self.absent.get(library, [])
        return [name for argument in self.arguments for name in argument.names if name not in absent]

    def call(self, library=None):
        arguments = ", ".join(self.names(library)).lower()
        return f"{'result = ' if self.result else 'call '}{self.name.lower()}({arguments})"

    def synopsis(self):
        """Lines of code: the call, and those of libraries where it differs."""
        text = [fortran_line(self.call(), "")]
        for library in self.absent:
            text.append(f"{fortran_line(self.call(library), '')}    ! lib{library}")
        return "\n".join(text).split("\n")

    def has_new_codes(self):
        return any("(new)" in when for _, when, _ in self.ier)


def lines(text):
    return [line for line in text.split("\n") if line.strip()]


def columns(line, count):
    cells = [cell.strip() for cell in line.split("|")]
    if len(cells) != count:
        sys.exit(f"{len(cells)} columns, not {count}: {line}")
    return cells


def fortran_line(text, indent, width=110):
    """Breaks a statement or declaration at blanks into continued lines."""
    parts = textwrap.wrap(text, width - len(indent) - 2, subsequent_indent="    ", break_long_words=False)
    return " &\n".join(indent + part for part in parts)


def read_table():
    """The groups: pairs of a title and its routines."""
    files = sorted((ROOT / "docs/api/routines").glob("*.toml"))
    tables = {file.name: tomllib.loads(file.read_text()) for file in files}
    common = tables.pop(COMMON)
    groups = []
    for table in tables.values():
        title = table.pop("title")
        groups.append((title, [Routine(name, entry, common) for name, entry in table.items()]))
    known = {routine.name for _, routines in groups for routine in routines}
    for _, routines in groups:
        for routine in routines:
            for other in set(routine.see) - known:
                sys.exit(f"{routine.name}: see {other}, which is not in the table")
    return groups


# ---- Markdown ----


def markdown_paragraph(text):
    text = text.strip("\n")
    return text if text.startswith("```") else textwrap.fill(text, 120, break_long_words=False, break_on_hyphens=False)


def markdown_table(head, rows):
    def cell(text):
        return text.replace("|", "\\|")

    return "\n".join(["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)]
                     + ["| " + " | ".join(map(cell, row)) + " |" for row in rows])


def argument_rows(routine):
    """LIST, LPTR, LEND and LNEW, where they mean what they always mean, share a row."""
    rows = []
    for is_list, group in itertools.groupby(routine.arguments, lambda a: a.is_list and a.use):
        group = list(group)
        if is_list:
            names = ", ".join(name for a in group for name in a.names)
            rows.append([names, ", ".join(dict.fromkeys(map(str, group))), group[0].use, "the [lists](trmesh.md)"])
        else:
            rows += [[", ".join(a.names), str(a), a.use, a.meaning] for a in group]
    return rows


def markdown_page(routine):
    def link(name):
        return f"[{name}]({name.lower()}.md)"

    text = [f"# {routine.name}", routine.purpose,
            "```fortran\n" + "\n".join(routine.synopsis()) + "\n```"]
    text += map(markdown_paragraph, routine.details)
    text.append(markdown_table(["argument", "type", "use", "meaning"], argument_rows(routine)))
    if routine.result:
        text.append(markdown_paragraph(f"Result: {routine.result[0]}: {routine.result[1]}."))
    if routine.ier:
        text.append(markdown_table([routine.ier_name, "when", "arrays"], routine.ier))
    if routine.differs:
        text.append("**Differences from the original:**")
        text.append("\n".join(f"- {note}" for note in routine.differs))
    if not routine.has_default["threads"]:
        text.append(markdown_paragraph(f"**Ranks and threads:** {routine.threads}"))
    text.append(markdown_paragraph(f"**Cost:** {routine.cost}"))
    if routine.example != routine.call():  # else it stands above
        text.append(f"```fortran\n{routine.example}\n```")
    if routine.see:
        text.append("See also " + ", ".join(map(link, routine.see)) + ".")
    if not routine.has_default["source"]:
        text.append(f"Source: {routine.source}.")
    text.append("[Common to all routines](README.md)")
    return "\n\n".join(text) + "\n"


INDEX_HEAD = """# STRIPACK's routines

One page per routine, also installed as a man page (`man 3 trmesh`). Old Fortran codes call these symbols without
interfaces; `use stripack` provides interfaces. Reals, integers and logicals have the kinds of [the
library](../relink.md#1-your-line).

Unless a page says otherwise:

- All four libraries have the routine. Nodes and [slots](../glossary.md) count from 1; angles are in radians, lengths in
  units of the radius.
- Sizes are the smallest allowed; 6N-12 elements always suffice for LIST and LPTR. If *LIST, LPTR, LEND* share a row, LIST and
  LPTR have the first size, LEND the second. *in/out* is read and changed.
- No routine is collective: in an MPI program any number of ranks may call any number of times (TRMESH is collective on
  request). Any number of threads may call it at once with their own arrays.
- No routine ends the program. Only TRPRNT, TRLPRT and VORONOI_POLY_COUNT write to standard output, and EDGE and DELNOD
  with some of their codes. A [code](ier.md) marked *new*, which the original does not have, also prints one line on
  stderr that says why.
- The source is R. J. Renka, "Algorithm 772: STRIPACK", ACM Transactions on Mathematical Software 23 (1997) 416-434."""

INDEX_TAIL = """## Not in these libraries

- SSRFPACK (interpolation, Algorithm 773), which some copies of STRIPACK contain: keep yours. It calls STRIPACK's symbols
  and works on these lists.

## Helpers of the Fortran 90 text

Programs for that text also call unrelated routines of the same file. They are in the archive `libstripack_f90.a`, linked
before the library: `$(pstripack-config --abi f90,r8 --libs)`, `pkg-config --libs stripack_f90 stripack`, or the CMake
target `pstripack::stripack_f90`. Each is a separate object, so a routine of the same name in your program replaces it.

| routine | what it does |
| --- | --- |
| `call timestamp()` | prints date and time on standard output: `31 May 2001   9:45:54.872 AM` |
| `arc_cosine(c)` | arc cosine, real(8); arguments beyond -1 and 1 count as -1 and 1 |
| `d_pi()`, `r_pi()` | pi, real(8) and real(4) |
| `call d3vec_normalize(n, x, y, z)`, `call r83vec_normalize(n, x, y, z)` | scales n vectors, real(8), to length 1, in place; zero vectors stay |

Reals are real(8), as in that text, except `r_pi`. `n` may be a 4-byte integer; on little-endian machines also an 8-byte one.
A program in single precision keeps its own `arc_cosine` and `r83vec_normalize`.

## How these pages are made

`docs/api/make-api.py` makes these pages, the man pages, the module `stripack` and the list of symbols from the table
`docs/api/routines/*.toml`. Edit the table, run the script, commit all; a test compares."""


def markdown_index(groups):
    text = [INDEX_HEAD]
    for title, routines in groups:
        text.append(f"## {title}")
        text.append(markdown_table(["routine", "purpose"],
                                   [[f"[{r.name}]({r.name.lower()}.md)", r.purpose] for r in routines]))
    return "\n\n".join(text + [INDEX_TAIL]) + "\n"


# ---- the codes ----


def codes():
    """Of PSTRIPACK_CODES: value -> name and meaning."""
    header = (ROOT / "src/cxx/capi/pstripack.h").read_text()
    entries = re.findall(r'CODE\((PSTRIPACK_\w+), (-?\d+),[\s\\]*((?:"[^"]*"[\s\\\\]*)+)\)', header)
    return {value: (name, "".join(re.findall(r'"([^"]*)"', text))) for name, value, text in entries}


def wrong_codes(groups):
    """Names with other values than in PSTRIPACK_CODES, and new codes of routines that are not there."""
    values = {name: value for value, (name, _) in codes().items()}
    found = []
    for path, pattern in [("src/fortran/pstripack.f90", r"\b(pstripack_\w+) += (-\d+)"),
                          ("src/fortran/pstripack_mpi.f90", r"\b(pstripack_\w+) += (-\d+)")]:
        for match in re.finditer(pattern, (ROOT / path).read_text(), re.MULTILINE):
            name, value = sorted(map(str.strip, match.groups()), reverse=True)
            if values.get(name.upper().replace("_SCVT_", "_"), value) != value:
                found.append(f"{path}: {name} is not {value} in PSTRIPACK_CODES of pstripack.h")
    return found + [f"{r.name}: {value} is new, and not in PSTRIPACK_CODES of pstripack.h" for _, routines in groups
                    for r in routines for value, when, _ in r.ier if "(new)" in when and value not in codes()]


IER_HEAD = """# Codes: what they mean, what to do

0 is success. -1, -2 and numbers above 0 are STRIPACK's own codes; only EDGE and DELNOD print a message with some.
The others are *new*: STRIPACK's routines also print one line on stderr with the reason. Each routine's page gives the
state of its arrays; after a negative code of TRMESH they are unchanged. Only OpenMP's run-time library may end your
program, if it gets no memory.

A number below -2 has one meaning everywhere, which `pstripack_strerror` returns. -1 and -2 depend on the routine
([below](#stripacks-own-codes)); the table gives those of our own calls:"""

IER_MIDDLE = """**L > 0 of TRMESH**: drop one of the two nodes. Often every column of a grid repeats the pole, or a
meridian stands at 0 and at 360 degrees.

**Distributed meshes.** Every rank gets the same code; after `triangulate` and `scvt` the mesh is then empty. Rank 0
prints the line; `home`, `exchange_end`, and calls where MPI must not be called print on their rank.
`mesh%error_points` returns the points of -5, -9, -10 and -13.

**Centroidal tessellations** return [a message](../scvt-interface.md#errors) and print nothing.

## STRIPACK's own codes

New codes of a routine are on its page."""


def markdown_ier(groups):
    remedies = tomllib.loads((ROOT / "docs/api/routines" / COMMON).read_text())["remedy"]
    meanings = [[value, name, meaning, remedies.pop(value, "")] for value, (name, meaning) in codes().items()]
    if remedies:
        sys.exit(f"{COMMON}: no code {', '.join(remedies)}")
    rows = [[f"[{r.name}]({r.name.lower()}.md)" + (f" {r.ier_name}" if r.ier_name != "IER" else ""), value, when]
            for _, routines in groups for r in routines for value, when, _ in r.ier
            if value != "0" and not when.endswith("(new)")]
    return "\n\n".join([IER_HEAD, markdown_table(["code", "name in C; in Fortran except -15, -16", "meaning", "what to do, and more"], meanings),
                        IER_MIDDLE, markdown_table(["routine", "IER", "when"], rows)]) + "\n"


# ---- man pages ----

MADE_HERE = '.\\" Made by docs/api/make-api.py'


def troff(text):
    """A piece of a line: no character of it is taken for a request or an escape."""
    for character, escape in ("\\", "\\e"), ("-", "\\-"), ("^", "\\(ha"), ("~", "\\(ti"), ("'", "\\(aq"):
        text = text.replace(character, escape)
    return re.sub(r"`([^`]*)`", r"\\fB\1\\fP", text)


def troff_lines(text):
    return [("\\&" if line.startswith((".", "'")) else "") + line for line in map(troff, text.split("\n"))]


def troff_paragraph(text):
    text = text.strip("\n")
    if text.startswith("```"):
        return troff_code(text.strip("`\n").split("\n"))
    return [".PP"] + troff_lines(" ".join(text.split()))


def troff_code(code):
    return [".PP", ".nf"] + [line for text in code for line in troff_lines(text)] + [".fi"]


def man_page(routine):
    purpose = routine.purpose[0].lower() + routine.purpose[1:].rstrip(".")
    page = [MADE_HERE, f'.TH {routine.name} 3 "" PSTRIPACK STRIPACK',
            ".SH NAME", f"{routine.name.lower()} \\- {troff(purpose)}",
            ".SH LIBRARY", troff(WHERE), ".SH SYNOPSIS"] + troff_code(routine.synopsis())[1:]
    if routine.details:
        page.append(".SH DESCRIPTION")
        for paragraph in routine.details:
            page += troff_paragraph(paragraph)
    page.append(".SH ARGUMENTS")
    for argument in routine.arguments:
        page += [".TP", f".B {troff(', '.join(argument.names))}",
                 *troff_lines(f"{argument}, {argument.use}: {argument.meaning}")]
    if routine.result:
        page += [".SH RESULT", *troff_lines(f"{routine.result[0]}: {routine.result[1]}")]
    if routine.ier:
        page.append(f".SH {routine.ier_name}")
        for value, when, state in routine.ier:
            page += [".TP", f".B {troff(value)}", *troff_lines(when + (f" (arrays: {state})" if state else ""))]
        if routine.has_new_codes():
            page += [".PP", NEW_CODES]
    for head, paragraphs in (("DIFFERENCES FROM THE ORIGINAL", routine.differs), ("RANKS AND THREADS", [routine.threads]),
                             ("COST", [routine.cost])):
        if paragraphs:
            page.append(f".SH {head}")
            page += [line for paragraph in paragraphs for line in troff_paragraph(paragraph)]
    page += [".SH EXAMPLE"] + troff_code(routine.example.split("\n"))[1:]
    if routine.see:
        page += [".SH SEE ALSO", ", ".join(f"\\fB{name.lower()}\\fP(3)" for name in routine.see)]
    page += [".SH SOURCE", *troff_lines(routine.source)]
    return "\n".join(page) + "\n"


# ---- the module ----


def declared(name, shape, known):
    """The dummy argument: sizes that are numbers or N, K, KK among the arguments, else assumed."""
    if shape is None:
        return name.lower()
    *first, last = shape.split(",")
    last = last if last.isdigit() or (last in ("N", "K", "KK") and last in known) else "*"
    return f"{name.lower()}({', '.join([*first, last]).lower()})"


KINDS = {"integer": "integer", "real": "real(STRIPACK_REAL_KIND)", "logical": "logical",
         "character": "character(len=*)"}


def interface(routine, library):
    names = routine.names(library)
    kind = routine.result and routine.result[0]
    head = {None: "subroutine", "real": "function"}.get(kind, f"{kind} function")
    text = [fortran_line(f"{head} {routine.name.lower()}({', '.join(names).lower()})", "    ")]
    for type_ in KINDS:
        dummies = [declared(name, None if type_ == "character" else argument.shape, names)
                   for argument in routine.arguments if argument.type == type_
                   for name in argument.names if name in names and not (routine.lout and name == "LOUT")]
        if kind == type_ == "real":
            dummies.append(routine.name.lower())
        if dummies:
            text.append(fortran_line(f"{KINDS[type_]} :: {', '.join(dummies)}", "      "))
    if routine.lout:
        text.append("      integer, optional :: lout")
    return "\n".join(text + [f"    end {'function' if kind else 'subroutine'}"])


def module_comment(routine):
    about = [routine.purpose] + [" ".join(text.split()) for text in routine.details if "```" not in text]
    hanging = len(about)
    if routine.result:
        about.append(f"Result  {routine.result[1]}.")
    if routine.ier:
        cases = [f"{value} ".replace(" ", NO_BREAK) + when for value, when, _ in routine.ier]
        about.append(f"{routine.ier_name}  {'; '.join(cases)}.")
    return "\n".join(textwrap.fill(part, 110, initial_indent="    ! ", break_on_hyphens=False,
                                   subsequent_indent="    ! " if i < hanging else "    !      ")
                     for i, part in enumerate(about)).replace(NO_BREAK, " ")


def module_entry(routine):
    comment = module_comment(routine)
    if routine.absent:
        return (f"{comment}\n#ifdef STRIPACK_8_ARGUMENTS\n{interface(routine, 'stripack_8arg')}\n#else\n"
                f"{interface(routine, None)}\n#endif")
    return f"{comment}\n{interface(routine, None)}"


def module_text(groups):
    entries = [module_entry(routine) for _, routines in groups for routine in routines]
    template = (ROOT / "src/fortran/stripack_module.F90.in").read_text()
    return template.replace("@INTERFACES@", "\n\n".join(entries))


# ---- the forwarders ----

ABI = ROOT / "src/fortran/stripack_abi.F90"
FORWARDERS = """// Made by docs/api/make-api.py. The symbols of libstripack* that only call their C function. Compiled once for each
// routine of each library: see stripack_abi.F90.
// clang-format off

#include "capi/plain_calls.h"

#if STRIPACK_INTEGER_BYTES == 8
#define OF_INTEGER(name) name##_i8
#define OF_REAL(name) name##_i8
#elif STRIPACK_REAL_BYTES == 8
#define OF_INTEGER(name) name##_i4
#define OF_REAL(name) name##_r8
#else
#define OF_INTEGER(name) name##_i4
#define OF_REAL(name) name##_r4
#endif

#define IDENT(routine) \\
  static const volatile char ident[] = "@(#)PSTRIPACK " STRIPACK_LIBRARY " " routine; \\
  if (ident[0] != '@') return

#pragma GCC visibility push(default)
#include "stripack.h"

using Int = stripack_integer;
using Real = stripack_real;

{}

#pragma GCC visibility pop
"""


def forwarder(routine):
    """The symbol. C functions get scalars that they do not change by value."""
    name, of = routine.name.lower(), "OF_REAL" if has_reals(routine) else "OF_INTEGER"
    arguments = ", ".join(("*" if a.use == "in" and not a.shape else "") + name.lower()
                          for a in routine.arguments for name in a.names)
    call = f"{'return ' if routine.result else ''}{of}(pstripack_{name})({arguments});"
    head = re.sub(r"\s+", " ", prototype(routine)[:-1]).replace("stripack_integer", "Int")
    head = head.replace("stripack_logical", "Int").replace("stripack_real", "Real") + " {"
    head = re.sub(r"(const )?\w+\* ", lambda match: match[0].replace(" ", NO_BREAK), head)
    return "\n".join([f"#ifdef STRIPACK_{routine.name}",
                      textwrap.fill(head, 110, subsequent_indent="    ").replace(NO_BREAK, " "),
                      *[f'  IDENT("{routine.name}");'] * routine.ident,
                      textwrap.fill(call, 110, initial_indent="  ", subsequent_indent="      "), "}", "#endif"])


def has_reals(routine):
    """Whether the kind of reals tells its C function: by its arguments, or by its arithmetic."""
    return "real" in [a.type for a in routine.arguments] or routine.name == "JRAND"


def declaration_in_c(routine):
    """Of the C function, in a macro of its kinds."""
    of_c = {"integer": "Int", "logical": "Int", "real": "Real"}
    arguments = [(("const " if a.use == "in" and a.shape else "") + of_c[a.type]
                  + (" " if a.use == "in" and not a.shape else "* ") + name.lower()).replace(" ", NO_BREAK)
                 for a in routine.arguments for name in a.names]
    text = textwrap.fill(f"{of_c[routine.result[0]] if routine.result else 'void'} pstripack_"
                         f"{routine.name.lower()}_##suffix({', '.join(arguments)}) noexcept;",
                         108, initial_indent="  ", subsequent_indent="      ")
    return text.replace("\n", " \\\n").replace(NO_BREAK, " ")


PLAIN_CALLS = """#pragma once
// Made by docs/api/make-api.py. The C functions that src/fortran/plain_forwarders.h calls.
// clang-format off

#include <cstdint>

#pragma GCC visibility push(default)
extern "C" {{

#define LIST_CALLS(Int, suffix) \\
{}
LIST_CALLS(int32_t, i4)
LIST_CALLS(int64_t, i8)
#undef LIST_CALLS

#define NODE_CALLS(Real, Int, suffix) \\
{}
NODE_CALLS(float, int32_t, r4)
NODE_CALLS(double, int32_t, r8)
NODE_CALLS(double, int64_t, i8)
#undef NODE_CALLS

}}
#pragma GCC visibility pop
"""


def plain_files(routines):
    """Of the routines that stripack_abi.F90 does not have itself."""
    written = set(re.findall(r"^#ifdef STRIPACK_(\w+)$", ABI.read_text(), re.MULTILINE))
    plain = [routine for routine in routines if routine.name not in written]
    return {"src/fortran/plain_forwarders.h": FORWARDERS.format("\n\n".join(map(forwarder, plain))),
            "src/cxx/capi/plain_calls.h": PLAIN_CALLS.format(
                *(" \\\n".join(declaration_in_c(routine) for routine in plain if has_reals(routine) == reals)
                  for reals in (False, True)))}


# ---- C, C++, f2py ----

C_TYPES = {"integer": "stripack_integer", "real": "stripack_real", "logical": "stripack_logical", "character": "char"}
C_HEADER = """/* STRIPACK's symbols in lib@name@, for C and C++. Made by docs/api/make-api.py.
 *
 * Each library has its own stripack.h, which `pkg-config --cflags @name@` finds. All arguments are addresses. Arrays
 * begin with element 0; node numbers and slots count from 1. Arguments: man 3 trmesh etc., or docs/api. */
#ifndef STRIPACK_H
#define STRIPACK_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {{
#endif

typedef @c_real@ stripack_real;
typedef @c_integer@ stripack_integer;
typedef stripack_integer stripack_logical; /* 0: .FALSE., 1: .TRUE. */

{}

#ifdef __cplusplus
}}
#endif
#endif
"""


def prototype(routine, library=None):
    """Of the Fortran symbol; the length of a string is a hidden last argument."""
    present = routine.names(library)
    pairs = [(a, name) for a in routine.arguments for name in a.names if name in present]
    arguments = [("const " if a.use == "in" else "") + f"{C_TYPES[a.type]}* {name.lower()}" for a, name in pairs]
    arguments += [f"size_t length_of_{name.lower()}" for a, name in pairs if a.type == "character"]
    result = C_TYPES[routine.result[0]] if routine.result else "void"
    text = f"{result} {routine.name.lower()}_({', '.join(a.replace(' ', NO_BREAK) for a in arguments)});"
    return textwrap.fill(text, 110, subsequent_indent="    ").replace(NO_BREAK, " ")


def c_header(routines):
    text = []
    for r in routines:
        comment = f"/* {r.purpose}{' LOUT may be NULL.' if r.lout else ''} */"
        choice = (f"#if @eight@ /* 8 arguments */\n{prototype(r, 'stripack_8arg')}\n#else\n{prototype(r)}\n#endif"
                  if r.absent else prototype(r))
        text.append(f"{comment}\n{choice}")
    return C_HEADER.format("\n\n".join(text))


PYF_TYPES = {"integer": "integer", "real": "real*8", "logical": "logical", "character": "character*(*)"}
PYF_USES = {"in": "in", "out": "out", "in/out": "in,out,copy", "unused": "hide"}


def signature(routine):
    """For f2py, which makes sizes of arrays that are read optional. Output, in arrays of the largest size, comes back as
    a tuple."""
    kind = routine.result and routine.result[0]
    call = f"{routine.name.lower()}({', '.join(routine.names()).lower()})"
    names = {name.lower() for a in routine.arguments if not a.shape for name in a.names}
    known_afterwards = {name.lower(): {"NT": "2n-4", "NB": "n"}[name] for a in routine.arguments if a.use == "out"
                        for name in a.names if name in ("NT", "NB")}
    text = [f"{PYF_TYPES[kind]} function {call}" if kind else f"subroutine {call}"]
    if kind:
        text.append(f"  {PYF_TYPES[kind]} :: {routine.name.lower()}")
    for argument in routine.arguments:
        uses = f"intent({PYF_USES[argument.use]})"
        for name in map(str.lower, argument.names):
            shape = "" if argument.type == "character" else (argument.shape or "").lower()
            if argument.use == "out":
                for size, largest in known_afterwards.items():
                    shape = re.sub(rf"\b{size}\b", largest, shape)
                shape = re.sub(r"(\d)n", r"\1*n", shape.replace(">=", ""))
            elif shape and (">=" in shape or not set(re.findall("[a-z]+", shape)) <= names):
                shape = "1" if shape == "any" else "*"
            if routine.lout and name == "lout":
                text.append("  integer, optional, intent(in) :: lout = 6")
            else:
                text.append(f"  {PYF_TYPES[argument.type]}, {uses}" + (f", dimension({shape})" * bool(shape)) + f" :: {name}")
    return "\n".join(text + [f"end {'function' if kind else 'subroutine'}"])


def pyf(routines):
    interfaces = "\n\n".join(textwrap.indent(signature(r), "    ") for r in routines)
    return ("! Signatures of libstripack for f2py: docs/python.md. Made by docs/api/make-api.py.\n"
            f"python module stripack\n  interface\n{interfaces}\n  end interface\nend python module\n")


# ---- all files ----


def make_all(groups):
    """The files by their path from ROOT."""
    routines = [routine for _, members in groups for routine in members]
    files = {"docs/api/README.md": markdown_index(groups), "docs/api/ier.md": markdown_ier(groups),
             "docs/api/python.md": python_page(ROOT),
             "src/fortran/stripack_module.F90": module_text(groups),
             "src/fortran/stripack.h.in": c_header(routines), "src/fortran/stripack.pyf": pyf(routines),
             **plain_files(routines)}
    for routine in routines:
        files[f"docs/api/{routine.name.lower()}.md"] = markdown_page(routine)
        files[f"docs/man/man3/{routine.name.lower()}.3"] = man_page(routine)
    return files


def stale(files):
    """The paths that are not as they would be written, or would not be there."""
    there = set(ROOT.glob("docs/api/*.md"))
    there |= {path for path in ROOT.glob("docs/man/man3/*") if path.read_text().startswith(MADE_HERE)}
    there = {path.relative_to(ROOT).as_posix() for path in there}
    return sorted(path for path in there | files.keys()
                  if path not in files or not (ROOT / path).exists() or (ROOT / path).read_text() != files[path])


def wrong_signatures(groups):
    """Routines of stripack_abi.F90 whose arguments are not the table's."""
    expected = {r.name.lower(): [",".join(r.names(x)).lower() for x in LIBRARIES] for _, rs in groups for r in rs}
    text = re.sub(r"&\s*", "", ABI.read_text())
    found = re.findall(r"^recursive .*?\b(?:subroutine|function) (\w+)\(([^)]*)\)", text, re.MULTILINE)
    return [name for name, arguments in found
            if arguments.replace(" ", "") not in expected.get(name, [])]


EXAMPLE = """subroutine example_{name}
  use stripack
  implicit real(8) (a-h, o-z)
  integer, dimension(100) :: list, lptr, lend, listc, near, next, nodes, npts, listv
  integer :: ltri(6, 20), corners(3, 20), columns(6, 20), iwk(2, 20)
  real(8), dimension(100) :: x, y, z, xc, yc, zc, rc, xv, yv, zv, rlat, rlon, dist, triarea, f, value
  real(8), dimension(3) :: p, p1, p2, cn, c, v1, v2, v3
  real(8) :: q(3, 100)
{example}
end subroutine
"""


def print_examples(groups, library):
    for _, routines in groups:
        for routine in routines:
            if library not in routine.absent:
                print(EXAMPLE.format(name=routine.name.lower(), example=textwrap.indent(routine.example, "  ")))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing, exit with 1 if something is not up to date")
    parser.add_argument("--examples", metavar="LIBRARY", choices=LIBRARIES, help="print them for a compiler")
    arguments = parser.parse_args()
    groups = read_table()
    if arguments.examples:
        return print_examples(groups, arguments.examples)
    files = make_all(groups)
    if arguments.check:
        problems = [f"not up to date, run docs/api/make-api.py: {path}" for path in stale(files)]
        problems += [f"stripack_abi.F90: arguments of {name} are not the table's" for name in wrong_signatures(groups)]
        problems += wrong_codes(groups)
        print("\n".join(problems) or f"{len(files)} files are up to date")
        sys.exit(1 if problems else 0)
    for path in set(stale(files)) & files.keys():  # others keep their time: nothing is compiled again
        (ROOT / path).parent.mkdir(parents=True, exist_ok=True)
        (ROOT / path).write_text(files[path])


if __name__ == "__main__":
    main()
