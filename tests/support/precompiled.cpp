// SPDX-License-Identifier: BSD-3-Clause
// A program, since code of programs and of libraries differs, and so do their precompiled headers.
int main() { return 0; }
