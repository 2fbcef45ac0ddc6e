// The world in 3D: markers of all agents, bodies of the few that matter, certain balls, trails.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { CSS2DObject, CSS2DRenderer } from "three/addons/renderers/CSS2DRenderer.js";
import { carriedOn, certainRadius, positionAt } from "../model/history.js";
import { LEVELS } from "../model/world.js";
import { Bodies } from "./bodies.js";
import { colorOf, element, quantity } from "./format.js";
import { Markers } from "./markers.js";

const FIELD_OF_VIEW = 50;
const LABELS_MAX = 60;    // A thousand of them would take a frame's time.
const BALLS_MAX = 40;
const TRAILS_MAX = 40;
const TRAIL_S = 20;
const TRAIL_POINTS = 120;

export class Scene3D {
  /** `onChoose(agent)`: somebody clicked one; null: nothing. */
  constructor(world, place, onChoose) {
    this.world = world;
    this.place = place;
    this.origin = [0, 0, 0];  // in the world frame, of what is drawn: close to what is looked at
    this.chosen = null;
    this.follows = false;
    this.shows = { labels: false, trails: true };
    this.aheadS = 1;
    this.wanted = true;
    this.renderer = new THREE.WebGLRenderer({ antialias: false });
    this.labels = new CSS2DRenderer();
    this.labels.domElement.style.pointerEvents = "none";
    place.append(this.renderer.domElement, this.labels.domElement);
    this.renderer.domElement.setAttribute("aria-label", "Agents in 3D");
    this.labels.domElement.style.position = "absolute";
    this.labels.domElement.style.inset = "0";
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 1e9);
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(8, -14, 9);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => (this.wanted = true));
    this.markers = new Markers();
    this.bodies = new Bodies(world);
    this.scene.add(this.markers.points, this.bodies.group, new THREE.HemisphereLight(0xffffff,
      0x556070, 2.2));
    const sun = new THREE.DirectionalLight(0xffffff, 1.4);
    sun.position.set(3, -4, 8);
    this.scene.add(sun);
    this.overlay = new THREE.Group();
    this.scene.add(this.overlay);
    this.named = [];
    this.takeColors();
    place.addEventListener("click", (click) => this.pick(click, onChoose));
    new ResizeObserver(() => this.resize()).observe(place);
    this.resize();
  }

  takeColors() {
    this.renderer.setClearColor(new THREE.Color(colorOf("paper")), 1);
    this.markers.takeColors();
    this.bodies.takeColors();
    this.gridStep = 0;
    this.wanted = true;
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(width, height);
    this.labels.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    const pixels = height * this.renderer.getPixelRatio();
    this.markers.material.uniforms.scale.value =
      pixels / (2 * Math.tan(THREE.MathUtils.degToRad(FIELD_OF_VIEW / 2)));
    this.wanted = true;
  }

  local(p) {
    return [p[0] - this.origin[0], p[1] - this.origin[1], p[2] - this.origin[2]];
  }

  /** Moves the camera so that a ball is seen whole. */
  look(center, radius) {
    const way = this.camera.position.clone().sub(this.controls.target);
    const distance = (1.15 * radius) / Math.sin(THREE.MathUtils.degToRad(FIELD_OF_VIEW / 2));
    this.origin = [...center];
    this.controls.target.set(0, 0, 0);
    this.camera.position.copy(way.setLength(distance));
    this.camera.near = distance / 2000;
    this.camera.far = distance * 2000;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.gridStep = 0;
    this.wanted = true;
  }

  frame(t) {
    const { center, radius } = this.world.extent(t);
    this.look(center, radius);
  }

  /** To the place of an event, with both agents in view. */
  flyTo(event, t) {
    const sides = [event.lower, event.higher].map((side) => this.world.agentOf(side));
    const points = sides.filter((agent) => agent?.history.at(t))
      .map((agent) => positionAt(agent.history.at(t), t));
    const point = event.proximity?.point_m;
    if (point) points.push(point);
    if (points.length === 0) return;
    const center = [0, 1, 2].map((k) => points.reduce((sum, p) => sum + p[k], 0) / points.length);
    const reach = Math.max(...points.map((p) => Math.hypot(...p.map((x, k) => x - center[k]))));
    const own = Math.max(...sides.map((agent) => agent?.declaration.radius_m ?? 0), 0.5);
    this.look(center, reach + 3 * own);
  }

  draw(t) {
    this.wanted = false;
    this.drawnAt = t;
    if (t == null) return this.renderer.render(this.scene, this.camera);
    if (this.follows && this.chosen) this.moveWith(this.chosen, t);
    const p = [0, 0, 0];
    const { agents, departed } = this.world;
    this.markers.update(agents.size + departed.size, (put) => {
      for (const agent of this.world.agentsAt(t)) {
        const state = agent.history.at(t);
        if (!state || agent.declaration.half_space) continue;
        positionAt(state, t, p);
        const hidden = this.bodies.isShown(agent);
        put(p[0] - this.origin[0], p[1] - this.origin[1], p[2] - this.origin[2],
            hidden ? 0 : agent.declaration.radius_m ?? 0, agent.level, agent === this.chosen);
      }
    });
    this.bodies.update(t, this.origin, this.camera.position, this.chosen);
    this.drawOverlay(t);
    this.drawGrid();
    this.renderer.render(this.scene, this.camera);
    this.labels.render(this.scene, this.camera);
  }

  moveWith(agent, t) {
    const state = agent.history.at(t);
    if (state) this.origin = positionAt(state, t);
  }

  /** The agents that matter most, the chosen one and the alerted first. */
  mattering(most) {
    const some = [...this.world.agentsAt(this.drawnAt)].filter((a) =>
      a.level >= 1 || a === this.chosen);
    some.sort((a, b) => (b === this.chosen) - (a === this.chosen) || b.level - a.level);
    return some.slice(0, most);
  }

  drawOverlay(t) {
    for (const old of this.overlay.children) old.geometry?.dispose();
    this.overlay.clear();
    const few = this.mattering(BALLS_MAX);
    for (const agent of few) {
      const state = agent.history.at(t);
      if (!state) continue;
      this.addBall(agent, state, t, 0.55);
      if (agent === this.chosen || few.length <= 12) {
        this.addBall(agent, state, t + this.aheadS, 0.22);
      }
    }
    if (this.shows.trails) {
      for (const agent of this.mattering(TRAILS_MAX)) this.addTrail(agent, t);
    }
    this.drawNames(t);
  }

  /** The ball that contains the agent for certain at `t`. */
  addBall(agent, state, t, opacity) {
    const radius = certainRadius(state, agent.declaration, t, this.world.skew);
    const ball = new THREE.LineSegments(ringsOf(radius), new THREE.LineBasicMaterial({
      color: colorOf("certain"), transparent: true, opacity }));
    ball.position.set(...this.local(carriedOn(state, t)));
    this.overlay.add(ball);
  }

  addTrail(agent, t) {
    const states = agent.history.between(t - TRAIL_S, t).slice(-TRAIL_POINTS);
    if (states.length < 1) return;
    const points = states.map((state) => new THREE.Vector3(...this.local(state.p)));
    points.push(new THREE.Vector3(...this.local(positionAt(states.at(-1), t))));
    const color = agent.level > 0 ? LEVELS[agent.level] : "calm";
    this.overlay.add(new THREE.Line(new THREE.BufferGeometry().setFromPoints(points),
      new THREE.LineBasicMaterial({ color: colorOf(color) })));
  }

  drawNames(t) {
    for (const label of this.named) this.scene.remove(label);
    this.named = [];
    let agents = this.chosen ? [this.chosen] : [];
    if (this.shows.labels) {
      agents = this.mattering(LABELS_MAX);
      for (const agent of this.world.agents.values()) {
        if (agents.length >= LABELS_MAX) break;
        if (!agents.includes(agent)) agents.push(agent);
      }
    }
    for (const agent of agents) {
      const state = agent.history.at(t);
      if (!state) continue;
      const label = new CSS2DObject(element("span", { class: "label" }, agent.info.name));
      label.position.set(...this.local(positionAt(state, t)));
      label.center.set(-0.15, 1.2);
      this.named.push(label);
      this.scene.add(label);
    }
  }

  /** Squares of a power of ten of metres, through the ground of the world or near it. */
  drawGrid() {
    const distance = this.camera.position.distanceTo(this.controls.target);
    const step = 10 ** Math.floor(Math.log10(Math.max(1e-6, distance / 3)));
    if (step !== this.gridStep) {
      this.gridStep = step;
      if (this.grid) {
        this.scene.remove(this.grid);
        for (const part of this.grid.children) {
          part.geometry?.dispose();
          part.element?.remove();
        }
      }
      this.grid = gridOf(step);
      this.scene.add(this.grid);
    }
    const snap = (k) => Math.round(this.origin[k] / step) * step - this.origin[k];
    this.grid.position.set(snap(0), snap(1),
      Math.abs(this.origin[2]) < 30 * step ? -this.origin[2] : snap(2));
  }

  pick(click, onChoose) {
    const box = this.renderer.domElement.getBoundingClientRect();
    const x = ((click.clientX - box.left) / box.width) * 2 - 1;
    const y = 1 - ((click.clientY - box.top) / box.height) * 2;
    const at = new THREE.Vector3();
    let best = null, least = 0.05;
    for (const agent of this.world.agentsAt(this.drawnAt)) {
      const state = agent.history.at(this.drawnAt ?? this.world.time());
      if (!state) continue;
      at.set(...this.local(positionAt(state, this.drawnAt ?? state.t))).project(this.camera);
      const away = Math.hypot((at.x - x) * this.camera.aspect, at.y - y);
      if (at.z < 1 && away < least) [best, least] = [agent, away];
    }
    onChoose(best);
  }
}

/** Three rings: a ball that hides nothing. */
function ringsOf(radius) {
  const points = [], steps = 48;
  for (const [i, k] of [[0, 1], [1, 2], [0, 2]]) {
    for (let n = 0; n < steps; ++n) {
      for (const m of [n, n + 1]) {
        const point = [0, 0, 0], angle = (2 * Math.PI * m) / steps;
        point[i] = radius * Math.cos(angle);
        point[k] = radius * Math.sin(angle);
        points.push(new THREE.Vector3(...point));
      }
    }
  }
  return new THREE.BufferGeometry().setFromPoints(points);
}

/** Lines of a grid in pieces: software rendering leaves out a line that begins behind the eye. */
function gridLines(step, lines) {
  const points = [];
  for (let i = -lines; i <= lines; ++i) {
    for (let k = -lines; k < lines; ++k) {
      points.push(i, k, 0, i, k + 1, 0, k, i, 0, k + 1, i, 0);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3).applyMatrix4(
    new THREE.Matrix4().makeScale(step, step, step)));
  return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: colorOf("line") }));
}

function gridOf(step) {
  const lines = 20;
  const group = new THREE.Group();
  group.add(gridLines(step, lines));
  for (const [name, way] of [["x", [1, 0, 0]], ["y", [0, 1, 0]], ["z", [0, 0, 1]]]) {
    const end = new THREE.Vector3(...way).multiplyScalar(3 * step);
    group.add(new THREE.Line(
      new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(), end]),
      new THREE.LineBasicMaterial({ color: colorOf("ink") })));
    const text = name === "x" ? `x (squares of ${quantity(step, "m")})` : name;
    const label = new CSS2DObject(element("span", { class: "label" }, text));
    label.position.copy(end);
    group.add(label);
  }
  return group;
}
