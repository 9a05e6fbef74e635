// SPDX-License-Identifier: BSD-3-Clause
// The arrays of the page: numbers from base64 and deflate. packed_arrays.hpp has the layout.

function bytesOfBase64(text) {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes;
}

async function inflated(text) {
  const packed = new Blob([bytesOfBase64(text)]);
  const stream = packed.stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function typedArray(width, size) {
  return new { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array }[width](size);
}

// Of byte planes, lowest first, of the differences between neighbours, signs in the lowest bit.
function unpackedArray(bytes, begin, { width, size }) {
  const values = typedArray(width, size);
  let last = 0;
  for (let i = 0; i < size; ++i) {
    let code = 0;
    for (let plane = 0; plane < width; ++plane) {
      code |= bytes[begin + plane * size + i] << (8 * plane);
    }
    last = (last + ((code >>> 1) ^ -(code & 1))) | 0;
    values[i] = last;  // Modulo 2^(8 width).
  }
  return values;
}

// The arrays by name.
async function unpackedArrays(text, layout) {
  const bytes = await inflated(text);
  const arrays = {};
  let begin = 0;
  for (const one of layout) {
    arrays[one.name] = unpackedArray(bytes, begin, one);
    begin += one.width * one.size;
  }
  if (begin !== bytes.length) throw new Error("the arrays of this page are damaged");
  return arrays;
}

function elementText(id) {
  return document.getElementById(id).textContent.trim();
}

// Positions about the middle of the box, so that single precision is enough.
function positionsOf(arrays, low, step, middle) {
  const axes = [arrays.x, arrays.y, arrays.z];
  const positions = new Float32Array(3 * arrays.x.length);
  for (let p = 0; p < arrays.x.length; ++p) {
    for (let a = 0; a < 3; ++a) positions[3 * p + a] = low[a] - middle[a] + step[a] * axes[a][p];
  }
  return positions;
}
