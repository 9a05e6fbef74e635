// SPDX-License-Identifier: BSD-3-Clause
// The surface of the page: its arrays, and figures of its faces.

class Surface {
  constructor(data, arrays) {
    this.data = data;
    this.arrays = arrays;
    this.low = data.low;
    this.high = data.low.map((x, a) => x + 65535 * data.step[a]);
    this.middle = this.low.map((x, a) => 0.5 * (x + this.high[a]));
    this.radius = 0.5 * Math.hypot(...this.low.map((x, a) => this.high[a] - x)) || 1;
    this.positions = positionsOf(arrays, this.low, data.step, this.middle);
    this.corners = arrays.corners;
    this.numTriangles = this.corners.length / 3;
    this.faceOf = arrays.face;
  }

  // From the scene, which is about the middle, to the coordinates of the files.
  worldOf(point) {
    return point.map((x, a) => x + this.middle[a]);
  }

  sceneOf(point) {
    return point.map((x, a) => x - this.middle[a]);
  }

  place(p) {
    return [0, 1, 2].map((a) => this.positions[3 * p + a]);
  }

  // Twice the area, along the normal.
  areaVector(t) {
    const [a, b, c] = [0, 1, 2].map((i) => this.place(this.corners[3 * t + i]));
    return cross(b.map((x, i) => x - a[i]), c.map((x, i) => x - a[i]));
  }

  *trianglesOf(face) {
    for (let t = 0; t < this.numTriangles; ++t) if (this.faceOf[t] === face) yield t;
  }

  // Area; the normal, if the face is flat; the mean length of its edges; the middle of its box.
  figuresOf(face) {
    const sum = [0, 0, 0];
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    let [area, length, count] = [0, 0, 0];
    for (const t of this.trianglesOf(face)) {
      const vector = this.areaVector(t);
      vector.forEach((x, a) => { sum[a] += x; });
      area += Math.hypot(...vector);
      const places = [0, 1, 2].map((i) => this.place(this.corners[3 * t + i]));
      places.forEach((place, i) => {
        const next = places[(i + 1) % 3];
        length += Math.hypot(...place.map((x, a) => x - next[a]));
        place.forEach((x, a) => { low[a] = Math.min(low[a], x); high[a] = Math.max(high[a], x); });
      });
      count += 3;
    }
    const FLAT = 1 - 1e-5;
    return {
      area: 0.5 * area,
      normal: Math.hypot(...sum) >= FLAT * area ? unit(sum) : null,
      meanEdge: count > 0 ? length / count : 0,
      middle: low.map((x, a) => 0.5 * (x + high[a])),
      size: count > 0 ? Math.hypot(...low.map((x, a) => high[a] - x)) : 0,
    };
  }
}

function normalText(normal) {
  return `(${normal.map((x) => shortNumber(Math.abs(x) < 5e-4 ? 0 : x)).join(", ")})`;
}
