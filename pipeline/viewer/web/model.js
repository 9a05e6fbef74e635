// SPDX-License-Identifier: BSD-3-Clause
// The view of a CAD model: its edges, what is short or narrow, sizes to try, and a case that grows.

const MARKED = [220, 30, 60];
const EDGE_REACH_PX = 6;
const MOST_LISTED = 12;

class ModelViewer extends Viewer {
  constructor(data, arrays) {
    super(data, arrays);
    this.entries = new Map();
    this.placeLines();
    this.enableSizes();
    this.enableCase();
  }

  // Where the lines of each edge are: two places a line, in the scene.
  placeLines() {
    const { arrays, low, middle } = this.surface;
    const axes = { x: arrays.line_x, y: arrays.line_y, z: arrays.line_z };
    this.linePlaces = positionsOf(axes, low, this.data.step, middle);
    let begin = 0;
    for (const edge of this.data.edges) {
      edge.begin = begin;
      begin += 6 * edge.num_lines;
      edge.end = begin;
    }
  }

  drawEdges() {
    const colours = new Uint8Array(this.linePlaces.length);
    for (const edge of this.data.edges) {
      const isShort = edge.length < this.data.size;
      for (let i = edge.begin; i < edge.end; ++i) {
        colours[i] = (isShort ? MARKED : BORDER)[i % 3];
      }
    }
    this.scene.setLines("edges", this.linePlaces, colours);
    this.wantFrame();
  }

  showPickedEdge(row) {
    const edge = row === null ? { begin: 0, end: 0 } : this.data.edges[row];
    const places = this.linePlaces.subarray(edge.begin, edge.end);
    this.scene.setLines("picked", places, places.map((_, i) => PICKED[i % 3]), { isOnTop: true });
    this.wantFrame();
  }

  // The edge within some pixels of a place on the canvas, if no face hides it.
  edgeAt(x, y, hit) {
    const { camera } = this.orbit;
    const { clientWidth, clientHeight } = this.canvas;
    const toEye = this.orbit.toEye();
    const depthOf = (p) => p[0] * toEye[0] + p[1] * toEye[1] + p[2] * toEye[2];
    const onCanvas = (p) => {
      const { x: right, y: up } = new THREE.Vector3(...p).project(camera);
      return [0.5 * (right - x) * clientWidth, 0.5 * (up - y) * clientHeight];
    };
    // Of a slanted face what is some pixels away lies deeper.
    const nearest = hit ? depthOf(hit.point) - 0.02 * this.surface.radius : -Infinity;
    let found = null;
    let least = EDGE_REACH_PX;
    this.data.edges.forEach((edge, row) => {
      for (let i = edge.begin; i < edge.end; i += 6) {
        const [a, b] = [this.linePlaces.slice(i, i + 3), this.linePlaces.slice(i + 3, i + 6)];
        const { distance, share } = distanceToLine(onCanvas(a), onCanvas(b));
        const place = Array.from(a, (from, axis) => from + share * (b[axis] - from));
        if (distance >= least || depthOf(place) < nearest) continue;
        if (this.scene.isCutAway({ x: place[0], y: place[1], z: place[2] })) continue;
        least = distance;
        found = row;
      }
    });
    return found;
  }

  enableSizes() {
    const { low, high, at_first: first } = this.data.sizes;
    byId("model").hidden = false;
    const slider = byId("size");
    slider.value = 1000 * Math.log(first / low) / Math.log(high / low);
    slider.addEventListener("input", () => this.setSize(roundedSize(low * (high / low) ** (slider.value / 1000))));
    this.setSize(first);
  }

  // As `tessera info` predicts it.
  numTets(size) {
    const { volume, area, per_cube: perCube, per_thinness: perThinness } = this.data.sizes;
    const thinness = (area * size) / volume;
    return ((perCube + perThinness * thinness ** 2) * volume) / size ** 3;
  }

  setSize(size) {
    this.data.size = size;
    byId("size-value").textContent = `${size}${this.data.unit ? ` ${this.data.unit}` : ""}`;
    byId("tets").textContent = `about ${countText(this.numTets(size))} tets (up to twice or half)`;
    const byLength = this.rowsBelow(this.data.edges, ({ length }) => length);
    const byWidth = this.rowsBelow(this.data.faces, ({ width }) => width);
    this.marked = new Set(byWidth);
    this.list("short", byLength, "edges are shorter than the size",
      (row) => this.data.edges[row].number, (row) => this.flyToEdge(row));
    this.list("narrow", byWidth, "faces are narrower",
      (row) => this.data.faces[row].numbers[0], (row) => this.flyToFace(row));
    this.drawEdges();
    this.paint();
    this.writeCase?.();
  }

  rowsBelow(things, measure) {
    return things.map((_, row) => row)
      .filter((row) => measure(things[row]) < this.data.size)
      .sort((a, b) => measure(things[a]) - measure(things[b]));
  }

  // The smallest first, each with a button to fly there.
  list(id, rows, what, nameOf, flyTo) {
    const head = document.createElement("span");
    head.textContent = rows.length === 0 ? `No ${what}` : `${rows.length} ${what}:`;
    const buttons = rows.slice(0, MOST_LISTED).map((row) => buttonOf(String(nameOf(row)), "go there", () => flyTo(row)));
    byId(id).replaceChildren(head, ...buttons, rows.length > MOST_LISTED ? "…" : "");
  }

  flyToEdge(row) {
    const { begin, end, length } = this.data.edges[row];
    this.picker.pickEdge(row);
    if (begin === end) return;
    const middle = [0, 1, 2].map((a) => 0.5 * (this.linePlaces[begin + a] + this.linePlaces[end - 3 + a]));
    this.orbit.flyTo({ middle, height: 6 * length });
  }

  flyToFace(row) {
    const { middle, size, normal } = this.surface.figuresOf(row);
    this.picker.pickFace(row);
    const eye = normal ? { turn: Math.atan2(normal[1], normal[0]), tilt: Math.asin(0.95 * normal[2]) } : {};
    this.orbit.flyTo({ middle, height: 2 * size, ...eye });
  }

  enableCase() {
    byId("case").hidden = false;
    for (const button of document.querySelectorAll("#viewer [data-adds]")) {
      button.hidden = false;
      button.addEventListener("click", () => this.addEntry(button.dataset.adds));
    }
    byId("case-undo").addEventListener("click", () => {
      this.entries.delete([...this.entries.keys()].pop());
      this.writeCase();
    });
    this.writeCase();
  }

  // A later entry for the same thing takes the place of an earlier one. A region needs its name.
  addEntry(id) {
    const { numbers, name, edge } = this.picker;
    const newName = byId("new-name").value;
    const isRegion = id === "viewer-region-entry";
    if (edge === null && (!isRegion || newName !== name)) {
      this.entries.set(`name ${numbers}`, byId("name-entry").textContent);
    }
    if (isRegion) {
      this.entries.set(`size ${edge === null ? numbers : name}`, byId("region-entry").textContent);
    }
    this.writeCase();
  }

  writeCase() {
    byId("case-text").textContent = caseText(this.data.file, this.data.size, this.entries.values());
  }
}

// Of the origin of the plane from a line, and where on the line, in parts of it, it is nearest.
function distanceToLine(a, b) {
  const along = [b[0] - a[0], b[1] - a[1]];
  const square = along[0] ** 2 + along[1] ** 2 || 1;
  const share = Math.max(0, Math.min(1, -(a[0] * along[0] + a[1] * along[1]) / square));
  return { distance: Math.hypot(a[0] + share * along[0], a[1] + share * along[1]), share };
}
