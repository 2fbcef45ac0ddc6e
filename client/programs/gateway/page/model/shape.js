// Shapes from their bytes (idl/shape_bytes.h) to what three draws.
import * as THREE from "three";
import { ConvexGeometry } from "three/addons/geometries/ConvexGeometry.js";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

const BALL = 1, CAPSULE = 2, BOX = 3, ELLIPSOID = 4, HULL = 5, CYLINDER = 6, CONE = 7;
const TRIANGLES_MAX = 200000;

/** A geometry in the body frame; null: it is too large to draw, or no shape. */
export function readShape(buffer) {
  const view = new DataView(buffer);
  const u32 = (at) => view.getUint32(at, true);
  const version = view.getUint8(7);
  const vertices = u32(8), triangles = u32(12);
  if (triangles > TRIANGLES_MAX) return null;
  const solids = version === 2 ? u32(16) : 0;
  let at = version === 2 ? 24 : 16;
  const parts = [];
  if (triangles > 0) {
    const positions = new Float32Array(3 * vertices);
    for (let i = 0; i < positions.length; ++i) positions[i] = view.getFloat64(at + 8 * i, true);
    const indices = new Uint32Array(3 * triangles);
    for (let i = 0; i < indices.length; ++i) indices[i] = u32(at + 24 * vertices + 4 * i);
    const mesh = new THREE.BufferGeometry();
    mesh.setAttribute("position", new THREE.BufferAttribute(positions, 3));
    mesh.setIndex(new THREE.BufferAttribute(indices, 1));
    parts.push(mesh);
  }
  at += 24 * vertices + 12 * triangles;
  let points = at + 96 * solids;
  for (let i = 0; i < solids; ++i, at += 96) {
    const count = u32(at + 4);
    const f64 = Array.from({ length: 11 }, (_, k) => view.getFloat64(at + 8 + 8 * k, true));
    const hull = Array.from({ length: count }, (_, k) => new THREE.Vector3(
      ...[0, 8, 16].map((offset) => view.getFloat64(points + 24 * k + offset, true))));
    points += 24 * count;
    parts.push(solidGeometry(u32(at), f64, hull));
  }
  return join(parts);
}

/** `numbers`: position, orientation (w x y z), half extents, rounding. */
function solidGeometry(kind, numbers, hull) {
  const [px, py, pz, qw, qx, qy, qz, hx, hy, hz, rounding] = numbers;
  const upright = (geometry) => geometry.rotateX(Math.PI / 2);  // three's axis is y, ours z
  let made;
  switch (kind) {
    case BALL: made = new THREE.SphereGeometry(rounding, 24, 16); break;
    case CAPSULE: made = upright(new THREE.CapsuleGeometry(rounding, 2 * hz, 8, 20)); break;
    case BOX:
      made = new THREE.BoxGeometry(2 * (hx + rounding), 2 * (hy + rounding), 2 * (hz + rounding));
      break;
    case ELLIPSOID: made = new THREE.SphereGeometry(1, 24, 16).scale(hx, hy, hz); break;
    case HULL: made = new ConvexGeometry(hull); break;
    case CYLINDER:
      made = upright(new THREE.CylinderGeometry(hx + rounding, hx + rounding, 2 * (hz + rounding),
                                                28));
      break;
    case CONE:
      made = upright(new THREE.ConeGeometry(hx + rounding, 2 * (hz + rounding), 28));
      break;
    default: made = new THREE.SphereGeometry(Math.max(hx, rounding), 12, 8);
  }
  made.applyQuaternion(new THREE.Quaternion(qx, qy, qz, qw));
  return made.translate(px, py, pz);
}

function join(parts) {
  if (parts.length === 0) return null;
  const plain = parts.map((part) => {
    const one = part.index ? part.toNonIndexed() : part;
    for (const name of Object.keys(one.attributes)) {
      if (name !== "position") one.deleteAttribute(name);
    }
    return one;
  });
  const all = plain.length === 1 ? plain[0] : mergeGeometries(plain);
  all.computeVertexNormals();
  return all;
}
