// SPDX-License-Identifier: BSD-3-Clause
// What a click picks, what is said of it, and the entries of a case for it.

class Picker {
  constructor(viewer) {
    this.viewer = viewer;
    this.edge = null;  // Of a model: the row of the picked one.
    for (const id of ["new-name", "region-size"]) byId(id).addEventListener("input", () => this.write());
  }

  pickAt(x, y, event) {
    const { viewer } = this;
    const hit = viewer.scene.hitAt(x, y, viewer.orbit.camera);
    this.edge = viewer.edgeAt?.(x, y, hit) ?? null;
    const isMore = event.ctrlKey || event.metaKey;
    if (this.edge !== null || !isMore) viewer.picked.clear();
    if (this.edge === null && hit) this.toggle(viewer.surface.faceOf[hit.triangle]);
    this.hit = hit;
    this.show();
  }

  toggle(face) {
    const { picked } = this.viewer;
    if (!picked.delete(face)) picked.add(face);
  }

  pickFace(face) {
    this.edge = null;
    this.hit = null;
    this.viewer.picked = new Set([face]);
    this.show();
  }

  pickEdge(edge) {
    this.edge = edge;
    this.viewer.picked.clear();
    this.show();
  }

  show() {
    const { viewer } = this;
    viewer.paint();
    viewer.showPickedEdge?.(this.edge);
    const faces = [...viewer.picked];
    byId("picked").hidden = faces.length === 0 && this.edge === null;
    if (this.edge !== null) this.describeEdge(viewer.data.edges[this.edge]);
    else if (faces.length > 0) this.describeFaces(faces);
  }

  describeFaces(rows) {
    const { surface, data } = this.viewer;
    const faces = rows.map((row) => data.faces[row]);
    const figures = rows.map((row) => surface.figuresOf(row));
    this.name = faces[0].name;
    this.numbers = faces.flatMap(({ numbers }) => numbers).sort((a, b) => a - b);
    byId("picked-name").textContent = faces.map(({ name, numbers }) => name || `face ${numbers[0]}`).join(", ");
    byId("picked-figures").textContent = this.faceText(faces, figures);
    byId("new-name-row").hidden = false;
    byId("new-name").value = this.name || `face_${this.numbers[0]}`;
    const edges = figures.reduce((sum, one) => sum + one.meanEdge, 0) / figures.length;
    byId("region-size").value = roundedSize(0.5 * (data.size ?? edges));
    this.write();
  }

  faceText(faces, figures) {
    const { data } = this.viewer;
    const unit = data.unit ? ` ${data.unit}` : "";
    const area = faces.reduce((sum, face, i) => sum + (face.area ?? figures[i].area), 0);
    const parts = [
      this.numbers.length > 0 ? `number ${this.numbers.join(", ")}` : "",
      `area ${Number(area.toPrecision(5))}${unit && `${unit}²`}`,
    ];
    if (faces.length === 1) parts.push(this.normalTextOf(figures[0]), ...this.aroundText(faces[0]));
    return parts.filter(Boolean).join(" · ");
  }

  normalTextOf({ normal }) {
    if (normal) return `normal ${normalText(normal)}`;
    if (!this.hit) return "curved";
    return `curved, normal there ${normalText(unit(this.viewer.surface.areaVector(this.hit.triangle)))}`;
  }

  // What it lies between, and what it touches.
  aroundText({ solids, touches }) {
    const { data } = this.viewer;
    const parts = [];
    if (solids) parts.push(`of ${solids.map((s) => data.solids[s - 1]?.name || `solid ${s}`).join(" and ")}`);
    if (touches) parts.push(`touches ${touches.map((row) => data.faces[row].numbers[0]).join(", ")}`);
    return parts;
  }

  describeEdge({ number, name, length, faces }) {
    const { data } = this.viewer;
    const unit = data.unit ? ` ${data.unit}` : "";
    this.name = number;
    this.numbers = [];
    byId("picked-name").textContent = name || `edge ${number}`;
    byId("picked-figures").textContent =
      `number ${number} · length ${Number(length.toPrecision(5))}${unit}`
      + (faces.length > 0 ? ` · of faces ${faces.map((row) => data.faces[row].numbers[0]).join(", ")}` : "");
    byId("new-name-row").hidden = true;
    byId("region-size").value = roundedSize(0.5 * data.size);
    this.write();
  }

  // The entries, as name and size are now.
  write() {
    const isFace = this.numbers.length > 0;
    const name = isFace ? byId("new-name").value : this.name;
    byId("name-entry").textContent = isFace ? nameEntry(name, this.numbers) : "";
    byId("name-entry").hidden = !isFace;
    for (const button of document.querySelectorAll("#viewer [data-copies=viewer-name-entry]")) {
      button.hidden = !isFace;
    }
    for (const button of document.querySelectorAll("#viewer [data-adds=viewer-name-entry]")) {
      button.hidden = !isFace || this.viewer.data.kind !== "model";
    }
    const size = Number(byId("region-size").value) || 0;
    byId("region-entry").textContent = regionEntry(this.edge === null ? "patch" : "curve", name, size);
  }
}
