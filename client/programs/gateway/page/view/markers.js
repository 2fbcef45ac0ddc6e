// All agents as shaded points in one draw.
import * as THREE from "three";
import { colorOf } from "./format.js";

const VERTEX = `
attribute float radius;
attribute float level;
uniform float scale;       // pixels of a metre at distance 1
uniform float pixelsLeast;
varying float vLevel;
varying float vPixels;
void main() {
  vec4 eye = modelViewMatrix * vec4(position, 1.0);
  float pixels = 2.0 * radius * scale / max(1e-6, -eye.z);
  vLevel = level;
  vPixels = clamp(pixels, pixelsLeast + 3.0 * min(level, 1.0), 1000.0);
  gl_PointSize = vPixels;
  gl_Position = projectionMatrix * eye;
}`;

// A ball that is lit from above; each level has a shape of its own beside its colour: a ring, a
// rhomb, a cross.
const FRAGMENT = `
uniform vec3 colors[5];    // calm, possible, soon, contact, chosen
uniform vec3 ink;
varying float vLevel;
varying float vPixels;
void main() {
  vec2 at = 2.0 * gl_PointCoord - 1.0;
  float r = length(at);
  bool chosen = vLevel >= 8.0;
  int level = int(mod(vLevel, 8.0) + 0.5);
  float edge = level == 2 ? abs(at.x) + abs(at.y) : r;
  if (edge > 1.0) discard;
  float light = 0.75 + 0.35 * sqrt(max(0.0, 1.0 - r * r)) - 0.12 * at.y;
  vec3 color = level == 0 ? colors[0] : level == 1 ? colors[1] : level == 2 ? colors[2] : colors[3];
  color *= light;
  float line = 3.0 / vPixels;
  if (level == 1 && vPixels > 16.0 && r < 0.72 && r > 0.72 - line) color = ink;
  if (level == 3 && vPixels > 10.0 && abs(abs(at.x) - abs(at.y)) < line) color = ink;
  if (chosen && edge > 1.0 - 2.0 * line) color = colors[4];
  gl_FragColor = vec4(color, 1.0);
  #include <colorspace_fragment>
}`;

const CHOSEN = 8;

/** Draws points about an origin that moves with the camera, so that far ones do not tremble. */
export class Markers {
  constructor() {
    this.capacity = 0;
    this.material = new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: {
        scale: { value: 1 },
        pixelsLeast: { value: 5 },
        colors: { value: [] },
        ink: { value: new THREE.Color() },
      },
    });
    this.points = new THREE.Points(new THREE.BufferGeometry(), this.material);
    this.points.frustumCulled = false;
    this.reserve(1);
    this.takeColors();
  }

  takeColors() {
    const names = ["calm", "possible", "soon", "contact", "ink"];
    this.material.uniforms.colors.value = names.map((name) => new THREE.Color(colorOf(name)));
    this.material.uniforms.ink.value = new THREE.Color(colorOf("ink"));
  }

  reserve(count) {
    if (count <= this.capacity) return;
    this.capacity = Math.max(64, 2 * count);
    const geometry = new THREE.BufferGeometry();
    const add = (name, size) => {
      const attribute = new THREE.BufferAttribute(new Float32Array(this.capacity * size), size);
      attribute.setUsage(THREE.DynamicDrawUsage);
      geometry.setAttribute(name, attribute);
    };
    add("position", 3);
    add("radius", 1);
    add("level", 1);
    this.points.geometry.dispose();
    this.points.geometry = geometry;
  }

  /** `each(put)` calls put(x, y, z, radius, level, isChosen) for every agent. */
  update(count, each) {
    this.reserve(count);
    const { position, radius, level } = this.points.geometry.attributes;
    let i = 0;
    each((x, y, z, r, alert, isChosen) => {
      position.array[3 * i] = x;
      position.array[3 * i + 1] = y;
      position.array[3 * i + 2] = z;
      radius.array[i] = r;
      level.array[i] = alert + (isChosen ? CHOSEN : 0);
      ++i;
    });
    for (const attribute of [position, radius, level]) attribute.needsUpdate = true;
    this.points.geometry.setDrawRange(0, i);
    return i;
  }
}
