// Shows every view of a run in 3-D of a page (space.h has its data): turned by the mouse, played, in colours of strain.
// It needs WebGL and three.js; where one is missing, the page says so, and its pictures stay.
'use strict';
const spaces = [];

// Values lie in the page as base64 of little-endian arrays.
const decoded = (text, Type) => new Type(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);

// Positions in a frame, float32 [particle or vertex, 3], metres; one frame's are those of all.
class Positions {
  constructor(json, count) {
    Object.assign(this, json);
    this.count = count;
    this.positions = decoded(json.positions, Uint16Array);
    this.changing = this.positions.length > 3 * count;
  }
  positionsAt(at) {
    const xyz = new Float32Array(3 * this.count), first = this.changing ? at * xyz.length : 0;
    for (let i = 0; i < xyz.length; ++i) {
      const k = i % 3;
      xyz[i] = this.low[k] + this.positions[first + i] / 65535 * (this.high[k] - this.low[k]);
    }
    return xyz;
  }
}

class ClothData extends Positions {
  constructor(json) {
    super(json, json.rows * json.columns);
    this.strain = decoded(json.strain, Uint8Array);
    this.triangles = decoded(json.triangles, Uint32Array);
    this.changes = json.changes.map(change => ({frame: change.frame, alive: decoded(change.alive, Uint8Array)}));
  }
  changeAt(frame) {
    let found = 0;
    this.changes.forEach((change, i) => { if (change.frame <= frame) found = i; });
    return found;
  }
  indicesOf(change) {
    const {alive} = this.changes[change], indices = [];
    for (let i = 0; i < this.triangles.length / 3; ++i)
      if (alive[i >> 3] >> (i & 7) & 1)
        indices.push(this.triangles[3 * i], this.triangles[3 * i + 1], this.triangles[3 * i + 2]);
    return indices;
  }
}

// The drawing of a cloth: a mesh for either side, since they have colours of their own.
class ClothMesh {
  constructor(data, colors) {
    this.data = data;
    this.colors = colors.map(color => new THREE.Color(color));
    this.geometry = new THREE.BufferGeometry();
    for (const name of ['position', 'color'])
      this.geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(3 * data.count), 3));
    this.sides = [[THREE.FrontSide, data.front], [THREE.BackSide, data.back]].map(([side, rgb]) => {
      const plain = new THREE.MeshLambertMaterial({side, color: new THREE.Color(...rgb)});
      const heat = new THREE.MeshBasicMaterial({side, vertexColors: THREE.VertexColors});
      const mesh = new THREE.Mesh(this.geometry, plain);
      mesh.frustumCulled = false;
      return {mesh, plain, heat};
    });
  }
  show(at, frame, heat, wire) {
    const {position, color} = this.geometry.attributes;
    position.array.set(this.data.positionsAt(at));
    position.needsUpdate = true;
    const change = this.data.changeAt(frame);
    if (change !== this.change) this.geometry.setIndex(this.data.indicesOf(change));
    this.change = change;
    this.geometry.computeVertexNormals();
    const last = this.colors.length - 1;
    for (let i = 0; heat && i < this.data.count; ++i) {
      const place = this.data.strain[at * this.data.count + i] / 255 * last, low = Math.min(Math.floor(place), last - 1);
      this.colors[low].clone().lerp(this.colors[low + 1], place - low).toArray(color.array, 3 * i);
    }
    color.needsUpdate = heat;
    for (const side of this.sides) {
      side.mesh.material = heat ? side.heat : side.plain;
      side.mesh.material.wireframe = wire;
    }
  }
}

// Two balls and the cone that touches both, about the y axis; one ball where it contains the other.
const capsuleGeometry = ([half, low, high]) => {
  const sine = (low - high) / (2 * half);
  if (!(Math.abs(sine) < 1)) {
    const ball = new THREE.SphereBufferGeometry(Math.max(low, high), 48, 32);
    return ball.translate(0, low > high ? -half : half, 0);
  }
  const touch = Math.asin(sine), points = [], steps = 16;
  const arc = (radius, y, from, to) => {
    for (let i = 0; i <= steps; ++i) {
      const angle = from + (to - from) * i / steps;
      points.push(new THREE.Vector2(Math.max(radius * Math.cos(angle), 0), y + radius * Math.sin(angle)));
    }
  };
  arc(low, -half, -Math.PI / 2, touch);
  arc(high, half, touch, Math.PI / 2);
  return new THREE.LatheBufferGeometry(points, 48);
};

const shapes = {
  planes: () => new THREE.PlaneBufferGeometry(20, 20).rotateX(-Math.PI / 2),
  spheres: ([radius]) => new THREE.SphereBufferGeometry(radius, 48, 32),
  boxes: half => new THREE.BoxBufferGeometry(...half.map(side => 2 * side)),
  ellipsoids: radii => new THREE.SphereBufferGeometry(1, 48, 32).scale(...radii),
  capsules: capsuleGeometry,
  meshes: (size, json) => {
    const geometry = new THREE.BufferGeometry();
    const triangles = decoded(json.triangles, Uint32Array);
    json.forms = new Positions(json, triangles.reduce((most, corner) => Math.max(most, corner + 1), 0));
    geometry.setAttribute('position', new THREE.BufferAttribute(json.forms.positionsAt(0), 3));
    geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
    return geometry;
  },
};

// A mesh with poses: rotation, row major, and centre; one for all frames where it does not move.
class Posed {
  constructor(mesh, json) {
    this.mesh = mesh;
    this.active = json.active;
    this.forms = json.forms;
    this.poses = decoded(json.poses, Float32Array);
    mesh.matrixAutoUpdate = false;
  }
  show(at, time) {
    const p = this.poses.subarray(this.poses.length > 12 ? 12 * at : 0);
    this.mesh.matrix.set(p[0], p[1], p[2], p[9], p[3], p[4], p[5], p[10], p[6], p[7], p[8], p[11], 0, 0, 0, 1);
    if (this.forms && this.forms.changing) {
      const {position} = this.mesh.geometry.attributes;
      position.array.set(this.forms.positionsAt(at));
      position.needsUpdate = true;
    }
    if (this.active) this.mesh.visible = this.active[0] <= time && time <= this.active[1];
  }
}

const colliderOf = json => {
  const color = new THREE.Color(...json.color);
  const material = json.kind === 'meshes' ? new THREE.MeshPhongMaterial({color, flatShading: true, side: THREE.DoubleSide})
                                          : new THREE.MeshLambertMaterial({color});
  const mesh = new THREE.Mesh(shapes[json.kind](json.size, json), material);
  if (json.kind === 'planes') {
    material.side = THREE.DoubleSide;
    material.polygonOffset = true;  // cloth that lies on it is in front
    material.polygonOffsetFactor = material.polygonOffsetUnits = 1;
    mesh.add(new THREE.GridHelper(20, 80, 0x808890, 0x9aa2aa));
  }
  return new Posed(mesh, json);
};

const cutterOf = json => {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(json.corners.flat()), 3));
  const look = {color: 0x4060a0, side: THREE.DoubleSide, transparent: true, opacity: 0.5};
  return new Posed(new THREE.Mesh(geometry, new THREE.MeshBasicMaterial(look)), json);
};

// The lines of the page's plots that say what time is shown.
const showTime = time => document.querySelectorAll('svg .cursor').forEach(group => {
  const {left, right, first, last, top, bottom} = group.dataset;
  const x = +left + (time - first) / (last - first) * (right - left);
  group.innerHTML = `<path d="M${x} ${top}V${bottom}" stroke="#b3261e" stroke-width="1.5"/>`;
});

class Space {
  constructor(element) {
    this.element = element;
    this.data = JSON.parse(document.getElementById(element.dataset.space).textContent);
    this.cloths = this.data.cloths.map(json => new ClothData(json));
    [this.slider, this.heat, this.wire] = element.querySelectorAll('input');
    this.button = element.querySelector('button');
    this.label = element.querySelector('output');
    this.slider.max = this.data.frames.length - 1;
    this.at = 0;
  }
  // Throws where there is no WebGL.
  open() {
    const stage = this.element.querySelector('.stage'), {camera} = this.data;
    this.renderer = new THREE.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setClearColor(0xdbe3ed);
    stage.appendChild(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.scene.add(new THREE.HemisphereLight(0xf2f6ff, 0x8a8078, 0.75));
    const sun = new THREE.DirectionalLight(0xfff7e8, 0.55);
    sun.position.set(-0.75, 0.9, 0.5);
    this.scene.add(sun);
    this.camera = new THREE.PerspectiveCamera(camera.fov, camera.aspect, 0.01, 200);
    this.camera.position.set(...camera.position);
    this.controls = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    this.controls.target.set(...camera.target);
    this.controls.update();
    this.controls.addEventListener('change', () => this.draw());
    this.meshes = this.cloths.map(cloth => new ClothMesh(cloth, this.data.colors));
    this.meshes.forEach(cloth => cloth.sides.forEach(side => this.scene.add(side.mesh)));
    this.posed = [...this.data.colliders.map(colliderOf), ...this.data.cutters.map(cutterOf)];
    this.posed.forEach(one => this.scene.add(one.mesh));
    const fit = () => {
      this.renderer.setSize(stage.clientWidth, stage.clientWidth / camera.aspect);
      this.draw();
    };
    window.addEventListener('resize', fit);
    this.heat.onchange = this.wire.onchange = () => this.show(this.at);
    this.show(0);
    fit();
  }
  show(at) {
    this.at = Math.min(at, this.data.frames.length - 1);
    const frame = this.data.frames[this.at], time = this.data.times[this.at];
    this.meshes.forEach(cloth => cloth.show(this.at, frame, this.heat.checked, this.wire.checked));
    this.posed.forEach(one => one.show(this.at, time));
    this.slider.value = this.at;
    this.label.textContent = `frame ${frame}, ${time.toFixed(2)} s`;
    this.showLegend();
    this.draw();
  }
  showLegend() {
    const legend = this.element.querySelector('.legend');
    const colors = this.data.colors.map(color => '#' + color.toString(16).padStart(6, '0')).join(', ');
    legend.innerHTML = this.heat.checked ? `0 <i style="background: linear-gradient(90deg, ${colors})"></i> ` : '';
    if (this.heat.checked)
      legend.append(this.cloths.map(cloth => `${cloth.name}: ${(100 * cloth.strain_range).toPrecision(2)} %`).join(', '));
  }
  draw() { this.renderer.render(this.scene, this.camera); }
}

const openSpaces = () => {
  for (const element of document.querySelectorAll('.space')) {
    try {
      const space = new Space(element);
      space.open();
      spaces.push(space);
    } catch (error) {
      element.textContent = `Nothing is shown in 3-D here: ${error.message.replace(/\.$/, '')}. The pictures below show the run.`;
    }
  }
  // All are played together, at the speed of the first.
  let begun = null;
  const stop = () => {
    begun = null;
    spaces.forEach(space => space.button.textContent = 'Play');
  };
  const showAll = at => {
    spaces.forEach(space => space.show(at));
    showTime(spaces[0].data.times[spaces[0].at]);
  };
  const step = now => {
    if (begun === null) return;
    const {times} = spaces[0].data, length = times[times.length - 1] - times[0];
    const time = times[0] + (now - begun) / 1000 % Math.max(length, 1e-3);
    let at = times.findIndex(each => each > time) - 1;
    if (at < 0) at = times.length - 1;
    if (at !== spaces[0].at) showAll(at);
    requestAnimationFrame(step);
  };
  for (const space of spaces) {
    space.slider.oninput = () => { stop(); showAll(+space.slider.value); };
    space.button.onclick = () => {
      if (begun !== null) return stop();
      begun = performance.now() - 1000 * (spaces[0].data.times[spaces[0].at] - spaces[0].data.times[0]);
      spaces.forEach(each => each.button.textContent = 'Stop');
      requestAnimationFrame(step);
    };
  }
  if (spaces.length > 0) showAll(0);
};
openSpaces();
