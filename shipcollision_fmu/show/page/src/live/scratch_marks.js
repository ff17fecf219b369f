// Scratches while a run goes on: a stroke to each contact point, on the hulls of both ships. They are those that
// the server has kept, the latest places, thinned, straight in between; the debriefing has the whole line.
import * as THREE from "three";

const MOST = 500; // strokes on a ship; the oldest go
const RECENT = 5; // a stroke begins at a place that was touched so long before at most [s],
const NEAR = 30; // and so far away [m]
const LIFT = 0.12; // over the plating [m]
const MATERIAL = new THREE.MeshLambertMaterial({ color: "#ff7a2e", side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2 });

/** The breadth of a scratch [m], as in the .glb (show/gltf/ribbons.py). */
const breadthOf = (length) => 2 * Math.min(0.6, Math.max(0.02, 0.0016 * length));

class MarkedShip {
  constructor({ node, info }) {
    Object.assign(this, { node, breadth: breadthOf(info.L_oa), marks: [] });
    this.mesh = new THREE.InstancedMesh(new THREE.PlaneGeometry(this.breadth, this.breadth), MATERIAL, MOST);
    this.mesh.count = 0;
    this.mesh.frustumCulled = false; // its bounds would be those of the first marks
    this.mesh.userData.scratch = true; // nothing that hides a place of impact
    node.add(this.mesh);
  }

  /** A stroke to a place, which lay() then draws, on the side to which `outwards` points, both in b; `other` is what touches there. */
  add(time, other, place, outwards) {
    const away = (mark) => mark.place.distanceTo(place);
    if (this.marks.some((mark) => away(mark) < 0.5 * this.breadth)) return;
    const before = this.marks.filter((mark) => mark.other === other && time - mark.time < RECENT && away(mark) < NEAR);
    const from = before.sort((a, b) => away(a) - away(b))[0]?.place ?? place;
    this.marks.push({ time, other, from, place, outwards });
    if (this.marks.length > MOST) this.marks.shift();
  }

  forget(time) {
    this.marks = this.marks.filter((mark) => mark.time <= time);
  }

  lay() {
    const [matrix, along, across] = [new THREE.Matrix4(), new THREE.Vector3(), new THREE.Vector3()];
    this.marks.forEach(({ from, place, outwards }, i) => {
      along.subVectors(place, from);
      const longer = 1 + along.length() / this.breadth;
      if (longer === 1) along.set(Math.abs(outwards.z) > 0.9 ? 1 : 0, 0, 1); // a dent: any direction in the plating
      across.crossVectors(outwards, along).normalize();
      along.crossVectors(across, outwards).normalize().multiplyScalar(longer);
      matrix.makeBasis(along, across, outwards).setPosition(from.clone().lerp(place, 0.5).addScaledVector(outwards, LIFT));
      this.mesh.setMatrixAt(i, matrix);
    });
    this.mesh.count = this.marks.length;
    this.mesh.instanceMatrix.needsUpdate = true;
  }
}

/** Strokes on `ships`, [{node, info}]. */
export function makeScratchMarks(ships) {
  const marked = new Map(ships.map((ship) => [ship.info.name, new MarkedShip(ship)]));
  const lay = () => marked.forEach((ship) => ship.lay()); // once for all touches of a message
  return {
    /** Draws to places of contact, [{time, ship_a, ship_b, a, b, normal_a, normal_b}] by time. */
    add(touches) {
      for (const { time, ship_a, ship_b, a, b, normal_a, normal_b } of touches) {
        marked.get(ship_a)?.add(time, ship_b, new THREE.Vector3(...a), new THREE.Vector3(...normal_a));
        marked.get(ship_b)?.add(time, ship_a, new THREE.Vector3(...b), new THREE.Vector3(...normal_b).negate());
      }
      lay();
    },
    /** Draws to those, and no others. */
    restore(touches) {
      this.forget(-Infinity);
      this.add(touches);
    },
    /** Time has gone back: what is scratched later is not scratched. */
    forget(time) {
      for (const ship of marked.values()) ship.forget(time);
      lay();
    },
    /** Where strokes end in b, by ship. */
    get places() {
      return Object.fromEntries([...marked].map(([name, { marks }]) => [name, marks.map(({ place }) => place.toArray())]));
    },
  };
}
