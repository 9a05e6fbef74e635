// SPDX-License-Identifier: BSD-3-Clause
// Entries of a case file, as text to copy.

// A TOML basic string: JSON's escapes are TOML's, but for one character.
function tomlText(text) {
  return JSON.stringify(text).replaceAll("\u007f", "\\u007f");
}

// A name where TOML takes a pattern: what would stand for other characters stands for any one.
function tomlPattern(name) {
  return tomlText(name.replace(/[*?[\]]/g, "?"));
}

// Three digits, as a person would type them.
function shortNumber(value) {
  return String(Number(value.toPrecision(3)));
}

// Two digits, never zero.
function roundedSize(value) {
  return Number(value.toPrecision(2));
}

function nameEntry(name, numbers) {
  return `[[geometry.name]]\nname = ${tomlText(name)}\npatch = { faces = [${numbers.join(", ")}] }\n`;
}

// `shape` is "patch" or "curve".
function regionEntry(shape, name, size) {
  return `[[size.region]]\n${shape} = ${tomlPattern(name)}\nsize = ${size}\n`;
}

function caseText(file, size, entries) {
  const head = `[geometry]\nfile = ${tomlText(file)}   # beside this case file\n\n[size]\ntarget = ${size}\n`;
  return [head, ...entries].join("\n");
}
