# SPDX-License-Identifier: BSD-3-Clause
"""The files of the corpus: the list, and how each comes here, from this repository, a Debian package or a
generator."""
import dataclasses
import gzip
import os
import pathlib
import pwd
import re
import shutil
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
LIST = HERE / "files.txt"
GENERATORS = ("hard_models", "random_models")
ENDINGS = {".rle": ".brep"}  # OpenCASCADE's samples have names that no program goes by.


class MissingInput(Exception):
    """A package or a file cannot be had; the message names it."""


@dataclasses.dataclass(frozen=True)
class Entry:
    """A line of the list. `settings` are of the form table.key=value."""

    name: str
    source: str  # "repository", a generator, or a package.
    file: str
    is_quick: bool
    settings: tuple[str, ...]


def parse_list(text):
    """Entries of a list; no two have the same name."""
    entries = []
    for line in text.splitlines():
        words = line.partition("#")[0].split()
        if not words:
            continue
        if len(words) < 4 or words[3] not in ("quick", "full"):
            raise ValueError(f"name, source, file, quick or full expected: {line}")
        entries.append(Entry(*words[:3], words[3] == "quick", tuple(words[4:])))
    names = [entry.name for entry in entries]
    if len(set(names)) != len(names):
        raise ValueError(f"twice in the list: {sorted(name for name in set(names) if names.count(name) > 1)}")
    return entries


def read_list():
    return parse_list(LIST.read_text())


def said_by(command, **options):
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, **options)


def is_installed(package):
    return said_by(["dpkg-query", "--show", "--showformat=${db:Status-Status}", package]).stdout == "installed"


def candidate_version(package):
    """That of the package lists; None if they do not have the package."""
    found = re.search(r"Candidate: (\S+)", said_by(["apt-cache", "policy", package]).stdout)
    return found[1] if found and found[1] != "(none)" else None


def update_package_lists():
    as_root = [] if os.geteuid() == 0 else ["sudo"]
    said_by([*as_root, "apt-get", "-qq", "update"])


def unpack_package(package, folder):
    """The folder that holds the content of the package. It is not installed: some would bring hundreds."""
    if is_installed(package):
        return pathlib.Path("/")
    try:
        return unpacked(package, folder)
    except MissingInput:
        update_package_lists()  # They may be absent or outdated.
        return unpacked(package, folder)


def unpacked(package, folder):
    version = candidate_version(package)
    if version is None:
        raise MissingInput(f"the package lists have no package {package}, after apt-get update either")
    content = folder / f"{package}_{version}"
    if not content.exists():
        download(package, version, folder / f"{package}.part", content)
    return content


def download(package, version, work, content):
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    user = pwd.getpwuid(os.geteuid()).pw_name
    done = said_by(["apt-get", "-qq", "-o", f"APT::Sandbox::User={user}", "download", f"{package}={version}"], cwd=work)
    if done.returncode != 0:
        raise MissingInput(f"package {package} {version} cannot be downloaded: {done.stderr.strip()}")
    for archive in work.glob("*.deb"):
        subprocess.run(["dpkg-deb", "--extract", archive, work], check=True)
        archive.unlink()
    work.rename(content)


class Models:
    """Brings models into `folder`."""

    def __init__(self, folder, bin_folder):
        self.folder = folder
        self.bin_folder = bin_folder
        self.folders = {}  # Of each source that was asked for.

    def of_source(self, source):
        if source not in self.folders:
            self.folders[source] = self.make(source)
        return self.folders[source]

    def make(self, source):
        if source == "repository":
            return ROOT
        if source not in GENERATORS:
            return unpack_package(source, self.folder / "packages")
        program, folder = self.bin_folder / source, self.folder / source
        if not program.exists():
            raise MissingInput(f"{program} is not built")
        if folder.exists() and folder.stat().st_mtime < program.stat().st_mtime:
            shutil.rmtree(folder)  # Another version may write others.
        folder.mkdir(parents=True, exist_ok=True)
        return folder

    def generate(self, source, file):
        """Has a generator write a file that is not there yet. `hard_models` writes all it has; of
        `random_models`, SEED/random_NUMBER.step is one model. A generator must write the same model each time."""
        target = self.of_source(source) / file
        if target.exists():
            return
        work = self.folder / f"{source}.part"
        shutil.rmtree(work, ignore_errors=True)
        command = [self.bin_folder / source, work]
        if source == "random_models":
            seed, number = re.fullmatch(r"(\d+)/random_(\d+)\.\w+", file).groups()
            command += [1, seed, int(number)]
        done = said_by(command)
        if done.returncode != 0:
            raise MissingInput(f"{source} ends with {done.returncode}: {done.stderr.strip()}")
        target.parent.mkdir(exist_ok=True)
        for made in work.iterdir():
            made.rename(target.parent / made.name)  # Only what is whole.
        work.rmdir()

    def path_of(self, entry):
        """The file of an entry, under a name that the program takes."""
        if entry.source in GENERATORS:
            self.generate(entry.source, entry.file)
        folder = self.of_source(entry.source)
        found = [*folder.glob(entry.file), *folder.glob(f"{entry.file}.gz")]
        if len(found) != 1:
            raise MissingInput(f"{entry.source} has no file {entry.file}, or several")
        return self.renamed(entry, found[0])

    def renamed(self, entry, path):
        """A copy, where the file is compressed or its ending says nothing."""
        ending = pathlib.Path(entry.file).suffix
        if path.suffix != ".gz" and ending not in ENDINGS:
            return path
        copy = self.folder / "renamed" / f"{entry.name}{ENDINGS.get(ending, ending)}"
        copy.parent.mkdir(parents=True, exist_ok=True)
        content = path.read_bytes()
        copy.write_bytes(gzip.decompress(content) if path.suffix == ".gz" else content)
        return copy
