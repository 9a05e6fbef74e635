# SPDX-License-Identifier: BSD-3-Clause
"""Damaged case files and models for the bench `mutate`: each a function of its argument and `rng`."""
import re
import struct

NUMBER = re.compile(rb"-?\d+\.\d*(?:[eE][-+]?\d+)?|-?\d+(?:[eE][-+]?\d+)?")

# What a value of a case file is replaced with: other types, limits, and what only looks right.
VALUES = (
    "0 1 2 3 -1 0.5 1e-3 1.5 4 8 1e308 1e400 -0.0 nan inf -inf 1_0 0x10 9223372036854775807"
    " 99999999999999999999 true false \"\" \"x\" \"netgen\" \"subdivide\" \"auto\" 'lz4' \"none\""
    ' [] [1] ["pvtu"] ["vtk"] {} {a=1} 1979-05-27 12:00:00 + . 1,5 "\\u0000" "\\ud800" "é" """a"""'
).split(" ")
CHEAPER = {  # Models that take seconds, and what stands for them.
    "bracket.step": "plate_with_hole.stl", "core.geo": "brick.geo", "shaft.geo": "brick.geo",
    "torus.step": "sphere.step",
}  # fmt: skip
KEYS = {  # Table -> its keys with values that cost little.
    "geometry": ["scale = 0.5", "scale = 2"],
    "coarse": ["grading = 0.5", "curvature = 0.5", "feature_angle_deg = 40", "timeout_s = 60"],
    "fill": ['kernel = "subdivide"', "timeout_s = 30", "memory_gib = 2", "optimize_steps = 0",
             "grading = 0.5"],
    "improve": ["seams = false", "seams = true", "rounds = 1"],
    "quality": ["min_dihedral_deg = 1", "min_mean_ratio = 0.9"],
    "output": ['formats = ["pvtu"]', 'compression = "none"', 'compression = "zlib"', "parts = 2",
               "files = 1", "cell_quality = true"],
    "decompose": ["subdomains = 1", 'subdomains = "auto"'],
}  # fmt: skip


# ---- case files


def cheap_case(path, configs):
    """A case of configs/cases with a coarse mesh of some ten or hundred tets, not refined."""
    text = re.sub(r"#.*\n", "", path.read_text())
    for costly, cheap in CHEAPER.items():
        text = text.replace(costly, cheap)
    text = text.replace("../geometry", str(configs / "geometry"))
    text = re.sub(r"(max_size|target) = (\S+)", lambda m: f"{m[1]} = {5 * float(m[2])}", text)
    text = re.sub(r"levels = \d", "levels = 0", text)
    return re.sub(r"subdomains = \d+", "subdomains = 2", text).strip() + "\n"


def lines_with_value(lines):
    return [i for i, line in enumerate(lines) if "=" in line]


def change_value(lines, rng):
    i = rng.choice(lines_with_value(lines) or [0])
    lines[i] = lines[i].partition("=")[0] + "= " + rng.choice(VALUES)


def scale_number(lines, rng):
    numbers = [i for i in lines_with_value(lines) if re.search(r"^\w+ = \d+(\.\d+)?$", lines[i])]
    if numbers:
        i = rng.choice(numbers)
        key, _, value = lines[i].partition("= ")
        factor = rng.choice([0.7, 0.9, 1.1, 1.7, 3])
        number = float(value) * factor
        lines[i] = f"{key}= {number if '.' in value else round(number)}"


def drop_line(lines, rng):
    del lines[rng.randrange(len(lines))]


def double_line(lines, rng):
    lines.insert(rng.randrange(len(lines) + 1), rng.choice(lines))


def rename_key(lines, rng):
    i = rng.choice(lines_with_value(lines) or [0])
    at = rng.randrange(max(1, len(lines[i].partition("=")[0])))
    lines[i] = lines[i][:at] + rng.choice("abcxyz_.-\"[ ") + lines[i][at + 1 :]


def shuffle_lines(lines, rng):
    first, last = sorted(rng.sample(range(len(lines) + 1), 2))
    part = lines[first:last]
    rng.shuffle(part)
    lines[first:last] = part


def shuffle_tables(lines, rng):
    tables = re.split(r"(?m)^(?=\[)", "\n".join(lines) + "\n")
    rng.shuffle(tables)
    lines[:] = "".join(tables).splitlines() or [""]


def add_key(lines, rng):
    table = rng.choice(list(KEYS))
    if f"[{table}]" not in lines:
        lines.append(f"[{table}]")
    lines.insert(lines.index(f"[{table}]") + 1, rng.choice(KEYS[table]))


def add_comment(lines, rng):
    lines[rng.randrange(len(lines))] += rng.choice([" # é", "  ", "\t# x = 1", "\r"])


def add_region(lines, rng):
    lines += ["[[fill.region]]", f'material = "{rng.choice(["a", "material_1", "steel"])}"',
              f'kernel = "{rng.choice(["netgen", "subdivide", "x"])}"']  # fmt: skip


HARMLESS = (scale_number, shuffle_tables, add_key, add_key, add_comment)
HARMFUL = (change_value, change_value, scale_number, drop_line, double_line, rename_key,
           shuffle_lines, add_key, add_region)  # fmt: skip


def flip_bytes(data, rng):
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 2, 8])):
        if data:
            data[rng.randrange(len(data))] = rng.choice([0, 255, 10, 34, 48, 57, rng.randrange(256)])
    return bytes(data)


def truncate(data, rng):
    return data[: rng.randrange(len(data))]


def mutated_case(texts, rng):
    lines = rng.choice(texts).splitlines()
    mutations = HARMLESS if rng.random() < 0.2 else HARMFUL
    for _ in range(rng.choice([1, 1, 2, 3])):
        rng.choice(mutations)(lines, rng)
        lines = lines or [""]
    data = ("\n".join(lines) + "\n").encode()
    kind = rng.random()
    return flip_bytes(data, rng) if kind < 0.06 else truncate(data, rng) if kind < 0.1 else data


# ---- models


def change_number(data, rng):
    """One number everywhere it stands, mostly by little: surfaces stay closed."""
    numbers = NUMBER.findall(data)
    if not numbers:
        return flip_bytes(data, rng)
    old = rng.choice(numbers)
    try:
        value = float(old) * rng.choice([1.01, 0.9, 1.2, -1, 0, 1e6]) + rng.choice([0, 0, 0.1])
    except ValueError:
        return data
    new = b"%.6g" % value if b"." in old else b"%d" % round(min(value, 1e18))
    return re.sub(rb"(?<![\d.#])" + re.escape(old) + rb"(?![\d.])", new, data)


def change_one_number(data, rng):
    found = list(NUMBER.finditer(data))
    if not found:
        return flip_bytes(data, rng)
    place = rng.choice(found)
    new = rng.choice([b"0", b"1", b"-1", b"1e300", b"nan", b"99999999999", b"0.5", b"1e-30", b"."])
    return data[: place.start()] + new + data[place.end() :]


def change_reference(data, rng):
    names = re.findall(rb"#\d+", data)
    if not names:
        return swap_words(data, rng)
    place = rng.choice(list(re.finditer(rb"#\d+", data)))
    return data[: place.start()] + rng.choice(names) + data[place.end() :]


def swap_words(data, rng):
    words = list(re.finditer(rb"[A-Za-z_]{2,}", data))
    if not words:
        return flip_bytes(data, rng)
    place, other = rng.choice(words), rng.choice(words)
    return data[: place.start()] + other[0] + data[place.end() :]


def change_lines(data, rng):
    lines = data.split(b"\n")
    i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
    kind = rng.randrange(3)
    if kind == 0:
        del lines[i]
    elif kind == 1:
        lines.insert(j, lines[i])
    else:
        lines[i], lines[j] = lines[j], lines[i]
    return b"\n".join(lines)


def add_space(data, rng):
    places = [place.end() for place in re.finditer(rb"[ \n]", data)]
    at = rng.choice(places or [0])
    return data[:at] + rng.choice([b" ", b"\n"]) + data[at:]


TEXT = (change_number, change_number, change_number, change_one_number, change_reference,
        swap_words, change_lines, add_space, flip_bytes, truncate)  # fmt: skip


def move_vertex(data, rng):
    """One vertex of a binary STL file in all of its triangles."""
    places = [84 + 50 * t + 12 + 12 * c for t in range((len(data) - 84) // 50) for c in range(3)]
    vertex = data[(at := rng.choice(places)) : at + 12]
    moved = struct.pack("<3f", *(x + rng.uniform(-1, 1) for x in struct.unpack("<3f", vertex)))
    changed = bytearray(data)
    for place in places:
        if data[place : place + 12] == vertex:
            changed[place : place + 12] = moved
    return bytes(changed)


def change_triangles(data, rng):
    """A triangle dropped, doubled or turned; the count in the header follows, or does not."""
    triangles = [data[i : i + 50] for i in range(84, len(data), 50)]
    i = rng.randrange(len(triangles))
    kind = rng.randrange(3)
    if kind == 0:
        del triangles[i]
    elif kind == 1:
        triangles.append(triangles[i])
    else:
        t = triangles[i]
        triangles[i] = t[:12] + t[24:36] + t[12:24] + t[36:]
    count = len(triangles) if rng.random() < 0.8 else rng.choice([0, 1, 2**31, 2**32 - 1])
    return data[:80] + struct.pack("<I", count) + b"".join(triangles)


BINARY = (move_vertex, move_vertex, change_triangles, change_triangles, flip_bytes, truncate)


def mutated_model(data, rng):
    is_binary = b"\0" in data[:200]
    for _ in range(1 if is_binary else rng.choice([1, 1, 2])):
        data = rng.choice(BINARY if is_binary else TEXT)(data, rng)
    return data


def ascii_stl(binary):
    """The text form of a binary STL file."""
    facets = []
    for at in range(84, len(binary), 50):
        x = struct.unpack("<12f", binary[at : at + 48])
        corners = "".join("vertex %.9g %.9g %.9g\n" % x[i : i + 3] for i in (3, 6, 9))
        facets.append(f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    return ("solid plate\n" + "".join(facets) + "endsolid plate\n").encode()
