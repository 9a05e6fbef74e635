#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fail unless each relative link of a page leads to a file of the repository, and each #place in it to a
heading of that page. ctest runs it as lint.links."""
import pathlib
import re
import sys

FOLDERS = ("", "configs", "docs", "outputs", "pipeline", "tests/bench", "tests/bench/pages")
TEMPLATES = "tests/bench/pages"  # Their links are those of the pages in docs that are made of them.
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ (.+)$", re.MULTILINE)
CODE = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)


def places(page: pathlib.Path):
    """The anchors that GitHub gives the headings of a page."""
    headings = HEADING.findall(CODE.sub("", page.read_text()))
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def links(page: pathlib.Path):
    """(number of the line, link) of all links to this repository."""
    for number, line in enumerate(page.read_text().splitlines(), 1):
        for link in LINK.findall(line):
            if "://" not in link and not link.startswith("mailto:"):
                yield number, link


def problems(root: pathlib.Path):
    for folder in FOLDERS:
        for page in sorted((root / folder).glob("*.md")):
            here = page.relative_to(root).as_posix()
            start = root / "docs" / page.name if folder == TEMPLATES else page
            for number, link in links(page):
                file, _, place = link.partition("#")
                target = (start.parent / file).resolve() if file else start
                if not target.exists():
                    yield f"{here}:{number}: {file} does not exist"
                elif place and place not in places(target):
                    yield f"{here}:{number}: {link}: no such heading"


root = pathlib.Path(sys.argv[1]).resolve()
found = list(problems(root))
print("\n".join(found) or "links: ok")
sys.exit(1 if found else 0)
