// SPDX-License-Identifier: BSD-3-Clause
// What is drawn: a surface of triangles with a colour each, lines on it, and marks. All of it is cut
// open by one plane. Shaders of our own, so that no release of three.js paints it otherwise.

const SURFACE_VERTEX = `
attribute vec3 position;
attribute vec3 normal;
attribute vec3 tint;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
varying vec3 place;
varying vec3 towards;
varying vec3 colour;
void main() {
  place = position;
  towards = mat3(modelViewMatrix[0].xyz, modelViewMatrix[1].xyz, modelViewMatrix[2].xyz) * normal;
  colour = tint;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const SURFACE_FRAGMENT = `
precision highp float;
uniform vec4 cut;
varying vec3 place;
varying vec3 towards;
varying vec3 colour;
void main() {
  if (dot(cut.xyz, place) > cut.w) discard;
  float light = 0.5 + 0.38 * abs(towards.z) + 0.12 * abs(towards.y);
  // Of the back of a triangle, which only a cut shows, little of the colour is left.
  vec3 seen = gl_FrontFacing ? colour : mix(colour, vec3(0.55), 0.6);
  gl_FragColor = vec4(light * seen, 1.0);
}`;

const LINE_VERTEX = `
attribute vec3 position;
attribute vec3 tint;
uniform mat4 modelViewMatrix;
uniform mat4 projectionMatrix;
varying vec3 place;
varying vec3 colour;
void main() {
  place = position;
  colour = tint;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  gl_PointSize = 11.0;
}`;

const LINE_FRAGMENT = `
precision highp float;
uniform vec4 cut;
varying vec3 place;
varying vec3 colour;
void main() {
  if (dot(cut.xyz, place) > cut.w) discard;
  gl_FragColor = vec4(colour, 1.0);
}`;

// A disc with a rim, not cut.
const MARK_FRAGMENT = `
precision highp float;
varying vec3 colour;
void main() {
  float radius = length(gl_PointCoord - 0.5);
  if (radius > 0.5) discard;
  gl_FragColor = vec4(radius > 0.34 ? vec3(1.0) : colour, 1.0);
}`;

class Scene {
  // Positions of points, and the corners of triangles, three a triangle.
  constructor(canvas, positions, corners) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.setClearColor(0xffffff, 1);
    this.scene = new THREE.Scene();
    this.cut = { value: new THREE.Vector4(0, 0, 0, 1) };
    this.positions = positions;
    this.surface = this.addSurface(positions, corners);
    this.lines = {};
  }

  addSurface(positions, corners) {
    const geometry = new THREE.BufferGeometry();
    const place = new Float32Array(3 * corners.length);
    for (let c = 0; c < corners.length; ++c) {
      for (let a = 0; a < 3; ++a) place[3 * c + a] = positions[3 * corners[c] + a];
    }
    geometry.setAttribute("position", new THREE.BufferAttribute(place, 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(normalsOf(place), 3));
    geometry.setAttribute("tint", new THREE.BufferAttribute(new Uint8Array(place.length), 3, true));
    const material = new THREE.RawShaderMaterial({
      vertexShader: SURFACE_VERTEX, fragmentShader: SURFACE_FRAGMENT, uniforms: { cut: this.cut },
      side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    });
    const mesh = new THREE.Mesh(geometry, material);
    this.scene.add(mesh);
    return mesh;
  }

  // `colourOf(t)` gives red, green and blue of a triangle, 0…255.
  paint(colourOf) {
    const tint = this.surface.geometry.attributes.tint;
    for (let t = 0; t < tint.array.length / 9; ++t) {
      const colour = colourOf(t);
      for (let i = 0; i < 9; ++i) tint.array[9 * t + i] = colour[i % 3];
    }
    tint.needsUpdate = true;
  }

  // Lines from point to point, two places a line; in place of those of the same name.
  setLines(name, places, colours, { isOnTop = false } = {}) {
    this.setObject(name, THREE.LineSegments, places, colours, {
      fragmentShader: LINE_FRAGMENT, uniforms: { cut: this.cut }, depthTest: !isOnTop,
    });
  }

  setMarks(name, places, colours) {
    this.setObject(name, THREE.Points, places, colours, {
      fragmentShader: MARK_FRAGMENT, uniforms: {}, depthTest: false,
    });
  }

  setObject(name, Kind, places, colours, settings) {
    if (this.lines[name]) {
      this.scene.remove(this.lines[name]);
      this.lines[name].geometry.dispose();
      delete this.lines[name];
    }
    if (places.length === 0) return;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(places), 3));
    geometry.setAttribute("tint", new THREE.BufferAttribute(Uint8Array.from(colours), 3, true));
    const material = new THREE.RawShaderMaterial({ vertexShader: LINE_VERTEX, ...settings });
    this.lines[name] = new Kind(geometry, material);
    this.lines[name].renderOrder = settings.depthTest ? 0 : 1;
    this.scene.add(this.lines[name]);
  }

  show(name, isShown) {
    if (this.lines[name]) this.lines[name].visible = isShown;
  }

  // What has dot(normal, p) > height is cut away; without a normal nothing is.
  setCut(normal, height) {
    if (normal) this.cut.value.set(...normal, height);
    else this.cut.value.set(0, 0, 0, 1);
  }

  isCutAway(p) {
    const { x, y, z, w } = this.cut.value;
    return x * p.x + y * p.y + z * p.z > w;
  }

  resize(width, height) {
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio || 1));
    this.renderer.setSize(width, height, false);
  }

  draw(camera) {
    this.renderer.render(this.scene, camera);
  }

  // What is seen at a place of the canvas, in halves of its sides from its middle: triangle and point.
  hitAt(x, y, camera) {
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2(x, y), camera);
    const hit = ray.intersectObject(this.surface).find(({ point }) => !this.isCutAway(point));
    return hit ? { triangle: hit.faceIndex, point: [hit.point.x, hit.point.y, hit.point.z] } : null;
  }
}

// Of each corner that of its triangle.
function normalsOf(place) {
  const normals = new Float32Array(place.length);
  for (let t = 0; t < place.length; t += 9) {
    const edge = (c) => [0, 1, 2].map((a) => place[t + 3 * c + a] - place[t + a]);
    const normal = unit(cross(edge(1), edge(2)));
    for (let i = 0; i < 9; ++i) normals[t + i] = normal[i % 3];
  }
  return normals;
}

function cross([a, b, c], [x, y, z]) {
  return [b * z - c * y, c * x - a * z, a * y - b * x];
}

function unit(v) {
  const length = Math.hypot(...v) || 1;
  return v.map((x) => x / length);
}
