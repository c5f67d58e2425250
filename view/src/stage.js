// Three-dimensional picture of the robot in its room. It knows three.js and no component.

import {
  AmbientLight,
  BoxGeometry,
  BufferGeometry,
  CapsuleGeometry,
  Color,
  CylinderGeometry,
  DirectionalLight,
  Float32BufferAttribute,
  GridHelper,
  Group,
  HemisphereLight,
  Line,
  LineBasicMaterial,
  LineDashedMaterial,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  PerspectiveCamera,
  Quaternion,
  Scene,
  SphereGeometry,
  Vector3,
  WebGLRenderer,
} from "three";

const RED = 0xd92d20;
const WITNESS = 0x1570ef;

function geometry(kind, size) {
  if (kind === "box") return new BoxGeometry(2 * size[0], 2 * size[1], 2 * size[2]);
  // The axis of three's solids is y, ours is z.
  if (kind === "cylinder") return new CylinderGeometry(size[0], size[0], 2 * size[1], 24).rotateX(Math.PI / 2);
  if (kind === "capsule" && size[1] === 0) return new SphereGeometry(size[0], 20, 14);
  if (kind === "capsule") return new CapsuleGeometry(size[0], 2 * size[1], 6, 16).rotateX(Math.PI / 2);
  return null;
}

function solid([kind, size, centre, axes], material) {
  const shape = geometry(kind, size);
  if (!shape) return null;
  const mesh = new Mesh(shape, material);
  const [x, y, z] = [0, 3, 6].map((k) => new Vector3(axes[k], axes[k + 1], axes[k + 2]));
  // A capsule only says its own axis.
  if (kind === "capsule") {
    mesh.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), z);
    mesh.position.fromArray(centre);
  } else {
    mesh.applyMatrix4(new Matrix4().makeBasis(x, y, z).setPosition(...centre));
  }
  return mesh;
}

function place(object, pose) {
  object.position.set(pose[0], pose[1], pose[2]);
  object.quaternion.copy(new Quaternion(pose[3], pose[4], pose[5], pose[6]).normalize());
}

const paint = ([r, g, b], more = {}) => new MeshLambertMaterial({ color: new Color(r / 255, g / 255, b / 255), ...more });

function way(points, material, lift = 0) {
  const numbers = points.flatMap(([x, y, z]) => [x, y, lift || z]);
  const line = new Line(new BufferGeometry().setAttribute("position", new Float32BufferAttribute(numbers, 3)), material);
  if (material.isLineDashedMaterial) line.computeLineDistances();
  return line;
}

/** Draws a world into an element, and puts the names of things over it. Throws where there is no WebGL. */
export class Stage {
  #scene = new Scene();
  #camera = new PerspectiveCamera(45, 1, 0.05, 200);
  #target = new Vector3(0, 0, 0.5);
  #orbit = { turn: -2.2, tilt: 0.75, far: 6 };
  #things = new Map();
  #ghosts = new Map();
  #robot = [];
  #end = [];
  #ways = new Group();
  #labels;
  #is_due = false;

  constructor(canvas, labels, world, is_dark) {
    this.canvas = canvas;
    this.#labels = labels;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#camera.up.set(0, 0, 1);
    this.#scene.add(new AmbientLight(0xffffff, 0.7), new HemisphereLight(0xffffff, 0x8a8a8a, 1.3));
    const sun = new DirectionalLight(0xffffff, 1.6);
    sun.position.set(3, -4, 8);
    this.#scene.add(sun, this.#ways);
    this.#build(world, is_dark);
    this.#listen();
  }

  #build(world, is_dark) {
    for (const thing of world.things) this.#add_thing(thing);
    const robot = paint([225, 228, 232]);
    const dark = paint([120, 126, 136]);
    const end = new MeshLambertMaterial({ color: WITNESS, transparent: true, opacity: 0.22, depthWrite: false });
    const parts = (list, material) => {
      world.robot.parts.forEach(([link, shape], i) => {
        if (link === null) return;
        list[link] ??= new Group();
        const mesh = solid(shape, material ?? (i % 3 === 2 ? dark : robot));
        if (mesh) list[link].add(mesh);
      });
      for (const group of list) if (group) this.#scene.add(group);
    };
    parts(this.#robot);
    parts(this.#end, end);
    // The room without its floor marks gives the view.
    const places = world.things.filter((thing) => thing.shape).map((thing) => thing.at);
    const xs = [...places.map((at) => at[0]), world.pose[0]?.[0] ?? 0];
    const ys = [...places.map((at) => at[1]), world.pose[0]?.[1] ?? 0];
    const [left, right, front, back] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    this.#target.set((left + right) / 2, (front + back) / 2, 0.5);
    const size = Math.max(right - left, back - front, 2);
    this.#orbit.far = size * 1.25 + 1.5;
    const cells = Math.ceil(size + 3);
    const grid = new GridHelper(cells, cells, is_dark ? 0x4a5160 : 0xb8bec9, is_dark ? 0x333a47 : 0xd7dbe2);
    grid.rotateX(Math.PI / 2).position.set(Math.round(this.#target.x), Math.round(this.#target.y), 0);
    this.#scene.add(grid);
  }

  #add_thing(thing) {
    const group = new Group();
    const is_mark = thing.kind === "Place" || thing.kind === "Zone";
    const is_hollow = thing.kind === "Container" && !thing.moving;
    const material = paint(thing.colour, is_mark || is_hollow ? { transparent: true, opacity: 0.35, depthWrite: false } : {});
    if (thing.moving) {
      // Their solids are in the map.
      const moving = new Group();
      for (const each of thing.still) group.add(solid(each, material) ?? new Group());
      for (const each of thing.moving) moving.add(solid(each, material) ?? new Group());
      group.add(moving);
      this.#things.set(thing.id, { thing, group, material, moving, fixed: true });
    } else {
      const shape = thing.shape && geometry(...thing.shape);
      if (shape) group.add(new Mesh(shape, material));
      place(group, thing.at);
      this.#things.set(thing.id, { thing, group, material, fixed: false });
    }
    this.#scene.add(group);
    const label = document.createElement("div");
    label.textContent = thing.name;
    label.className = ["Surface", "Container", "Place", "Zone"].includes(thing.kind) ? "tag quiet" : "tag";
    this.#labels.append(label);
    this.#things.get(thing.id).label = label;
  }

  /** Shows poses, the paths of what runs, what blocks it, and where things were believed. */
  show({ pose, things, told, paths, blocked, facts, held }) {
    this.#robot.forEach((group, i) => group && pose?.[i] && place(group, pose[i]));
    for (const [id, one] of this.#things) {
      const at = things[id] ?? one.thing.at;
      if (one.fixed) {
        const open = facts[`open(${id})`] ?? one.thing.open;
        if (open) place(one.moving, one.thing.opened);
        else place(one.moving, [0, 0, 0, 0, 0, 0, 1]);
      } else place(one.group, at);
      one.at = one.fixed ? one.thing.at : at;
      one.material.emissive.setHex(blocked.includes(id) ? RED : 0);
      one.label.classList.toggle("blocked", blocked.includes(id));
      one.label.classList.toggle("held", held.includes(id));
      this.#believed(id, one, told && !one.fixed && things[id] && apart(things[id], one.thing.at) > 0.03 && !held.includes(`was ${id}`));
    }
    const last = paths.at(-1);
    this.#end.forEach((group, i) => {
      if (!group) return;
      group.visible = Boolean(last?.end?.[i]);
      if (group.visible) place(group, last.end[i]);
    });
    for (const old of this.#ways.children) old.geometry.dispose();
    this.#ways.clear();
    const line = new LineBasicMaterial({ color: WITNESS });
    for (const path of paths) {
      if (path.base.length > 1) this.#ways.add(way(path.base.map(([x, y]) => [x, y, 0]), line, 0.02));
      if (path.hand.length > 1) this.#ways.add(way(path.hand, new LineDashedMaterial({ color: WITNESS, dashSize: 0.05, gapSize: 0.03 })));
    }
    this.draw();
  }

  #believed(id, one, is_shown) {
    let ghost = this.#ghosts.get(id);
    if (is_shown && !ghost && one.thing.shape) {
      ghost = new Mesh(geometry(...one.thing.shape), paint(one.thing.colour, { transparent: true, opacity: 0.3, depthWrite: false }));
      place(ghost, one.thing.at);
      this.#scene.add(ghost);
      this.#ghosts.set(id, ghost);
    }
    if (ghost) ghost.visible = Boolean(is_shown);
  }

  /** Draws at the next frame. */
  draw() {
    if (this.#is_due) return;
    this.#is_due = true;
    requestAnimationFrame(() => {
      this.#is_due = false;
      const { clientWidth: w, clientHeight: h } = this.canvas.parentElement;
      if (!w || !h) return;
      this.renderer.setSize(w, h, false);
      this.#camera.aspect = w / h;
      this.#camera.updateProjectionMatrix();
      const { turn, tilt, far } = this.#orbit;
      // A narrow picture needs more distance for the same room.
      const reach = far * Math.max(1, 1.1 / this.#camera.aspect);
      const flat = Math.cos(tilt) * reach;
      this.#camera.position.set(
        this.#target.x + Math.cos(turn) * flat,
        this.#target.y + Math.sin(turn) * flat,
        this.#target.z + Math.sin(tilt) * reach,
      );
      this.#camera.lookAt(this.#target);
      this.renderer.render(this.#scene, this.#camera);
      this.#write(w, h);
    });
  }

  #write(w, h) {
    const taken = [];
    const point = new Vector3();
    // Red and held names come first: a name that would cover another is left out.
    const order = [...this.#things.values()].sort((one, other) => rank(one) - rank(other));
    for (const { label, at, thing } of order) {
      const top = thing.shape ? (thing.shape[0] === "box" ? thing.shape[1][2] : thing.shape[1][1]) : 0.1;
      point.set(at[0], at[1], at[2] + Math.min(top, 1) + 0.06).project(this.#camera);
      const [x, y] = [((point.x + 1) / 2) * w, ((1 - point.y) / 2) * h];
      const half = label.textContent.length * 3.4 + 6;
      const is_free = taken.every(([a, b, other]) => Math.abs(a - x) > half + other || Math.abs(b - y) > 17);
      const is_seen = point.z < 1 && x > half && x < w - half && y > 10 && y < h && is_free;
      label.style.display = is_seen ? "" : "none";
      if (is_seen) {
        label.style.transform = `translate(${x.toFixed(0)}px, ${y.toFixed(0)}px) translate(-50%, -100%)`;
        taken.push([x, y, half]);
      }
    }
  }

  #listen() {
    const { canvas } = this;
    const fingers = new Map();
    const move = (dx, dy, is_shift) => {
      if (is_shift) {
        const { turn, far } = this.#orbit;
        const k = far / 700;
        this.#target.x += (Math.sin(turn) * dx - -Math.cos(turn) * -dy) * k;
        this.#target.y += (-Math.cos(turn) * dx + -Math.sin(turn) * dy) * k;
      } else {
        this.#orbit.turn -= dx * 0.008;
        this.#orbit.tilt = Math.min(1.55, Math.max(0.03, this.#orbit.tilt + dy * 0.006));
      }
      this.draw();
    };
    /** Point at the height of the target under the pointer; null above the horizon. */
    const under = ({ clientX, clientY }) => {
      const { left, top, width, height } = canvas.getBoundingClientRect();
      const eye = this.#camera.position;
      const ray = new Vector3(((clientX - left) / width) * 2 - 1, 1 - ((clientY - top) / height) * 2, 0.5);
      ray.unproject(this.#camera).sub(eye);
      const far = (this.#target.z - eye.z) / ray.z;
      return far > 0 ? eye.clone().addScaledVector(ray, far) : null;
    };
    /** Comes closer or goes away; the point `at` stays where it is in the picture. */
    const zoom = (by, at = null) => {
      const before = this.#orbit.far;
      this.#orbit.far = Math.min(60, Math.max(0.6, before * by));
      if (at && at.distanceTo(this.#target) < 2 * before) {
        const share = 1 - this.#orbit.far / before;
        this.#target.x += (at.x - this.#target.x) * share;
        this.#target.y += (at.y - this.#target.y) * share;
      }
      this.draw();
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, event);
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = fingers.get(event.pointerId);
      if (!before) return;
      if (fingers.size === 2) {
        const other = [...fingers.entries()].find(([id]) => id !== event.pointerId)[1];
        const gap = (one) => Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
        zoom(gap(before) / Math.max(gap(event), 1));
      } else move(event.clientX - before.clientX, event.clientY - before.clientY, event.shiftKey || event.buttons === 4);
      fingers.set(event.pointerId, event);
    });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
    canvas.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        zoom(Math.exp(event.deltaY * 0.001), under(event));
      },
      { passive: false },
    );
    canvas.addEventListener("keydown", (event) => {
      const by = { ArrowLeft: [-20, 0], ArrowRight: [20, 0], ArrowUp: [0, 20], ArrowDown: [0, -20] }[event.key];
      if (by) move(by[0], by[1], event.shiftKey);
      else if (event.key === "+" || event.key === "-") zoom(event.key === "+" ? 0.85 : 1.18);
      else return;
      event.preventDefault();
    });
    new ResizeObserver(() => this.draw()).observe(canvas.parentElement);
  }

  close() {
    this.renderer.dispose();
    this.#labels.replaceChildren();
  }
}

const rank = ({ label, thing }) =>
  label.classList.contains("blocked") ? 0 : label.classList.contains("held") ? 1 : thing.kind === "Object" ? 2 : thing.kind === "Person" ? 3 : 4;

/** Distance of two poses in m. */
export const apart = (one, other) => Math.hypot(one[0] - other[0], one[1] - other[1], one[2] - other[2]);
