"use strict";
// The page around the library: its controls choose what is shown of one surface.
const find = (id) => document.getElementById(id);
const decoded = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

async function inflated(text) {
  const stream = new Blob([decoded(text)]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

async function library() {
  const source = new TextDecoder().decode(await inflated(find("library").textContent));
  return new Promise((resolve) => {
    window.define = (name, dependencies, factory) => resolve(factory());
    const script = document.createElement("script");
    script.textContent = source;
    document.head.append(script);
  });
}

// A set of numbers that the library may be asked to show, or nothing.
const numbers = (data) => ({ data, shape: [data.length] });

// a1 is a letter with an index; other names are words.
function typeset(name) {
  const [, letter, index] = /^([ab])(\d+)$/.exec(name) || [];
  if (!letter) return [name];
  const parts = [document.createElement("i"), document.createElement("sub")];
  [letter, index].forEach((text, i) => { parts[i].textContent = text; });
  return parts;
}

function control(kind, name, text, checked, chosen) {
  const label = document.createElement("label");
  const input = Object.assign(document.createElement("input"), { type: kind, name, checked });
  input.addEventListener("change", () => chosen(input.checked));
  label.append(input, text);
  return label;
}

class Viewer {
  constructor(k3d, layers) {
    this.k3d = k3d;
    this.layers = layers;
    this.world = k3d.getWorld();
    const objects = Object.values(this.world.ObjectsListJson);
    this.surface = objects.find((object) => object.name === "surface");
    this.texture = this.surface.texture;
    this.curves = layers.curves.map((_, i) => objects.filter((o) => o.name === `curves ${i}`));
  }

  async paint(i) {
    const layer = this.layers.colourings[i];
    const board = layer.colours === null;
    const colours = board ? [] : new Uint32Array(await inflated(layer.colours));
    Object.assign(this.surface, {
      color: 0xffffff,
      colors: numbers(new Uint32Array(colours)),
      texture: board ? this.texture : numbers(new Uint8Array(0)),
    });
    await this.k3d.reload(this.surface, null);
    find("caption").textContent = layer.caption;
    this.painted = i;
    this.explain();
  }

  async toggle(i, visible) {
    this.layers.curves[i].visible = visible;
    for (const object of this.curves[i]) {
      object.visible = visible;
      await this.k3d.reload(object, null);
    }
    this.explain();
  }

  fade(transparency) {
    this.surface.opacity = 1 - transparency / 100;
    return this.k3d.reload(this.surface, { opacity: this.surface.opacity });
  }

  explain() {
    const shown = this.layers.curves.filter((layer) => layer.visible);
    const entries = [this.layers.colourings[this.painted], ...shown].flatMap((l) => l.legend);
    find("legend").replaceChildren(...entries.map(([name, colour]) => {
      const entry = document.createElement("li"), square = document.createElement("span");
      square.style.background = colour;
      entry.append(square, ...typeset(name));
      return entry;
    }));
  }

  // The whole surface, also where there is more height than width.
  fit() {
    const { clientWidth, clientHeight } = find("scene");
    const [eye, target, up] = [0, 3, 6].map((k) => this.layers.camera.slice(k, k + 3));
    const factor = Math.max(1, clientHeight / clientWidth);
    const place = target.map((x, i) => x + factor * (eye[i] - x));
    this.look([...place, ...target, ...up]);
  }

  // The library draws when the camera has moved, unless it is drawing at that moment.
  look(camera) {
    this.k3d.setCamera(camera);
  }

  // Turn the eye about the middle of what is seen, to the right and upwards, in radians.
  turn(right, up) {
    const { camera, controls } = this.world;
    const target = controls.target.clone();
    const eye = camera.position.clone().sub(target);
    const above = camera.up.clone().normalize();
    const across = above.clone().cross(eye).normalize();
    eye.applyAxisAngle(above, right);
    eye.applyAxisAngle(across, -up);
    const newAbove = eye.clone().cross(across.applyAxisAngle(above, right)).normalize();
    this.look([...target.clone().add(eye).toArray(), ...target.toArray(), ...newAbove.toArray()]);
  }

  approach(factor) {
    const { camera, controls } = this.world;
    const target = controls.target.clone();
    const eye = camera.position.clone().sub(target).multiplyScalar(factor).add(target);
    this.look([...eye.toArray(), ...target.toArray(), ...camera.up.toArray()]);
  }

  press(key) {
    const step = Math.PI / 24;
    const moves = {
      ArrowLeft: () => this.turn(-step, 0),
      ArrowRight: () => this.turn(step, 0),
      ArrowUp: () => this.turn(0, step),
      ArrowDown: () => this.turn(0, -step),
      "+": () => this.approach(1 / 1.1),
      "-": () => this.approach(1.1),
    };
    if (!(key in moves)) return false;
    moves[key]();
    return true;
  }
}

function addControls(viewer) {
  viewer.layers.colourings.forEach((layer, i) => find("colourings").append(
    control("radio", "colouring", layer.name, i === viewer.layers.first, () => viewer.paint(i))));
  viewer.layers.curves.forEach((layer, i) => find("curves").append(
    control("checkbox", "curve", layer.name, layer.visible, (on) => viewer.toggle(i, on))));
  find("curves").hidden = viewer.layers.curves.length === 0;
  find("transparency").addEventListener("input", (event) => viewer.fade(event.target.value));
  find("home").addEventListener("click", () => viewer.fit());
  find("scene").addEventListener("keydown", (event) => {
    if (viewer.press(event.key)) event.preventDefault();
  });
}

async function start() {
  if (!document.createElement("canvas").getContext("webgl2")) {
    find("why").textContent =
      "This browser does not draw with WebGL 2, so the surface cannot be turned here.";
    return null;
  }
  const scene = find("scene"), form = document.querySelector("form");
  scene.hidden = form.hidden = false;
  find("fallback").hidden = true;
  const { CreateK3DAndLoadBinarySnapshot } = await library();
  const data = decoded(find("snapshot").textContent);
  const k3d = await CreateK3DAndLoadBinarySnapshot(data.buffer, scene);
  const viewer = new Viewer(k3d, JSON.parse(find("layers").textContent));
  addControls(viewer);
  await viewer.paint(viewer.layers.first);
  viewer.fit();
  k3d.render(true);
  return viewer;
}

window.viewer = start().catch((error) => {
  find("scene").hidden = document.querySelector("form").hidden = true;
  find("fallback").hidden = false;
  find("why").textContent = `The surface cannot be turned here: ${error.message}`;
  console.error(error);
});
