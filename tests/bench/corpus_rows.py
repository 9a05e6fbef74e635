# SPDX-License-Identifier: BSD-3-Clause
"""Rows for the page of benchmarks from the tables of tests/corpus: a row a version of NETGEN and source of
files. The tables stay what counts; make_pages keeps results/corpus.json like them."""
import pathlib
import statistics
import sys

from bench_data import ROOT

CORPUS = ROOT / "tests" / "corpus"
NO_MESH = ("failed", "refused", "slow", "crashed", "invalid")
NAMES = {"repository": "our own", "hard_models": "made by us, each with a difficulty",
         "random_models": "random, made by us"}
GOOD_ANGLE = 10.0  # Degrees.


def row_of(version, source, found):
    meshes = [row for row in found if row.angle is not None]
    outcomes = [row.outcome for row in found]
    return {"netgen": version, "source": NAMES.get(source, f"`{source}`"), "files": len(found),
            "ok": outcomes.count("ok"), "degraded": outcomes.count("degraded"),
            "none": sum(outcomes.count(outcome) for outcome in NO_MESH), "tets": sum(row.tets for row in meshes),
            "good": sum(row.angle >= GOOD_ANGLE for row in meshes),
            "angle": statistics.median(row.angle for row in meshes) if meshes else None,
            "p01": statistics.median(row.p01 for row in meshes) if meshes else None}


def corpus_rows(folder=CORPUS):
    sys.path.insert(0, str(folder))
    from corpus_files import parse_list
    from corpus_table import read_table

    entries = parse_list((folder / "files.txt").read_text())
    rows = []
    for table in sorted(pathlib.Path(folder).glob("netgen-*.tsv")):
        version, known = table.stem.partition("-")[2], read_table(table)
        for source in dict.fromkeys(entry.source for entry in entries):
            found = [known[entry.name] for entry in entries if entry.source == source and entry.name in known]
            rows += [row_of(version, source, found)] if found else []
    return rows
