// SPDX-License-Identifier: BSD-3-Clause
// Edges of triangles, each once.

// Both ends and the two triangles of each edge; a second triangle of -1: it is open there. Edges stand
// in lists by their lower end, which are short.
function edgesOfTriangles(corners, numPoints) {
  const begin = new Uint32Array(numPoints + 1);
  const lower = (i) => Math.min(corners[i], corners[nextCorner(i)]);
  for (let i = 0; i < corners.length; ++i) ++begin[lower(i) + 1];
  for (let p = 0; p < numPoints; ++p) begin[p + 1] += begin[p];
  const used = new Uint32Array(numPoints);
  const upper = new Uint32Array(corners.length);
  const first = new Int32Array(corners.length);
  const second = new Int32Array(corners.length).fill(-1);
  for (let i = 0; i < corners.length; ++i) {
    const low = lower(i);
    const high = corners[i] + corners[nextCorner(i)] - low;
    const triangle = Math.floor(i / 3);
    const end = begin[low] + used[low];
    let place = begin[low];
    while (place < end && upper[place] !== high) ++place;
    if (place < end) {
      second[place] = triangle;
    } else {
      upper[place] = high;
      first[place] = triangle;
      ++used[low];
    }
  }
  return { begin, used, upper, first, second };
}

function nextCorner(i) {
  return i % 3 === 2 ? i - 2 : i + 1;
}

// The ends of the edges that `isWanted(first triangle, second triangle)` takes, two points each.
function endsOfEdges(edges, isWanted) {
  const ends = [];
  for (let low = 0; low < edges.used.length; ++low) {
    for (let place = edges.begin[low]; place < edges.begin[low] + edges.used[low]; ++place) {
      if (isWanted(edges.first[place], edges.second[place])) ends.push(low, edges.upper[place]);
    }
  }
  return ends;
}
