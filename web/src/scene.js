// The moving shape in WebGL. The shape is an attribute of the vertices, so that a frame changes one number.

import { BufferAttribute, BufferGeometry, Color, ConeGeometry, CylinderGeometry, DataTexture, DoubleSide, Group, InstancedMesh, LinearFilter, LineSegments, Matrix4, Mesh, PerspectiveCamera, Quaternion,
  Scene, ShaderMaterial, SphereGeometry, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { palette, viridis } from './colours.js';
import { armAt, armSize, extent, pointAt, symbolLength } from './shapes.js';

// One program for all that is drawn: what has no shape (marks, edges, the robot) reads zeros there and has a colour of its own.
const vertexShader = `
attribute vec3 shape;
attribute float value;
uniform float amount;
varying vec3 at;
varying float level;
void main() {
  vec4 local = vec4(position + amount * shape, 1.0);
#ifdef USE_INSTANCING
  local = instanceMatrix * local;
#endif
  vec4 p = modelViewMatrix * local;
  at = p.xyz;
  level = value;
  gl_Position = projectionMatrix * p;
}`;

// Flat light by the drawn facet itself: right for every phase, without normals to keep.
const fragmentShader = `
uniform sampler2D colours;
uniform vec4 fixed_colour;
uniform float shade;
varying vec3 at;
varying float level;
void main() {
  vec3 n = normalize(cross(dFdx(at), dFdy(at)));
  float light = 1.0 - shade + shade * abs(dot(n, normalize(vec3(0.25, 0.4, 1.0))));
  vec3 c = mix(texture2D(colours, vec2(clamp(level, 0.0, 1.0) * 0.996 + 0.002, 0.5)).rgb, fixed_colour.rgb, fixed_colour.a);
  gl_FragColor = vec4((level < -0.5 ? mix(vec3(0.6), c, fixed_colour.a) : c) * light, 1.0);
}`;

export const hasWebGL = (canvas) => canvas.getContext('webgl2', { antialias: true, preserveDrawingBuffer: true });

/** The view: { show(surface), mode(shape, levels { values, flat: of triangles, not of vertices; below 0: none }), home(robot: to be seen as well), draw(amount), ... }, the same as of the still picture. `drawn` is called with the projection after each frame. */
export function scene(canvas, context, drawn) {
  const renderer = new WebGLRenderer({ canvas, context, antialias: true, preserveDrawingBuffer: true });
  renderer.debug.checkShaderErrors = false; // asking for them waits for the compiler
  const camera = new PerspectiveCamera(28, 1, 0.01, 100);
  camera.up.set(0, 0, 1);
  const controls = new OrbitControls(camera, canvas);
  controls.enableZoom = false; // the wheel belongs to the page until the picture has the focus
  canvas.addEventListener('focus', () => { controls.enableZoom = true; });
  canvas.addEventListener('blur', () => { controls.enableZoom = false; });
  const world = new Scene();

  const uniforms = { amount: { value: 0 }, colours: { value: viridisTexture() } };
  const material = (colour, cover = 1, shade = 0.38) => new ShaderMaterial({ vertexShader, fragmentShader, side: DoubleSide, uniforms: { ...uniforms, fixed_colour: { value: [...rgb(colour), cover] }, shade: { value: shade } } });
  const materials = { part: material('#000000', 0), fixture: material('#cc79a7'), mark: material('#d55e00'), robot: material('#009e73'), edge: material(palette().muted, 1, 0) };
  let [body, outline, extras, current, shape, whole] = [null, null, null, null, null, false];

  const render = () => {
    if (!shape) return;
    renderer.render(world, camera);
    drawn((p) => { const v = new Vector3(...p).project(camera); return [(v.x + 1) / 2, (1 - v.y) / 2]; }, camera.matrixWorldInverse.elements);
  };
  controls.addEventListener('change', render);

  return {
    show(surface) {
      for (const old of [body, outline, extras]) if (old) world.remove(old);
      current = surface;
      body = meshes(surface, materials);
      outline = new LineSegments(geometryOf(surface.positions, surface.edges), materials.edge);
      outline.frustumCulled = false;
      extras = marks(surface, materials);
      world.add(body, outline, extras.group);
      extras = Object.assign(extras.group, { update: extras.update });
      frame(surface, whole, camera, controls);
    },
    mode(next, levels) {
      shape = next;
      for (const part of body.children) {
        part.geometry.dispose();
        part.geometry = (levels.flat ? flatGeometry : smoothGeometry)(current, part.userData.triangles, shape.vectors, levels.values);
      }
    },
    draw(amount) {
      uniforms.amount.value = amount;
      extras.update(shape, amount);
      render();
    },
    outline(on) { outline.visible = on; },
    turn(x, y) { turn(camera, controls.target, x, y); controls.update(); render(); },
    zoom(factor) { camera.position.sub(controls.target).multiplyScalar(factor).add(controls.target); controls.update(); render(); },
    home(robot = whole) { whole = robot; frame(current, whole, camera, controls); render(); },
    resize(width, height) {
      renderer.setPixelRatio(Math.min(2, devicePixelRatio));
      renderer.setSize(width, height, false);
      camera.aspect = width / height;
      camera.updateProjectionMatrix();
      render();
    },
    recolour() {
      renderer.setClearColor(palette().paper);
      materials.edge.uniforms.fixed_colour.value = [...rgb(palette().muted), 1];
      render();
    },
  };
}

const rgb = (colour) => new Color().setStyle(colour, '').toArray();

function viridisTexture() {
  const data = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; i++) data.set([...viridis(i / 255), 255], 4 * i);
  const texture = new DataTexture(data, 256, 1);
  texture.magFilter = texture.minFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

function geometryOf(positions, index) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(Uint32Array.from(index), 1));
  return geometry;
}

/** The part's triangles, and those that a fixture holds in their own colour; `mode` gives them their geometry. */
function meshes({ fixture }, materials) {
  const group = new Group();
  for (const [flag, material] of [[0, materials.part], [1, materials.fixture]]) {
    const triangles = Array.from(fixture.keys()).filter((t) => fixture[t] === flag);
    if (!triangles.length) continue;
    const mesh = new Mesh(new BufferGeometry(), material);
    mesh.userData.triangles = triangles;
    mesh.frustumCulled = false;
    group.add(mesh);
  }
  return group;
}

/** Colours by values of the vertices. */
function smoothGeometry({ positions, triangles }, chosen, vectors, values) {
  const geometry = geometryOf(positions, chosen.flatMap((t) => [triangles[3 * t], triangles[3 * t + 1], triangles[3 * t + 2]]));
  geometry.setAttribute('shape', new BufferAttribute(vectors, 3));
  geometry.setAttribute('value', new BufferAttribute(values, 1));
  return geometry;
}

/** Colours by values of the triangles, which therefore share no vertices: no mean is taken, and the thinnest place is seen. */
function flatGeometry({ positions, triangles }, chosen, vectors, values) {
  const [p, d, v] = [new Float32Array(9 * chosen.length), new Float32Array(9 * chosen.length), new Float32Array(3 * chosen.length)];
  chosen.forEach((t, i) => {
    for (let corner = 0; corner < 3; corner++) {
      const [from, to] = [3 * triangles[3 * t + corner], 9 * i + 3 * corner];
      for (let k = 0; k < 3; k++) [p[to + k], d[to + k]] = [positions[from + k], vectors[from + k]];
      v[3 * i + corner] = values[t];
    }
  });
  const geometry = new BufferGeometry();
  for (const [name, array, size] of [['position', p, 3], ['shape', d, 3], ['value', v, 1]]) geometry.setAttribute(name, new BufferAttribute(array, size));
  return geometry;
}

/** Points, the directions that a contact joins as arrows, the fixtures, and the robot: its arm, or a symbol that pushes where it has none. */
function marks(surface, materials) {
  const group = new Group();
  const unit = surface.radius * 2;
  const updates = surface.points.map((point) => {
    const mark = new Group();
    mark.add(new Mesh(new SphereGeometry(unit * (point.contact ? 0.011 : 0.007), 16, 12), materials.mark));
    const arrows = point.joined.map((d) => arrow(d, unit * 0.11, materials.mark));
    arrows.forEach((one) => mark.add(one));
    group.add(mark);
    return (shape, amount) => {
      arrows.forEach((one, i) => { one.visible = !(shape.robot && point.joined[i] === point.along); }); // the robot itself stands there
      mark.position.set(...pointAt(point, shape, amount));
    };
  });
  if (surface.held.length) group.add(heldMarks(surface, unit * 0.024, materials.fixture));
  if (surface.arm) {
    const thick = Math.max(unit, 0.6 * armSize(surface.arm));
    const rods = surface.arm.slice(1).map(() => new Mesh(new CylinderGeometry(thick * 0.009, thick * 0.012, 1, 14), materials.robot));
    const joints = surface.arm.map(() => new Mesh(new SphereGeometry(thick * 0.017, 16, 12), materials.robot));
    group.add(...rods, ...joints);
    updates.push((shape, amount) => {
      for (const part of [...rods, ...joints]) part.visible = Boolean(shape.robot);
      const at = armAt(surface.arm, shape.robot, amount).map((p) => new Vector3(...p));
      joints.forEach((joint, i) => joint.position.copy(at[i]));
      rods.forEach((rod, i) => place(rod, at[i], at[i + 1]));
    });
  }
  for (const point of surface.pushes) {
    const symbol = robotSymbol(point.push, unit * symbolLength, materials.robot);
    group.add(symbol);
    updates.push((shape, amount) => {
      symbol.visible = Boolean(shape.robot);
      symbol.position.set(...point.position_m.map((x, k) => x + amount * (shape.robot?.[k] ?? 0)));
    });
  }
  return { group, update: (shape, amount) => updates.forEach((update) => update(shape, amount)) };
}

/** Small cones that stand on what a fixture holds, on its outside, so that they are seen from nearly everywhere. */
function heldMarks({ positions, held }, length, material) {
  const cone = new ConeGeometry(length * 0.42, length, 10);
  const cones = new InstancedMesh(cone, material, held.length);
  cones.frustumCulled = false;
  held.forEach(({ v, normal }, i) => {
    const out = new Vector3(...normal);
    const at = new Vector3(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]).addScaledVector(out, length / 2);
    cones.setMatrixAt(i, new Matrix4().compose(at, turnedTo(out.negate()), new Vector3(1, 1, 1)));
  });
  return cones;
}

/** A ball with a cone whose tip is at the contact. */
function robotSymbol(push, length, material) {
  const cone = new Mesh(new ConeGeometry(length * 0.16, length * 0.72, 20), material);
  const ball = new Mesh(new SphereGeometry(length * 0.18, 20, 14), material);
  cone.position.y = -length * 0.36;
  ball.position.y = -length * 0.8;
  const group = new Group();
  group.add(cone, ball);
  group.quaternion.copy(turnedTo(new Vector3(...push)));
  return group;
}

const turnedTo = (direction) => new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), direction.normalize());

function place(rod, from, to) {
  const along = to.clone().sub(from);
  rod.position.copy(from).addScaledVector(along, 0.5);
  rod.scale.y = along.length();
  rod.quaternion.copy(turnedTo(along));
}

function arrow(direction, length, material) {
  const group = new Group();
  const shaft = new Mesh(new CylinderGeometry(length * 0.035, length * 0.035, length * 0.75, 10), material);
  const head = new Mesh(new ConeGeometry(length * 0.11, length * 0.28, 16), material);
  shaft.position.y = length * 0.375;
  head.position.y = length * 0.86;
  group.add(shaft, head);
  group.quaternion.copy(turnedTo(new Vector3(...direction)));
  return group;
}

/** Looks at the part with room for its motion, and at the whole robot where that is wanted. */
function frame(surface, whole, camera, controls) {
  const { centre, points } = extent(surface, whole);
  const distance = 1.08 * distanceTo(points, surface.direction, Math.tan((camera.fov * Math.PI) / 360), camera.aspect);
  controls.target.set(...centre);
  camera.position.set(...surface.direction).multiplyScalar(distance).add(controls.target);
  camera.near = distance / 50;
  camera.far = distance * 20;
  camera.updateProjectionMatrix();
  controls.update();
}

/** From where points about the middle just fill the picture. */
function distanceTo(points, direction, slope, aspect) {
  const toward = new Vector3(...direction);
  const right = new Vector3(0, 0, 1).cross(toward).normalize();
  const up = toward.clone().cross(right);
  return Math.max(...points.map((at) => new Vector3(...at)).map((p) => p.dot(toward) + Math.max(Math.abs(p.dot(right)) / aspect, Math.abs(p.dot(up))) / slope));
}

/** Turns about the target by angles of the page's directions (for the keyboard). */
function turn(camera, target, x, y) {
  const offset = camera.position.clone().sub(target);
  const r = offset.length();
  const azimuth = Math.atan2(offset.y, offset.x) + x;
  const elevation = Math.min(1.5, Math.max(-1.5, Math.asin(offset.z / r) + y));
  camera.position.set(Math.cos(azimuth) * Math.cos(elevation), Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation)).multiplyScalar(r).add(target);
}
