// SPDX-License-Identifier: BSD-3-Clause
// An eye that turns about a point: far away, without perspective, z is up.

const FULL_TILT = 0.4999 * Math.PI;
const MOST_ZOOM = 1e5;
const FLIGHT_MS = 450;

class Orbit {
  // `onChange` is called whenever there is something new to see.
  constructor(radius, onChange) {
    this.radius = radius;
    this.onChange = onChange;
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 1);
    this.camera.up.set(0, 0, 1);
    this.aspect = 1;
    this.view = { middle: [0, 0, 0], turn: -1.04, tilt: 0.51, height: 2.1 * radius };
  }

  toEye({ turn, tilt } = this.view) {
    return [Math.cos(tilt) * Math.cos(turn), Math.cos(tilt) * Math.sin(turn), Math.sin(tilt)];
  }

  // To the right and upwards on the screen.
  axes() {
    const { turn, tilt } = this.view;
    return {
      right: [-Math.sin(turn), Math.cos(turn), 0],
      up: [-Math.sin(tilt) * Math.cos(turn), -Math.sin(tilt) * Math.sin(turn), Math.cos(tilt)],
    };
  }

  resize(width, height) {
    this.aspect = width / Math.max(1, height);
    this.update();
  }

  update() {
    const { middle, height } = this.view;
    const distance = 4 * this.radius;
    const eye = this.toEye();
    // Before the largest side fits across a narrow canvas, it has to fit along it.
    const half = 0.5 * height / Math.min(1, this.aspect);
    Object.assign(this.camera, {
      left: -half * this.aspect, right: half * this.aspect, top: half, bottom: -half,
      near: 0, far: 2 * distance,
    });
    this.camera.position.set(...middle.map((x, a) => x + distance * eye[a]));
    this.camera.lookAt(...middle);
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    this.onChange();
  }

  // Length of a pixel in the scene, on a canvas so many pixels high.
  pixel(canvasHeight) {
    return (this.camera.top - this.camera.bottom) / canvasHeight;
  }

  turnBy(turn, tilt) {
    this.stop();
    this.view.turn += turn;
    this.view.tilt = Math.max(-FULL_TILT, Math.min(FULL_TILT, this.view.tilt + tilt));
    this.update();
  }

  shiftBy(right, up) {
    this.stop();
    const axes = this.axes();
    this.view.middle = this.view.middle.map((x, a) => x + right * axes.right[a] + up * axes.up[a]);
    this.update();
  }

  // About a point of the screen, given from its middle in halves of its sides.
  zoomBy(factor, x, y) {
    const least = this.radius / MOST_ZOOM;
    const height = Math.max(least, Math.min(10 * this.radius, this.view.height * factor));
    const kept = (1 - height / this.view.height);
    this.shiftBy(kept * x * this.camera.right, kept * y * this.camera.top);
    this.view.height = height;
    this.update();
  }

  stop() {
    cancelAnimationFrame(this.flight);
    this.isFlying = false;
  }

  // Goes to another view, the short way round. What `to` leaves out stays.
  flyTo(to) {
    this.stop();
    const from = { ...this.view };
    const goal = { ...this.view, ...to };
    const way = Math.PI * 2;
    goal.turn = from.turn + (((goal.turn - from.turn) % way) + 1.5 * way) % way - 0.5 * way;
    const begin = performance.now();
    const step = (now) => {
      const time = Math.min(1, Math.max(0, (now - begin) / FLIGHT_MS));
      const share = time * time * (3 - 2 * time);
      const between = (a, b) => a + share * (b - a);
      this.view = {
        middle: from.middle.map((x, a) => between(x, goal.middle[a])),
        turn: between(from.turn, goal.turn),
        tilt: between(from.tilt, goal.tilt),
        height: from.height * (goal.height / from.height) ** share,
      };
      this.isFlying = time < 1;
      this.update();
      if (this.isFlying) this.flight = requestAnimationFrame(step);
    };
    this.isFlying = true;
    this.flight = requestAnimationFrame(step);
  }
}

// Lets pointers turn (drag), shift (drag with Shift or another button, or with two fingers) and zoom
// (wheel, two fingers). `onClick(x, y, event)` of a press that did not move.
function followPointers(canvas, orbit, onClick) {
  const SLACK_PX = 4;
  const pointers = new Map();
  let moved = 0;
  const pixel = () => orbit.pixel(canvas.clientHeight);
  const inHalves = (x, y) => {
    const box = canvas.getBoundingClientRect();
    return [2 * (x - box.left) / box.width - 1, 1 - 2 * (y - box.top) / box.height];
  };
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return { length: Math.hypot(a.x - b.x, a.y - b.y), x: 0.5 * (a.x + b.x), y: 0.5 * (a.y + b.y) };
  };
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    if (pointers.size === 0) moved = 0;
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY, button: event.button });
  });
  canvas.addEventListener("pointermove", (event) => {
    const pointer = pointers.get(event.pointerId);
    if (!pointer) return;
    const before = pointers.size === 2 ? spread() : null;
    const [dx, dy] = [event.clientX - pointer.x, event.clientY - pointer.y];
    moved += Math.abs(dx) + Math.abs(dy);
    if (moved <= SLACK_PX) return;
    Object.assign(pointer, { x: event.clientX, y: event.clientY });
    if (before) {
      const now = spread();
      orbit.shiftBy(-(now.x - before.x) * pixel(), (now.y - before.y) * pixel());
      orbit.zoomBy(before.length / Math.max(1, now.length), ...inHalves(now.x, now.y));
    } else if (event.shiftKey || pointer.button !== 0) {
      orbit.shiftBy(-dx * pixel(), dy * pixel());
    } else {
      const perPixel = Math.PI / canvas.clientWidth;
      orbit.turnBy(-dx * perPixel, dy * perPixel);
    }
  });
  const release = (event) => {
    const pointer = pointers.get(event.pointerId);
    pointers.delete(event.pointerId);
    if (pointer && event.type === "pointerup" && moved <= SLACK_PX && pointer.button === 0) {
      onClick(...inHalves(event.clientX, event.clientY), event);
    }
  };
  canvas.addEventListener("pointerup", release);
  canvas.addEventListener("pointercancel", release);
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const lines = event.deltaMode === 0 ? event.deltaY / 100 : event.deltaY / 3;
    orbit.zoomBy(1.2 ** Math.max(-3, Math.min(3, lines)), ...inHalves(event.clientX, event.clientY));
  }, { passive: false });
}
