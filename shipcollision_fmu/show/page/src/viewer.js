// The picture: the .glb as it is, with sea, sky, wakes, effects and growing scratches around it.
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { Cameras } from "./cameras.js";
import { LIGHT } from "./daylight.js";
import { addDents } from "./dents.js";
import { addEffects } from "./effects.js";
import { addFireLight } from "./fire_light.js";
import { makeFoam } from "./foam.js";
import { HAZE, setHaze } from "./haze.js";
import { makeLabels } from "./labels.js";
import { addLights } from "./lights.js";
import { makePace } from "./pace.js";
import { paintShip } from "./paint.js";
import { makePlainShips } from "./plain_ships.js";
import { growScratches } from "./scratches.js";
import { makeSea } from "./sea.js";
import { makeSky, SUN } from "./sky.js";
import { addSparks } from "./sparks.js";
import { followSky } from "./theme.js";
import { playClip, toWorld } from "./tracks.js";

const SHADOW_REACH = 420; // around what the camera looks at [m]

/** The bearing [rad] from which the picture is seen first; sun and moon stand where they suit it. */
function bearingOf({ camera, controls }) {
  const from = camera.position.clone().sub(controls.target);
  return Math.atan2(from.z, from.x);
}

/** The ships in the order of the scene: node, what is known of them, track. */
function shipsOf(gltf, data, motion) {
  const found = [];
  gltf.scene.traverse((node) => {
    if (node.userData.ship === undefined) return;
    const known = data.ships.find(({ name }) => name === node.userData.ship);
    found.push({ node, info: { ...node.userData, ...known }, track: motion.trackOf(node) });
  });
  return found.sort((a, b) => data.ships.findIndex(({ name }) => name === a.info.name) - data.ships.findIndex(({ name }) => name === b.info.name));
}

/** Whether the processor draws, for want of a graphics card: then pictures are made with less care. */
export function drawsInSoftware() {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

/**
 * A viewer of the scene on a canvas, with smooth edges or without; `show(time)` asks for a picture.
 * `makeMotion(gltf)` is what moves the ships (tracks.js), `CamerasOf` the class of the cameras.
 */
export async function makeViewer(canvas, data, glb, isSmooth, makeMotion = playClip, CamerasOf = Cameras) {
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: isSmooth, alpha: false, preserveDrawingBuffer: true });
  renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
  renderer.toneMapping = THREE.NeutralToneMapping;
  renderer.toneMappingExposure = 1.0;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = THREE.PCFShadowMap;
  renderer.shadowMap.autoUpdate = false;

  const gltf = await new GLTFLoader().parseAsync(glb, "");
  const world = new THREE.Scene();
  world.add(gltf.scene);
  const motion = makeMotion(gltf);
  const ships = shipsOf(gltf, data, motion);
  const sky = makeSky(renderer);
  const foam = makeFoam(ships, renderer);
  const sea = makeSea(ships.map(({ info }) => ({
    halfLength: 0.48 * info.L_oa, halfBreadth: 0.47 * info.B, height: info.height, colour: info.hull,
  })), sky.uniforms, foam.uniforms);
  world.fog = new THREE.Fog(0xffffff, 4000, 22000);
  world.add(...sky.nodes, sea.mesh, ...foam.nodes);
  const { shadow } = sky.sun;
  shadow.mapSize.set(2048, 2048);
  shadow.bias = -0.0005;
  shadow.normalBias = 0.4;
  Object.assign(shadow.camera, { left: -SHADOW_REACH, right: SHADOW_REACH, top: SHADOW_REACH, bottom: -SHADOW_REACH, near: 10, far: 3000 });
  sky.sun.castShadow = true;

  gltf.scene.traverse((node) => {
    if (node.isMesh && node.userData.scratch === undefined) {
      node.castShadow = true;
      node.receiveShadow = true;
    }
  });
  for (const { node, info } of ships) paintShip(node, Math.min(1, info.B / 9), info.height, sky.uniforms);
  const panes = new Set(); // windows, lit when it is dark
  gltf.scene.traverse(({ material }) => material?.name === "windows" && panes.add(material));
  const labels = makeLabels(ships, canvas);
  canvas.after(labels.node);
  const lights = addLights(gltf.scene);
  const scratches = growScratches(gltf.scene);
  const showSparks = addSparks(gltf.scene);
  const effects = [addEffects(data.effects, ships, data.start)];
  const plainShips = makePlainShips(gltf.scene, ships);
  const dents = [addDents(data.dents ?? [], ships)];
  const burns = ({ kind }) => kind === "fire" || kind === "explosion";
  const fires = data.effects.filter(burns); // that light hulls, water and dents
  const fireLight = addFireLight(world);
  let wind;
  const setWind = (velocity) => sea.setWind(Math.hypot(...(wind = velocity)));
  setWind(data.wind ?? [0, 0]);

  const moved = []; // what else follows the time

  let time = data.start;
  let wanted = false;
  let shadowOf = "";
  let hour = "day", shownHour = "";
  let plain = !isSmooth;
  const pace = makePace();
  const shown = { triangles: 0, effects: 0, dents: [], sparks: 0, lights: lights.count, frames: 0 };
  const cameras = new CamerasOf(canvas, ships, data, () => want());

  function pose() {
    motion.pose(time - data.start);
    for (const move of moved) move(time);
    gltf.scene.updateMatrixWorld(true);
    shown.triangles = scratches.show(time - data.start);
    shown.sparks = showSparks(time - data.start);
    shown.dents = dents.flatMap(({ show }) => show(time, fires));
    shown.effects = effects.reduce((count, { show }) => count + show(time, plain, wind), 0);
    fireLight.show(time, fires, ships);
  }

  function draw() {
    wanted = false;
    if (hour !== shownHour) paintSky();
    if (pace.next(performance.now())) setSharpness();
    pose();
    cameras.follow(time);
    const { camera, controls } = cameras;
    foam.draw(time - data.start, controls.target, camera.position.distanceTo(controls.target));
    setHaze(Math.max(9000, 4 * camera.position.distanceTo(controls.target))); // it must not hide what is looked at
    lights.update();
    sea.update(time, camera, ships.map(({ node }) => ({
      position: node.getWorldPosition(new THREE.Vector3()),
      ahead: new THREE.Vector3(1, 0, 0).transformDirection(node.matrixWorld),
    })));
    Object.assign(world.fog, { near: HAZE.uNear.value, far: HAZE.uFar.value });
    plainShips.update(camera, canvas.height);
    sky.sun.target.position.copy(controls.target);
    sky.sun.position.copy(controls.target).addScaledVector(SUN, 1200);
    const seen = `${time} ${controls.target.toArray()}`;
    renderer.shadowMap.needsUpdate = seen !== shadowOf;
    shadowOf = seen;
    renderer.render(world, camera);
    labels.update(camera, cameras.free);
    shown.frames++;
  }

  function paintSky() {
    shownHour = hour;
    sky.setSky(hour, bearing, plain);
    world.fog.color.copy(LIGHT.uHorizon.value);
    for (const pane of panes) pane.emissive.setRGB(1.0, 0.74, 0.38).multiplyScalar(0.55 * LIGHT.uLamps.value);
    shadowOf = "";
  }

  function setSky(name) {
    hour = name;
    followSky(name === "night");
    want();
  }

  function want() {
    if (wanted) return;
    wanted = true;
    requestAnimationFrame(() => wanted && draw());
  }

  function resize() {
    const { clientWidth, clientHeight } = canvas;
    if (!clientWidth || !clientHeight) return;
    renderer.setSize(clientWidth, clientHeight, false);
    cameras.resize(clientWidth, clientHeight);
    want();
  }

  function setSharpness() {
    renderer.setPixelRatio(plain ? pace.share : Math.min(window.devicePixelRatio, 2));
    want();
  }

  pose();
  resize();
  cameras.choose("all", time);
  const bearing = bearingOf(cameras);
  new ResizeObserver(resize).observe(canvas);

  return {
    canvas,
    cameras,
    ships,
    shown,
    draw,
    show(newTime) {
      time = newTime;
      want();
    },
    /** Draws a time at once: for whoever is in a frame of its own. */
    showNow(newTime) {
      time = newTime;
      draw();
    },
    chooseCamera(mode) {
      pose();
      cameras.choose(mode, time);
      want();
    },
    /** Adds a node to the world, which `move(time)` puts in its place. */
    add(node, move) {
      world.add(node);
      moved.push(move);
      want();
    },
    /** Adds effects of a collision that has happened since; returns what takes them away again. */
    addEffects(more) {
      const added = addEffects(more, ships, data.start);
      const burning = more.filter(burns);
      effects.push(added);
      fires.push(...burning);
      return () => {
        added.remove();
        effects.splice(effects.indexOf(added), 1);
        for (const fire of burning) fires.splice(fires.indexOf(fire), 1);
      };
    },
    /** Adds dents of a collision that has happened since; returns what takes them away again. */
    addDents(more) {
      const added = addDents(more, ships);
      dents.push(added);
      return () => (added.remove(), dents.splice(dents.indexOf(added), 1));
    },
    setSky,
    /** Velocity of the air, north and east [m/s]: smoke goes with it, and crests break. */
    setWind,
    /** Plain: a flat sea, light worked out at corners, no shadows, and no more pixels than the screen's own. For processors that draw. */
    setPlain(isPlain) {
      plain = isPlain;
      for (const { show } of dents) show(-Infinity, fires); // the ships that are made now are whole
      sea.setPlain(isPlain);
      foam.setPlain(isPlain);
      plainShips.setPlain(isPlain);
      scratches.setPlain(isPlain);
      sky.sun.castShadow = !isPlain;
      shownHour = ""; // drawn anew, in the detail that is wanted now
      setSharpness();
    },
    /** While the run plays, a plain picture may have fewer pixels, so that it keeps its pace; at rest it has all. */
    setPlaying(isPlaying) {
      if (pace.setPlaying(isPlaying)) setSharpness();
    },
    /** What the last picture was made of: kinds of materials, number of triangles, share of the screen's pixels in each direction. */
    made() {
      const kinds = new Set();
      world.traverseVisible(({ material }) => material && kinds.add(material.type));
      return { materials: [...kinds], triangles: renderer.info.render.triangles, share: renderer.getPixelRatio() };
    },
    /** Where a point in n [m] is in the picture: [x, y] in CSS pixels from the canvas's top left. */
    project([north, east, down]) {
      const [n0, e0, d0] = data.origin;
      const point = toWorld(new THREE.Vector3(north - n0, east - e0, down - d0)).project(cameras.camera);
      return [((point.x + 1) / 2) * canvas.clientWidth, ((1 - point.y) / 2) * canvas.clientHeight];
    },
    /** Place of the eye in n [m]. */
    eye() {
      const { x, y, z } = cameras.camera.position;
      return [x, z, -y].map((value, i) => value + data.origin[i]);
    },
    /** Position in n [m] and quaternion of R_nb of each ship as it is drawn. */
    poses() {
      return Object.fromEntries(
        ships.map(({ node, info }) => [info.name, { position: node.position.toArray().map((x, i) => x + data.origin[i]), quaternion: node.quaternion.toArray() }]),
      );
    },
  };
}
