#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fail unless each code block of a document under a line `<!-- source: FILE -->` is that file, but for its
SPDX line: the examples that people read are those that the tests run. ctest: lint.sources."""
import pathlib
import re
import sys

BLOCK = re.compile(r"^<!-- source: (\S+) -->\n```\w*\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def problems(root: pathlib.Path):
    for document in (root / "README.md", *sorted((root / "docs").glob("*.md"))):
        text = document.read_text()
        here = document.relative_to(root).as_posix()
        blocks = BLOCK.findall(text)
        if len(blocks) != text.count("<!-- source:"):
            yield f"{here}: a line <!-- source: FILE --> without a code block under it"
        for name, block in blocks:
            lines = (root / name).read_text().splitlines(keepends=True)
            if "".join(line for line in lines if "SPDX-License-Identifier" not in line) != block:
                yield f"{here}: the block is no longer {name}"


found = list(problems(pathlib.Path(sys.argv[1])))
print("\n".join(found) or "sources: ok")
sys.exit(1 if found else 0)
