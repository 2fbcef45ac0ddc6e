// The real shapes of the agents that matter: chosen, alerted, nearest.
import * as THREE from "three";
import { orientationAt, positionAt } from "../model/history.js";
import { readShape } from "../model/shape.js";
import { LEVELS } from "../model/world.js";
import { colorOf } from "./format.js";

const SHOWN_MAX = 300;

export class Bodies {
  constructor(world) {
    this.world = world;
    this.group = new THREE.Group();
    this.geometries = new Map();  // by hash; null: on its way, or too large
    this.meshes = new Map();      // instanced, by hash
    this.shown = new Set();
    this.material = new THREE.MeshLambertMaterial({ side: THREE.DoubleSide });
    this.takeColors();
  }

  takeColors() {
    this.colors = LEVELS.map((level) => new THREE.Color(colorOf(level)));
  }

  isShown(agent) {
    return this.shown.has(agent);
  }

  /** `eye`: the camera, from `origin` on. */
  update(t, origin, eye, chosen) {
    const p = [0, 0, 0];
    const candidates = [];
    for (const agent of this.world.agentsAt(t)) {
      const hash = agent.declaration.shape_hash;
      const state = hash && agent.history.at(t);
      if (!state || !this.geometryOf(hash)) continue;
      positionAt(state, t, p);
      const away = Math.hypot(p[0] - origin[0] - eye.x, p[1] - origin[1] - eye.y,
                              p[2] - origin[2] - eye.z);
      const weight = agent === chosen ? 1e9 : 1 + 1e3 * agent.level;
      candidates.push({ agent, hash, state, order: away / weight });
    }
    candidates.sort((a, b) => a.order - b.order);
    candidates.length = Math.min(candidates.length, SHOWN_MAX);
    this.shown = new Set(candidates.map((one) => one.agent));
    this.fill(candidates, t, origin);
  }

  fill(candidates, t, origin) {
    const counts = new Map();
    const place = new THREE.Object3D();
    for (const { agent, hash, state } of candidates) {
      const mesh = this.meshOf(hash);
      const i = counts.get(hash) ?? 0;
      counts.set(hash, i + 1);
      const p = positionAt(state, t), [w, x, y, z] = orientationAt(state, t);
      place.position.set(p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]);
      place.quaternion.set(x, y, z, w).normalize();
      place.updateMatrix();
      mesh.setMatrixAt(i, place.matrix);
      mesh.setColorAt(i, this.colors[agent.level]);
    }
    for (const [hash, mesh] of this.meshes) {
      mesh.count = counts.get(hash) ?? 0;
      mesh.instanceMatrix.needsUpdate = true;
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
  }

  meshOf(hash) {
    let mesh = this.meshes.get(hash);
    if (!mesh) {
      mesh = new THREE.InstancedMesh(this.geometries.get(hash), this.material, SHOWN_MAX);
      mesh.frustumCulled = false;
      this.meshes.set(hash, mesh);
      this.group.add(mesh);
    }
    return mesh;
  }

  geometryOf(hash) {
    if (!this.geometries.has(hash) && this.world.shapes.has(hash)) {
      this.geometries.set(hash, null);
      this.fetch(hash);
    }
    return this.geometries.get(hash);
  }

  async fetch(hash) {
    const bytes = await this.world.shapeBytes(hash);
    if (!bytes) return;
    this.geometries.set(hash, readShape(bytes));
    this.world.dispatchEvent(new Event("change"));  // It is drawn, also where time stands still.
  }
}
