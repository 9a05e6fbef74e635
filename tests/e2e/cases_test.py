#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs every file of configs/cases on two ranks, coarser than it stands there, and checks the result.

    cases_test.py TESSERA SOURCE_FOLDER WORK_FOLDER MPIEXEC...
"""
import dataclasses
import json
import math
import pathlib
import shutil
import subprocess
import sys

from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


@dataclasses.dataclass
class Expected:
    """What is known of a case without the program."""

    volume: float  # Of the CAD model, in output length units.
    tolerance: float  # Relative: chords cut off what is round.
    materials: tuple
    patches: frozenset
    length_unit: tuple = ()
    coarser: tuple = ("refine.levels=0",)  # Overrides that make it fast.


def numbered(count):
    """Names of patches to which the model gives none."""
    return frozenset(f"patch_{i}" for i in range(1, count + 1))


CYLINDER_PATCHES = frozenset({"side", "top", "bottom"})
PACKING_PATCHES = frozenset({"skin", "left", "right", "front", "back", "bottom", "top"})
PENNY_PATCHES = numbered(6) | {"crack_plus", "crack_minus"}
FAULT_PATCHES = numbered(16) | {"fault", "branch"}
WELL_PATCHES = numbered(16) | {"fault"}
CORE_PATCHES = frozenset({"outside", "core_skin", "shell_skin"})
SHAFT_PATCHES = frozenset("journal taper seat keyway flange stub bore hole".split())
# The keyway's walls end on a cylinder of radius 18; its floor is 13 above the axis, 8 wide, 24 long.
KEYWAY = 24 * (4 * math.sqrt(18**2 - 4**2) + 18**2 * math.asin(4 / 18) - 13 * 8)
SHAFT = (
    math.pi * (12**2 * 30 + (12**2 + 12 * 18 + 18**2) * 12 / 3 + 18**2 * 40 + 36**2 * 10 + 15**2 * 20)
    - math.pi * (6**2 * 112 + 6 * 4**2 * 10)
    - KEYWAY
)
# Two legs, the fillet between them, two holes.
BRACKET = 40 * 20 * 5 + 25 * 20 * 5 + (1 - math.pi / 4) * 4**2 * 20 - math.pi * (5**2 + 4**2) * 5
FRUSTUM = math.pi * 0.0508 / 3 * (0.0254**2 + 0.0254 * 0.0127 + 0.0127**2)

CASES = {
    "blocks": Expected(1288, 1e-9, ("steel", "copper"), numbered(12), ("mm",)),
    "bracket": Expected(BRACKET, 0.02, ("bracket",), numbered(11), ("mm",)),
    "bracket_edge": Expected(BRACKET, 0.02, ("bracket",), numbered(11), ("mm",)),
    "bracket_parts": Expected(BRACKET, 0.02, ("bracket",), numbered(11), ("mm",)),
    "brick": Expected(2, 1e-9, ("brick",), numbered(6), coarser=("size.target=0.2",)),
    "cone": Expected(
        math.pi * 8**2 * 12 / 3, 0.05, ("material_1",), numbered(2), coarser=("refine.levels=1",)
    ),
    "core": Expected(1000, 1e-9, ("core", "shell", "matrix"), CORE_PATCHES),
    "cylinder": Expected(math.pi * 5**2 * 20, 0.05, ("cylinder",), CYLINDER_PATCHES, ("mm",)),
    "faults": Expected(
        2e6, 1e-9, ("low", "middle", "high"), FAULT_PATCHES, coarser=("size.target=16",)
    ),
    "frustum": Expected(
        FRUSTUM, 0.05, ("material_1",), numbered(3), coarser=("refine.levels=1",)
    ),
    "own_mesh": Expected(math.pi * 5**2 * 20, 0.1, ("rod",), frozenset({"jacket", "ends"}), ("mm",)),
    "packing": Expected(
        1, 1e-9, ("matrix", "grains"), PACKING_PATCHES, coarser=("size.target=0.1",)
    ),
    "penny_crack": Expected(432, 1e-9, ("block",), PENNY_PATCHES, coarser=()),
    "pipe_layers": Expected(
        2 * math.pi, 0.05, ("full",), numbered(3), coarser=("size.target=0.3",)
    ),
    # The sum of the signed volumes under the triangles of the file.
    "plate": Expected(52942.7655, 0.01, ("material_1",), numbered(7)),
    "shaft": Expected(
        SHAFT, 0.04, ("shaft",), SHAFT_PATCHES, coarser=("refine.levels=0", "coarse.curvature=1")
    ),
    "sphere": Expected(4 / 3 * math.pi, 0.05, ("ball",), numbered(1), coarser=("refine.levels=1",)),
    "torus": Expected(2 * math.pi**2 * 10 * 3**2, 0.05, ("torus",), frozenset({"skin"}), ("mm",)),
    "well": Expected(
        2e6, 1e-9, ("low", "middle", "high"), WELL_PATCHES, coarser=("size.target=16",)
    ),
}


def names_in(index):
    """Field data of the first piece beside an index: name -> texts."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(sorted(index.with_suffix("").glob("*.vtu"))[0]))
    reader.Update()
    fields = reader.GetOutput().GetFieldData()
    arrays = [fields.GetAbstractArray(i) for i in range(fields.GetNumberOfArrays())]
    return {a.GetName(): tuple(a.GetValue(i) for i in range(a.GetNumberOfValues())) for a in arrays}


def problems(name, expected, run, output):
    """What is wrong with a case: run(arguments) -> finished process of tessera."""
    overrides = [word for override in expected.coarser for word in ("--set", override)]
    case = f"configs/cases/{name}.toml"
    meshed = run("mesh", case, *overrides, "--output", str(output), "--progress", "never")
    if meshed.returncode != 0:
        yield f"mesh ended with {meshed.returncode}: {meshed.stdout}{meshed.stderr}"
        return
    checked = run("check", str(output / "mesh.pvtu"), "--json")
    if checked.returncode != 0:
        yield f"check ended with {checked.returncode}: {checked.stdout}{checked.stderr}"
        return
    report = json.loads((output / "report.json").read_text())
    check = json.loads(checked.stdout)
    for key in ("num_tets", "num_vertices", "digest"):
        if report[key] != check[key]:
            yield f"{key}: report {report[key]}, check {check[key]}"
    if abs(check["volume"] / expected.volume - 1) > expected.tolerance:
        yield f"volume {check['volume']}, of the model {expected.volume}"
    names = names_in(output / "boundary.pvtu")
    for key, wanted in (("material_names", expected.materials), ("length_unit", expected.length_unit)):
        if names[key] != wanted:
            yield f"{key} {names[key]}, not {wanted}"
    if set(names["patch_names"]) != expected.patches:
        yield f"patch_names {sorted(set(names['patch_names']))}, not {sorted(expected.patches)}"


def main():
    tessera, source, work = sys.argv[1:4]
    mpiexec = sys.argv[4:]
    found = {file.stem for file in (pathlib.Path(source) / "configs/cases").glob("*.toml")}
    failures = [f"{name}: is not in both CASES and configs/cases" for name in found ^ set(CASES)]
    shutil.rmtree(work, ignore_errors=True)

    def run(*arguments):
        command = [*mpiexec, tessera, *arguments]
        return subprocess.run(
            command, cwd=source, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False
        )

    for name in sorted(found & set(CASES)):
        found_here = list(problems(name, CASES[name], run, pathlib.Path(work) / name))
        failures += [f"{name}: {problem}" for problem in found_here]
        print(f"{name}: {'FAILED' if found_here else 'ok'}", flush=True)
    print("\n".join(failures))
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
