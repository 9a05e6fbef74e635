#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Fail if a file includes what its layer may not. ctest runs it as lint.layers."""
import pathlib
import re
import sys

BASE = {"base"}
CORE = BASE | {"comm", "jobs", "mesh"}
ALLOWED = {  # module -> project modules it may include, besides itself
    "base": set(),
    "comm": BASE,
    "jobs": BASE,
    "mesh": BASE | {"comm"},
    "model": CORE,
    "geometry": CORE | {"model", "cut", "surface", "coarse", "io"},
    "cad": CORE | {"model", "cut", "surface", "coarse", "geometry"},
    "netgen": CORE | {"model", "cut", "surface", "coarse", "fill", "quality", "io", "geometry", "cad"},
    "surface": CORE | {"model", "cut", "delaunay"},
    "coarse": CORE | {"model", "cut", "surface", "delaunay", "optimize", "quality"},
    "cut": CORE | {"model"},
    "decompose": CORE | {"model"},
    "untangle": CORE | {"model"},
    "refine": CORE | {"model"},
    "fill": CORE | {"model"},
    "layers": CORE | {"model", "optimize", "quality"},
    "topology": CORE | {"model"},
    "improve": CORE | {"model"},
    "delaunay": BASE | {"mesh"},
    "optimize": BASE | {"mesh"},  # knows no lattice and no process but its own
    "sizing": CORE | {"model"},
    "migrate": CORE,
    "number": CORE,
    "quality": CORE,
    "verify": CORE,
    "check": BASE | {"comm", "mesh"},  # independent of what it checks
    "io": CORE,
}
BEHIND_THE_DOOR = {"geometry", "cad", "netgen"}  # Without public headers but the door.
ALLOWED["subdomain"] = set(ALLOWED) - BEHIND_THE_DOOR  # The one that composes the algorithms.
ALLOWED["formats"] = BASE | {"comm", "mesh", "io", "migrate", "subdomain"}
ALLOWED["config"] = set(ALLOWED) - BEHIND_THE_DOOR - {"subdomain", "formats"}
FRONT_DOOR = "tessera.hpp"  # include/tessera/tessera.hpp, for users; implemented by the pipeline
ALLOWED[FRONT_DOOR] = set(ALLOWED) - BEHIND_THE_DOOR
ALLOWED["pipeline"] = set(ALLOWED) - {"geometry", "cad"}
QUARANTINE = {  # third-party header -> the only places that may include it
    r"mpi\.h": ("include/tessera/comm/", "src/comm/"),
    r"metis\.h": ("src/decompose/partition/metis_",),
    r"(nglib\.h|netgen/.*|meshing\.hpp|csg\.hpp|stlgeom\.hpp|occgeom\.hpp|mystdlib\.h)": ("src/netgen/",),
    r"[A-Z]\w+\.hxx": ("src/cad/", "src/netgen/cad_", "src/netgen/surface/cad_", "src/netgen/csg/solids.", "src/netgen/session.", "src/netgen/version"),
    r"(pt)?scotch\.h": ("src/migrate/partition/scotch_",),
    r"vtk.*": ("src/io/vtu/vtk_",),
    r"hdf5\.h": ("src/formats/files/hdf5_",),
    r"zlib\.h": ("pipeline/drawing/",),
    r"toml.*": ("src/config/",),
    r"fmt/.*": ("src/", "pipeline/"),  # In no public header: users need not have it.
    r"CLI/.*": ("pipeline/commands/cli.cpp",),
    r"(nlohmann|spdlog)/.*": ("src/", "pipeline/"),  # Nobody needs them to compile against the library.
    r"pipeline/report/.*": (  # A stage does not know the report.
        "pipeline/report/", "pipeline/commands/", "pipeline/viewer/", "pipeline/run_case.cpp", "pipeline/jobs/failed_jobs.cpp",
    ),
    r"pipeline/commands/.*": ("pipeline/commands/", "pipeline/main.cpp", "pipeline/tools/"),  # The program; the rest is library.
}
PARTS = {  # (module, other module, "*": any) -> the only headers of the other that it may include
    ("config", "*"): ("options.hpp",),
    ("check", "mesh"): ("mesh_arrays.hpp", "periodic_pairs.hpp"),
    ("delaunay", "mesh"): ("tet_neighbours.hpp", "tet_topology.hpp"),
    ("optimize", "mesh"): ("tet_neighbours.hpp", "tet_topology.hpp"),
    ("pipeline", "netgen"): ("factory.hpp",),
    ("surface", "delaunay"): ("predicates.hpp",),
}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]')


def module_of(path: str) -> str:
    parts = path.split("/")
    return parts[2] if parts[0] == "include" else parts[1] if parts[0] == "src" else parts[0]


def project_module(target: str) -> str | None:
    """Of "tessera/mesh/piece.hpp" (public) and of "mesh/piece.hpp" (private): mesh; of others None."""
    parts = target.split("/")
    if parts[0] == "tessera":
        return parts[1]
    return parts[0] if parts[0] in ALLOWED and len(parts) > 1 and target.endswith(".hpp") else None


def reads_private(module: str, other: str) -> bool:
    """Behind the door: their headers show types of OpenCASCADE and NETGEN, so none of them is public."""
    return {module, other} <= BEHIND_THE_DOOR and other in ALLOWED[module]


def part_allowed(module: str, other: str, target: str) -> bool:
    if other in (module, "base"):
        return True
    parts = PARTS.get((module, other)) or PARTS.get((module, "*"))
    return parts is None or target.split("/")[-1] in parts


def problems(root: pathlib.Path):
    for top in ("include", "src", "pipeline"):
        for file in sorted(root.glob(f"{top}/**/*.[ch]pp")):
            here = file.relative_to(root).as_posix()
            if here.startswith("src/precompiled."):  # Of all modules, and includes none.
                continue
            module = module_of(here)
            if module not in ALLOWED:
                yield f"{here}: module '{module}' is not in the layer table"
                continue
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                if not match:
                    continue
                target = match[1]
                other = project_module(target)
                if target.startswith("tessera/"):
                    if other != module and other not in ALLOWED[module]:
                        yield f"{here}:{number}: '{module}' may not include '{other}'"
                    elif not part_allowed(module, other, target):
                        yield f"{here}:{number}: '{module}' may not include <{target}>"
                elif other is not None and other != module and not reads_private(module, other):
                    yield f"{here}:{number}: \"{target}\" is private to '{other}'"
                for pattern, homes in QUARANTINE.items():
                    if re.fullmatch(pattern, target) and not here.startswith(homes):
                        yield f"{here}:{number}: <{target}> belongs in {' or '.join(homes)}"


root = pathlib.Path(sys.argv[1])
if not list(root.glob("src/**/*.cpp")):
    sys.exit(f"layers: no sources under {root}")
found = list(problems(root))
print("\n".join(found) or "layers: ok")
sys.exit(1 if found else 0)
