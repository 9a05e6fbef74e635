#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fail unless every @cite key of the sources is in src/bibliography.bib, once and with the fields that
find the work, and every work there is cited. ctest runs it as lint.citations."""
import pathlib
import re
import sys

CITE = re.compile(r"@cite\s+(\w+)")
ENTRY = re.compile(r"^@(\w+)\{(\w+),(.*?)^\}", re.MULTILINE | re.DOTALL)
FIELD = re.compile(r"^\s*(\w+) = ", re.MULTILINE)
WANTED = {  # Kind of work -> fields that it needs beside author, title and year
    "article": {"journal", "volume", "pages", "doi"},
    "book": {"publisher"},
    "inproceedings": {"booktitle", "pages", "doi"},
}


def citations(root: pathlib.Path):
    """(key, file and line) of each @cite."""
    for top in ("include", "src", "pipeline"):
        for file in sorted(root.glob(f"{top}/**/*.[ch]pp")):
            for number, line in enumerate(file.read_text().splitlines(), 1):
                for key in CITE.findall(line):
                    yield key, f"{file.relative_to(root).as_posix()}:{number}"


def problems(root: pathlib.Path):
    text = (root / "src/bibliography.bib").read_text()
    entries = ENTRY.findall(text)
    keys = [key for _, key, _ in entries]
    if len(entries) != text.count("@"):
        yield "src/bibliography.bib: an entry does not have the form @kind{key, … } with } in column 0"
    for kind, key, fields in entries:
        missing = {"author", "title", "year"} | WANTED.get(kind, set())
        missing -= set(FIELD.findall(fields))
        if kind not in WANTED:
            yield f"src/bibliography.bib: {key}: unknown kind of work '{kind}'"
        if missing:
            yield f"src/bibliography.bib: {key}: without {', '.join(sorted(missing))}"
        if keys.count(key) > 1:
            yield f"src/bibliography.bib: {key}: stands {keys.count(key)} times"
    cited = set()
    for key, where in citations(root):
        cited.add(key)
        if key not in keys:
            yield f"{where}: @cite {key} is not in src/bibliography.bib"
    for key in sorted(set(keys) - cited):
        yield f"src/bibliography.bib: {key} is cited nowhere"


found = list(problems(pathlib.Path(sys.argv[1])))
print("\n".join(found) or "citations: ok")
sys.exit(1 if found else 0)
