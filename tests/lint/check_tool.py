#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""check_tool.py PROGRAM VERSION ARGUMENT...: run a program that not every machine has.

If it is missing, or not of the version whose verdict counts ("any": each does), the exit code is 77,
which ctest shows as skipped.
"""
import shutil
import subprocess
import sys

SKIPPED = 77

program, version, *arguments = sys.argv[1:]
path = shutil.which(program)
if path is None:
    print(f"skipped: {program} is not installed")
    sys.exit(SKIPPED)
if version != "any":
    found = subprocess.run([path, "--version"], capture_output=True, text=True, check=True).stdout
    if f"version {version}" not in found and not found.startswith(version):
        print(f"skipped: {program} is not version {version}, which judges otherwise: {found.strip()}")
        sys.exit(SKIPPED)
sys.exit(subprocess.run([path, *arguments], check=False).returncode)
