# SPDX-License-Identifier: BSD-3-Clause
"""The table of what is known of each file of the corpus, and whether a run is worse than that.

A table is a file `netgen-VERSION.tsv`, with a row a file, sorted by name. Figures are rounded to four
digits, so that a new table differs from the old one where a mesh does. CPU time is in units of the
reference job of the same run: so it hardly depends on the machine.
"""
import dataclasses
import pathlib

OUTCOMES = ("ok", "degraded", "failed", "refused", "slow", "crashed", "invalid")  # The later the worse.
COLUMNS = ("name", "outcome", "tets", "G", "angle", "p01", "cpu")
MOST_LOST = 0.02  # Of G and of the 1st percentile.
LEAST_ANGLE = 0.95  # Of the angle before.
MOST_CPU = 1.5  # Of the CPU time before, and
MOST_MORE_S = 2.0  # seconds of CPU time more: both together are too much.
SAME_CPU = 1.25  # A new table keeps the old CPU time if the new one is within this factor,
SAME_CPU_S = 0.5  # or within so many seconds.


@dataclasses.dataclass(frozen=True)
class Row:
    """What is known of a file. The figures of a mesh are None where there is none; `cpu` is in reference jobs."""

    name: str
    outcome: str
    tets: int | None
    G: float | None
    angle: float | None
    p01: float | None
    cpu: float


@dataclasses.dataclass(frozen=True)
class Finding:
    """A figure of a file that is worse than before, or an outcome that is better."""

    name: str
    figure: str
    before: object
    now: object

    def __str__(self):
        return f"{self.name}: {self.figure} {shown(self.before)} before, {shown(self.now)} now"


def shown(value):
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def rank_of(outcome):
    return OUTCOMES.index(outcome)


def judge_outcome(before, now):
    """What is worse of the outcome alone: a list."""
    is_worse = rank_of(now.outcome) > rank_of(before.outcome)
    return [Finding(now.name, "outcome", before.outcome, now.outcome)] if is_worse else []


def judge_mesh(before, now):
    """What is worse of two meshes: a list. Nothing where one of the runs has none."""
    if before.tets is None or now.tets is None:
        return []
    is_worse = {
        "G": now.G > (1.0 + MOST_LOST) * before.G,
        "1st percentile": now.p01 < (1.0 - MOST_LOST) * before.p01,
        "smallest angle": now.angle < LEAST_ANGLE * before.angle,
    }
    figures = {"G": "G", "1st percentile": "p01", "smallest angle": "angle"}
    return [Finding(now.name, figure, getattr(before, figures[figure]), getattr(now, figures[figure]))
            for figure, is_so in is_worse.items() if is_so]


def judge_cpu(before, now, reference_s):
    """Whether it takes too long, if the reference job takes `reference_s`: a list."""
    is_worse = now.cpu > MOST_CPU * before.cpu and (now.cpu - before.cpu) * reference_s > MOST_MORE_S
    return [Finding(now.name, "CPU seconds", before.cpu * reference_s, now.cpu * reference_s)] if is_worse else []


def judge(before, now, reference_s):
    """All that is worse of one file."""
    return [*judge_outcome(before, now), *judge_mesh(before, now), *judge_cpu(before, now, reference_s)]


def better_outcomes(table, rows):
    """What a new table should have."""
    return [Finding(row.name, "outcome", table[row.name].outcome, row.outcome) for row in rows
            if row.name in table and rank_of(row.outcome) < rank_of(table[row.name].outcome)]


def compare(table, rows, reference_s, by_outcomes_alone=False):
    """All that is worse of the rows of a run. A file that the table does not have is a finding, too."""
    findings = []
    for row in rows:
        if row.name not in table:
            findings.append(Finding(row.name, "row", "none", row.outcome))
        elif by_outcomes_alone:
            findings += judge_outcome(table[row.name], row)
        else:
            findings += judge(table[row.name], row, reference_s)
    return findings


def number_of(text, kind):
    return None if text == "-" else kind(text)


def row_of(line):
    name, outcome, tets, *figures, cpu = line.split("\t")
    if outcome not in OUTCOMES:
        raise ValueError(f"{name}: no such outcome: {outcome}")
    return Row(name, outcome, number_of(tets, int), *(number_of(text, float) for text in figures), float(cpu))


def line_of(row):
    def rounded(value):
        return "-" if value is None else f"{value:.4g}"

    tets = "-" if row.tets is None else str(row.tets)
    return "\t".join((row.name, row.outcome, tets, rounded(row.G), rounded(row.angle), rounded(row.p01),
                      f"{row.cpu:.2f}"))


def read_table(file):
    """Rows by their names."""
    lines = file.read_text().splitlines()
    if not lines or tuple(lines[0].split("\t")) != COLUMNS:
        raise ValueError(f"{file}: the first line must be {' '.join(COLUMNS)}")
    return {row.name: row for row in map(row_of, lines[1:])}


def with_old_cpu(before, now, reference_s):
    """The row for a new table. CPU time is never twice the same: what has hardly changed stays as it was."""
    if before is None:
        return now
    is_same = (max(now.cpu, before.cpu) <= SAME_CPU * min(now.cpu, before.cpu)
               or abs(now.cpu - before.cpu) * reference_s <= SAME_CPU_S)
    return dataclasses.replace(now, cpu=before.cpu) if is_same else now


def write_table(file, rows, names, reference_s):
    """Puts the rows of a run into the table, which may not be there yet. `names`: all that it may have."""
    old = read_table(file) if file.exists() else {}
    new = {row.name: with_old_cpu(old.get(row.name), row, reference_s) for row in rows}
    kept = {name: row for name, row in (old | new).items() if name in names}
    lines = ["\t".join(COLUMNS), *(line_of(kept[name]) for name in sorted(kept))]
    file.write_text("\n".join(lines) + "\n")


def version_numbers(version):
    return tuple(int(part) for part in version.split(".") if part.isdigit())


def table_file(folder, version):
    return folder / f"netgen-{version}.tsv"


def nearest_table(folder, version):
    """The table of that NETGEN; or the last one before it, or else the first one after."""
    exact = table_file(folder, version)
    if exact.exists():
        return exact
    tables = {version_numbers(file.stem.partition("-")[2]): file for file in pathlib.Path(folder).glob("netgen-*.tsv")}
    if not tables:
        raise FileNotFoundError(f"{folder} has no table; make one with --write")
    earlier = [numbers for numbers in tables if numbers < version_numbers(version)]
    return tables[max(earlier) if earlier else min(tables)]
