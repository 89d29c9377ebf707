#!/usr/bin/env python3
"""Compiles the Fortran and C blocks of the documents, those of a page as one program.

  compile_snippets.py SOURCE WORK_DIR FORTRAN C

FORTRAN and C: compilers with their options, which find the modules and headers. A page may leave undeclared only what
CONTEXT declares. The examples of docs/api are compiled by tests/fortran.
"""
import re
import shlex
import subprocess
import sys
from pathlib import Path

ARGUMENTS = """integer :: n, lnew, ier
real(8), allocatable :: x(:), y(:), z(:), dist(:)
integer, allocatable :: list(:), lptr(:), lend(:), near(:), next(:)
"""
OF_RANKS = """integer :: comm
real(8), allocatable :: xyz(:,:)
integer(8), allocatable :: number(:)
"""
CONTEXT = {
    "modes.md": ARGUMENTS + OF_RANKS,
    "comparison.md": ARGUMENTS,
    "scvt-interface.md": ARGUMENTS + OF_RANKS + """real(8) :: cells, energy
real(8), allocatable :: xc(:), yc(:), zc(:), mass(:)
character(80) :: message
procedure(pstripack_density) :: width
procedure(pstripack_progress) :: progress
""",
}
BEFORE_PROGRAM = {"changed.md": """module copy
  type :: mpl_type
  contains
    procedure, nopass :: abort
  end type
contains
  subroutine abort(routine, code)
    character(*), intent(in) :: routine
    integer, intent(in) :: code
    print *, routine, code
  end subroutine
end module
"""}
USES = {"changed.md": ["use copy"]}
C_CONTEXT = {"relink.md": """#include <stripack.h>
static stripack_integer n, *list, *lptr, *lend, lnew, *near, *next, ier;
static stripack_real *x, *y, *z, *dist;
""", "scvt-interface.md": """#include <pstripack_mpi.h>
static double *x, *y, *z, *xyz, cells;
static int32_t n, ier;
static int64_t* number;
static int my_data;
static char message[80];
static MPI_Comm comm;
static pstripack_mesh* mesh;
extern void my_density(int32_t n, const double* xyz, double* values, void* user);
extern void my_width(int32_t n, const double* xyz, double* values, void* user);
"""}


def names_in(declaration):
    return re.findall(r"\w+", re.sub(r"\([^)]*\)", "", declaration.split("::")[1].split("!")[0]))


def fortran_program(page, texts):
    uses, declarations, statements, procedures = USES.get(page, []) + ["use, intrinsic :: iso_c_binding"], [], [], []
    for text in texts:
        lines = [line for line in text.split("\n") if line.strip() not in ("", "...")]
        procedure = re.match(r"subroutine (\w+)", lines[0])
        if procedure:
            procedures += lines + ([] if lines[-1].startswith("end") else [f"end subroutine {procedure[1]}"])
            continue
        for line in lines:
            if line.startswith("use "):
                uses.append(line)
            elif re.match(r"(type|integer|real)\b.*::", line):
                declarations.append(line)
            else:
                statements.append(line)
    declared = {name for line in declarations for name in names_in(line)}
    for line in CONTEXT.get(page, "").splitlines():
        kind, names = line.split(" :: ")
        left = [name for name in re.findall(r"\w+(?:\([:,]*\))?", names) if name.split("(")[0] not in declared]
        if left:
            declarations.append(f"{kind} :: {', '.join(left)}")
    return BEFORE_PROGRAM.get(page, "") + "\n".join(
        ["program page", *dict.fromkeys(uses), "implicit none", *dict.fromkeys(declarations), *statements, "contains",
         *procedures, "end program page", ""])


def c_program(page, texts):
    """Declarations of functions and directives as they are; all else in a function."""
    outside = [text for text in texts if text.startswith(("void ", "#"))]
    inside = [text for text in texts if text not in outside]
    return "\n".join(["#include <stdint.h>", C_CONTEXT.get(page, ""), *outside, "void page(void);", "void page(void) {",
                      *inside, "}", ""])


def main():
    source, work = Path(sys.argv[1]), Path(sys.argv[2])
    work.mkdir(exist_ok=True)
    (work / "copy.c").write_text("static int trmesh_(void) { return 0; }\n")  # of changed.md
    count, failed = 0, []
    for page in [source / "README.md", *sorted((source / "docs").rglob("*.md"))]:
        if page.parent.name == "api":
            continue
        for language, suffix, program, compiler in (("fortran", "f90", fortran_program, sys.argv[3]),
                                                    ("c", "c", c_program, sys.argv[4])):
            texts = re.findall(rf"^```{language}\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)
            if texts:
                file = work / f"{page.stem}.{suffix}"
                file.write_text(program(page.name, texts))
                done = subprocess.run([*shlex.split(compiler), "-fsyntax-only", file.name], cwd=work, text=True,
                                      capture_output=True)
                count += len(texts)
                if done.returncode != 0:
                    failed.append(f"{page}\n{done.stderr}")
    print(f"{count} blocks", *failed, sep="\n")
    sys.exit(1 if failed or not count else 0)


main()
