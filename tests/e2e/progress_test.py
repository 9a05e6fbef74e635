# SPDX-License-Identifier: BSD-3-Clause
"""Bars on a terminal, plain lines elsewhere."""
import os
import pty
import re
import subprocess
import unittest

import program

STAGES = ["model", "coarse", "decompose", "plan", "fill", "improve", "verify", "write", "pictures"]
CONTROL_CHARACTERS = re.compile(r"[\x00-\x09\x0b-\x1f\x7f]")


class Progress(program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.arguments = ["mesh", self.write_case(levels=1, page=True), "--output", "out"]

    def output_on_terminal(self, *arguments, ranks=None):
        """Standard output when it is a pseudo-terminal."""
        ours, theirs = pty.openpty()
        self.addCleanup(os.close, ours)
        process = subprocess.Popen(
            program.command_line([*self.arguments, *arguments], ranks),
            cwd=self.folder,
            stdin=subprocess.DEVNULL,
            stdout=theirs,
            stderr=subprocess.PIPE,
        )
        self.addCleanup(program.end_tree, process)
        os.close(theirs)
        parts = []
        while part := self.read(ours):
            parts.append(part)
        self.assertEqual(process.wait(program.HANG_S), program.OK)
        # A terminal turns each line feed into two characters.
        return b"".join(parts).decode().replace("\r\n", "\n")

    @staticmethod
    def read(terminal):
        try:
            return os.read(terminal, 4096)
        except OSError:  # What Linux says when the other side has been closed.
            return b""

    def plain_output(self, *arguments, **options):
        outcome = self.run_program(*self.arguments, *arguments, **options)
        self.assertEqual(outcome.code, program.OK, outcome.err)
        self.assertEqual(outcome.err, "")
        return outcome.out

    def assert_is_plain(self, output):
        self.assertIsNone(CONTROL_CHARACTERS.search(output), repr(output))
        first_words = [line.split()[0] for line in output.splitlines()]
        self.assertEqual([word for word in first_words if word in STAGES], STAGES)

    def assert_has_bars(self, output):
        self.assertRegex(output, r"\r\x1b\[Kfill +\[=* *\] \d/4 subdomains")
        # What is left when every bar has been wiped out is the same as in a batch log.
        self.assert_is_plain(re.sub(r"\r\x1b\[K[^\r\n]*(?=\r)|\r\x1b\[K", "", output))

    def test_terminal_has_bars(self):
        self.assert_has_bars(self.output_on_terminal())

    def test_always_has_bars(self):
        self.assert_has_bars(self.plain_output("--progress", "always"))
        self.assertIsNone(CONTROL_CHARACTERS.search((self.folder / "out/log/run.log").read_text()))

    def test_never_has_no_bars_even_on_a_terminal(self):
        self.assert_is_plain(self.output_on_terminal("--progress", "never"))

    def test_file_has_no_bars(self):
        self.assert_is_plain(self.plain_output())

    def output_in_file(self, command):
        """What a run writes into a file that it has as its standard output."""
        log = self.folder / "log"
        with log.open("wb") as file:
            process = subprocess.Popen(
                command, cwd=self.folder, stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.PIPE
            )
            self.addCleanup(program.end_tree, process)
            self.assertEqual(process.wait(program.HANG_S), program.OK)
        return log.read_bytes().decode()

    def test_mpirun_into_a_file_has_no_bars(self):
        command = program.command_line(self.arguments, 2)
        self.assert_is_plain(self.output_in_file(command))
        # The parent of the ranks need not be mpirun.
        shell = [*command[:3], "sh", "-c", '"$@"; exit $?', "sh", *command[3:], "--overwrite"]
        self.assert_is_plain(self.output_in_file(shell))

    def test_mpirun_into_a_pipe_has_no_bars(self):
        self.assert_is_plain(self.plain_output(ranks=2))

    def test_mpirun_on_a_terminal_has_bars(self):
        self.assert_has_bars(self.output_on_terminal(ranks=2))

    def test_several_ranks_speak_with_one_voice(self):
        self.assert_is_plain(self.plain_output("--progress", "never", ranks=3))

    def test_quiet_says_nothing(self):
        self.assertEqual(self.plain_output("--quiet"), "")
        self.assertEqual(self.output_on_terminal("--quiet", "--overwrite"), "")


if __name__ == "__main__":
    unittest.main()
