// SPDX-License-Identifier: BSD-3-Clause
// The view: what each part of the panel does.

const EYES = {
  x: { turn: 0, tilt: 0 }, y: { turn: 0.5 * Math.PI, tilt: 0 }, z: { turn: -0.5 * Math.PI, tilt: FULL_TILT },
  "-x": { turn: Math.PI, tilt: 0 }, "-y": { turn: -0.5 * Math.PI, tilt: 0 },
  "-z": { turn: -0.5 * Math.PI, tilt: -FULL_TILT }, home: { turn: -1.04, tilt: 0.51 },
};
const BORDER = [20, 24, 30];
const FINE_LINE = [90, 96, 104];

class Viewer {
  constructor(data, arrays) {
    this.data = data;
    this.surface = new Surface(data, arrays);
    this.canvas = byId("canvas");
    this.scene = new Scene(this.canvas, this.surface.positions, this.surface.corners);
    this.orbit = new Orbit(this.surface.radius, () => this.wantFrame());
    this.picked = new Set();
    this.addBorders();
    this.enableColours();
    this.enableEyes();
    this.enableCut();
    this.enableLines();
    this.enableWorst();
    this.picker = new Picker(this);
    enableCopies();
    followPointers(this.canvas, this.orbit, (x, y, event) => this.picker.pickAt(x, y, event));
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    this.resize();
  }

  // Whether all that there is to see has been drawn stands with the canvas, for who waits for it.
  wantFrame() {
    if (this.frame) return;
    this.canvas.dataset.drawn = "no";
    this.frame = requestAnimationFrame(() => {
      this.frame = 0;
      this.scene.draw(this.orbit.camera);
      this.canvas.dataset.drawn = this.orbit.isFlying ? "no" : "yes";
    });
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.scene.resize(clientWidth, clientHeight);
    this.orbit.resize(clientWidth, clientHeight);
  }

  edges() {
    this.edgeLists ??= edgesOfTriangles(this.surface.corners, this.surface.positions.length / 3);
    return this.edgeLists;
  }

  // Edges of triangles that `isWanted`, all of one colour.
  setTriangleEdges(name, colour, isWanted) {
    const ends = endsOfEdges(this.edges(), isWanted);
    const places = new Float32Array(3 * ends.length);
    ends.forEach((p, i) => places.set(this.surface.place(p), 3 * i));
    const colours = new Uint8Array(3 * ends.length);
    for (let i = 0; i < ends.length; ++i) colours.set(colour, 3 * i);
    this.scene.setLines(name, places, colours);
    this.wantFrame();
  }

  // Where faces meet. A model brings its own lines.
  addBorders() {
    if (this.data.kind === "model") return;
    const { faceOf } = this.surface;
    this.setTriangleEdges("borders", BORDER, (a, b) => b < 0 || faceOf[a] !== faceOf[b]);
  }

  colouring() {
    return this.data.colourings[byId("colour").value];
  }

  enableColours() {
    const select = byId("colour");
    this.data.colourings.forEach(({ label }, i) => select.append(optionOf(i, label)));
    select.addEventListener("change", () => this.paint());
    this.paint();
  }

  paint() {
    const colouring = this.colouring();
    const values = this.surface.arrays[colouring.array];
    const colourOf = coloursOf(colouring, this.data.palette);
    const { faceOf } = this.surface;
    this.scene.paint((t) => {
      const colour = colourOf(values[t]);
      if (this.picked.has(faceOf[t])) return mixed(colour, PICKED, 0.8);
      return this.marked?.has(faceOf[t]) ? mixed(colour, MARKED, 0.75) : colour;
    });
    byId("legend").replaceChildren(...legendOf(colouring, values, this.data.palette));
    this.wantFrame();
  }

  enableEyes() {
    for (const button of document.querySelectorAll("#viewer [data-eye]")) {
      button.addEventListener("click", () =>
        this.orbit.flyTo({ ...EYES[button.dataset.eye], middle: [0, 0, 0], height: 2.1 * this.surface.radius }));
    }
  }

  enableCut() {
    for (const id of ["cut-place", "cut-other"]) byId(id).addEventListener("input", () => this.cut());
    byId("cut").addEventListener("change", () => {
      // What is on the eye's side goes.
      this.cutSide = this.orbit.toEye()[byId("cut").value] < 0 ? -1 : 1;
      this.cut();
    });
  }

  cut() {
    const axis = byId("cut").value;
    byId("cut-place").disabled = axis === "";
    if (axis === "") {
      byId("cut-value").textContent = "";
      this.scene.setCut(null);
      return this.wantFrame();
    }
    const { low, high } = this.surface;
    // A plane through points of a regular mesh would flicker.
    const place = low[axis] + ((Number(byId("cut-place").value) + 0.137) / 1000) * (high[axis] - low[axis]);
    const side = byId("cut-other").checked ? -this.cutSide : this.cutSide;
    const normal = [0, 0, 0];
    normal[axis] = side;
    byId("cut-value").textContent = shortNumber(place);
    this.scene.setCut(normal, side * (place - this.surface.middle[axis]));
    return this.wantFrame();
  }

  enableLines() {
    byId("lines").addEventListener("change", (event) => {
      if (!this.scene.lines.fine) this.setTriangleEdges("fine", FINE_LINE, () => true);
      this.scene.show("fine", event.target.checked);
      this.wantFrame();
    });
  }

  enableWorst() {
    const worst = this.data.worst ?? [];
    if (worst.length === 0) return;
    byId("worst").hidden = false;
    if (this.data.worst_label) byId("worst").firstElementChild.textContent = this.data.worst_label;
    worst.forEach((tet, i) => {
      const title = tet.title ?? `mean ratio ${tet.mean_ratio.toFixed(4)}, in subdomain ${tet.subdomain}`;
      byId("worst").append(buttonOf(String(i + 1), title, () => this.flyToTet(tet)));
    });
    const places = worst.flatMap((tet) => this.surface.sceneOf(tet.centre));
    this.scene.setMarks("worst", places, worst.flatMap(() => [200, 20, 40]));
  }

  // The cut goes through it, so that it is seen inside as well.
  flyToTet(tet) {
    const middle = this.surface.sceneOf(tet.centre);
    this.orbit.flyTo({ middle, height: 0.25 * this.surface.radius });
    const normal = this.orbit.toEye();
    byId("cut").value = "";
    this.cut();
    this.scene.setCut(normal, normal.reduce((sum, x, a) => sum + x * middle[a], 0));
  }
}
