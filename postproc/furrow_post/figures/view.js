// SPDX-License-Identifier: GPL-2.0-or-later
// Runs in 3D: what furrow-post view puts into a page behind three.js and its OrbitControls.
// Data: the JSON that furrow_post/figures/view.py writes; lengths in m, times in s.
"use strict";

(function () {
  const NONE = 255; // colour level of a point whose quantity is not known
  const ABSENT = 65535; // position level of a point that is not there in this frame
  const SPIN_MARKS = 12; // light lines across a wheel, which show that it turns
  const PLAY_SECONDS = 8; // of a whole run, at speed 1
  const GREY = [0.62, 0.62, 0.6];
  const CREASE = Math.cos((50 * Math.PI) / 180); // sharper edges of a body stay sharp
  const MARGIN = 1.05; // around all that is shown
  const TOWARDS = {
    oblique: [-0.72, -1.1, 0.75], side: [0, -1, 0.02], front: [1, 0, 0.05], above: [0, -0.02, 1],
  };

  // ---- data: base64 -> zlib -> levels -------------------------------------------------------

  function bytesOf(base64) {
    const text = atob(base64);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < bytes.length; ++i) bytes[i] = text.charCodeAt(i);
    return bytes;
  }

  async function unpacked(base64) {
    const stream = new Blob([bytesOf(base64)]).stream();
    const whole = stream.pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(whole).arrayBuffer());
  }

  // Levels 0 ... 65535 of frames one behind another: differences in time, zigzag, low then high bytes
  async function levels16(base64, perFrame) {
    const bytes = await unpacked(base64);
    const count = bytes.length / 2;
    const levels = new Uint16Array(count);
    for (let i = 0; i < count; ++i) {
      const zigzag = bytes[i] | (bytes[count + i] << 8);
      const before = i < perFrame ? 0 : levels[i - perFrame];
      levels[i] = before + ((zigzag >>> 1) ^ -(zigzag & 1));
    }
    return levels;
  }

  // Levels 0 ... 255 of frames one behind another: differences in time
  async function levels8(base64, perFrame) {
    const levels = await unpacked(base64);
    for (let i = perFrame; i < levels.length; ++i) levels[i] += levels[i - perFrame];
    return levels;
  }

  // ---- grains and particles: a point each, drawn as a sphere ---------------------------------

  const POINT_VERTEX = `
    precision highp float;
    uniform mat4 modelViewMatrix, projectionMatrix;
    uniform vec3 low, span;
    uniform float side, cut, pixels;
    attribute vec4 position;  // of the point, and its colour level
    attribute float radius;
    varying vec3 centre;
    varying float level, size;
    void main() {
      vec3 x = low + span * position.xyz;
      x.y *= side;
      level = 65535.0 * position.w;
      size = radius;
      vec4 seen = modelViewMatrix * vec4(x, 1.0);
      centre = seen.xyz;
      gl_Position = projectionMatrix * seen;
      gl_PointSize = max(2.2 * radius * pixels / gl_Position.w, 1.5);
      if (position.x > 65534.5 / 65535.0 || x.y < cut) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
    }`;
  const POINT_FRAGMENT = `
    #extension GL_EXT_frag_depth : enable
    precision highp float;
    uniform mat4 projectionMatrix;
    uniform sampler2D colours;
    uniform vec3 none, sun;
    varying vec3 centre;
    varying float level, size;
    void main() {
      vec2 p = vec2(2.0, -2.0) * (gl_PointCoord - 0.5);
      float d = dot(p, p);
      if (d > 1.0) discard;
      vec3 normal = vec3(p, sqrt(1.0 - d));
      vec3 colour = level > 254.5 ? none : texture2D(colours, vec2((level + 0.5) / 255.0, 0.5)).rgb;
      float light = 0.5 + 0.55 * max(dot(normal, sun), 0.0);
      gl_FragColor = vec4(colour * light, 1.0);
      vec4 front = projectionMatrix * vec4(centre + size * normal, 1.0);
      gl_FragDepthEXT = 0.5 + 0.5 * front.z / front.w;
    }`;

  class Cloud {
    static async read(data, shared) {
      const cloud = new Cloud();
      cloud.count = data.count;
      cloud.places = await levels16(data.places, 3 * data.count);
      cloud.values = {};
      for (const name of Object.keys(data.values))
        cloud.values[name] = await levels8(data.values[name], data.count);
      cloud.now = new Uint16Array(4 * data.count);
      const geometry = new THREE.BufferGeometry();
      cloud.attribute = new THREE.BufferAttribute(cloud.now, 4, true);
      geometry.setAttribute("position", cloud.attribute);
      const radius = new Float32Array((await unpacked(data.radius)).buffer);
      cloud.largest = radius.reduce((a, b) => Math.max(a, b), 0);
      cloud.data = data;
      geometry.setAttribute("radius", new THREE.BufferAttribute(radius, 1));
      geometry.setDrawRange(0, data.count);
      cloud.group = new THREE.Group();
      for (const side of data.mirrored ? [1, -1] : [1]) {
        const material = new THREE.RawShaderMaterial({
          vertexShader: POINT_VERTEX,
          fragmentShader: POINT_FRAGMENT,
          extensions: { fragDepth: true },
          uniforms: Object.assign({
            low: { value: new THREE.Vector3(...data.low) },
            span: { value: new THREE.Vector3(...data.span) },
            side: { value: side },
          }, shared),
        });
        const points = new THREE.Points(geometry, material);
        points.frustumCulled = false;
        cloud.group.add(points);
      }
      return cloud;
    }

    show(frame, quantity) {
      const { now, places, count } = this;
      const values = this.values[quantity];
      const x = 3 * frame * count, y = x + count, z = y + count, v = frame * count;
      for (let i = 0, k = 0; i < count; ++i, k += 4) {
        now[k] = places[x + i];
        now[k + 1] = places[y + i];
        now[k + 2] = places[z + i];
        now[k + 3] = values ? values[v + i] : NONE;
      }
      this.attribute.needsUpdate = true;
    }

    // Extends a box by the points of a frame, and their mirror images
    extend(box, frame) {
      const { data, places, count } = this;
      for (let axis = 0; axis < 3; ++axis) {
        let low = ABSENT, high = 0;
        for (let i = (3 * frame + axis) * count, end = i + count; i < end; ++i) {
          if (places[i] === ABSENT) continue;
          low = Math.min(low, places[i]);
          high = Math.max(high, places[i]);
        }
        if (low > high) return;
        for (const level of [low, high]) {
          const x = data.low[axis] + (data.span[axis] * level) / 65535;
          const end = level === low ? x - this.largest : x + this.largest;
          box.add(axis, end);
          if (axis === 1 && data.mirrored) box.add(axis, -end);
        }
      }
    }
  }

  // Lowest and highest coordinates
  class Box {
    constructor() {
      this.low = [Infinity, Infinity, Infinity];
      this.high = [-Infinity, -Infinity, -Infinity];
    }

    add(axis, x) {
      this.low[axis] = Math.min(this.low[axis], x);
      this.high[axis] = Math.max(this.high[axis], x);
    }

    corners() {
      const { low, high } = this;
      return [0, 1, 2, 3, 4, 5, 6, 7].map((k) =>
        new THREE.Vector3(...[0, 1, 2].map((axis) => (k >> axis) & 1 ? high[axis] : low[axis])));
    }
  }

  // ---- the wheel, tyre or plate: triangles ----------------------------------------------------

  const BODY_VERTEX = `
    precision highp float;
    uniform mat4 modelViewMatrix, projectionMatrix;
    uniform float side;
    attribute vec3 position, normal;
    attribute vec2 start;  // (x, z) from the axle in the first frame
    varying vec3 seen, smoothed;
    varying vec2 marked;
    void main() {
      vec3 mirror = vec3(1.0, side, 1.0);
      vec4 x = modelViewMatrix * vec4(mirror * position, 1.0);
      seen = x.xyz;
      smoothed = (modelViewMatrix * vec4(mirror * normal, 0.0)).xyz;
      marked = start;
      gl_Position = projectionMatrix * x;
    }`;
  const BODY_FRAGMENT = `
    #extension GL_OES_standard_derivatives : enable
    #extension GL_EXT_frag_depth : enable
    precision highp float;
    uniform mat4 projectionMatrix;
    uniform vec3 sun;
    uniform float nearer;  // than its place it is, so that no grain that touches it pokes through
    varying vec3 seen, smoothed;
    varying vec2 marked;
    void main() {
      vec3 facet = cross(dFdx(seen), dFdy(seen));  // towards the viewer
      vec3 normal = normalize(dot(facet, smoothed) < 0.0 ? -smoothed : smoothed);
      vec4 front = projectionMatrix * vec4(seen - nearer * normalize(seen), 1.0);
      gl_FragDepthEXT = 0.5 + 0.5 * front.z / front.w;
      float turn = atan(marked.y, marked.x) / 6.2831853 + 1.0;
      float grey = fract(turn * ${SPIN_MARKS}.0) < 0.07 ? 0.7 : 0.46;
      float light = 0.5 + 0.6 * max(dot(normal, sun), 0.0);
      gl_FragColor = vec4(light * grey * vec3(0.93, 1.0, 1.09), 1.0);
    }`;

  class Body {
    static async read(data, shared) {
      const body = new Body();
      body.data = data;
      body.places = await levels16(data.places, 3 * data.nodes);
      body.triangles = new Uint32Array((await unpacked(data.triangles)).buffer);
      const geometry = new THREE.BufferGeometry();
      body.corners = new Float32Array(3 * body.triangles.length);
      body.attribute = new THREE.BufferAttribute(body.corners, 3);
      geometry.setAttribute("position", body.attribute);
      geometry.setAttribute("start", new THREE.BufferAttribute(body.starts(), 2));
      body.normals = new Float32Array(3 * body.triangles.length);
      body.normal = new THREE.BufferAttribute(body.normals, 3);
      geometry.setAttribute("normal", body.normal);
      body.meet();
      body.nearer = { value: 0 };
      body.group = new THREE.Group();
      for (const side of data.mirrored ? [1, -1] : [1]) {
        const mesh = new THREE.Mesh(geometry, new THREE.RawShaderMaterial({
          vertexShader: BODY_VERTEX,
          fragmentShader: BODY_FRAGMENT,
          extensions: { derivatives: true, fragDepth: true },
          side: THREE.DoubleSide,
          uniforms: { side: { value: side }, sun: shared.sun, nearer: body.nearer },
        }));
        mesh.frustumCulled = false;
        body.group.add(mesh);
      }
      return body;
    }

    // (x, y, z) of a node in a frame
    node(frame, i, axis) {
      const { low, span, nodes } = this.data;
      return low[axis] + span[axis] * this.places[(3 * frame + axis) * nodes + i] / 65535;
    }

    range(frame, axis) {
      let low = Infinity, high = -Infinity;
      for (let i = 0; i < this.data.nodes; ++i) {
        const x = this.node(frame, i, axis);
        low = Math.min(low, x);
        high = Math.max(high, x);
      }
      return [low, high];
    }

    centre(frame, axis) {
      const [low, high] = this.range(frame, axis);
      return 0.5 * (low + high);
    }

    // (x, z) of each corner from the axle in the first frame
    starts() {
      const starts = new Float32Array(2 * this.triangles.length);
      const x = this.centre(0, 0), z = this.centre(0, 2);
      this.triangles.forEach((node, k) => {
        starts[2 * k] = this.node(0, node, 0) - x;
        starts[2 * k + 1] = this.node(0, node, 2) - z;
      });
      return starts;
    }

    // Lists for each corner the triangles around its place in the first frame
    meet() {
      const { triangles, places, data } = this, around = new Map();
      const place = (node) => [0, 1, 2].map((axis) => places[axis * data.nodes + node]).join();
      this.around = Array.from(triangles, (node, k) => {
        const key = place(node);
        if (!around.has(key)) around.set(key, []);
        around.get(key).push(Math.floor(k / 3));
        return around.get(key);
      });
    }

    show(frame) {
      for (let k = 0; k < this.triangles.length; ++k)
        for (let axis = 0; axis < 3; ++axis)
          this.corners[3 * k + axis] = this.node(frame, this.triangles[k], axis);
      this.attribute.needsUpdate = true;
      this.shade();
    }

    // Normals of corners: means of the triangles around them, but for those across an edge
    shade() {
      const { corners, normals, around } = this, count = around.length / 3;
      const facets = new Float32Array(3 * count);
      const a = new THREE.Vector3(), b = new THREE.Vector3(), c = new THREE.Vector3();
      for (let k = 0; k < count; ++k) {
        [a, b, c].forEach((corner, i) => corner.fromArray(corners, 9 * k + 3 * i));
        b.sub(a).cross(c.sub(a)).normalize().toArray(facets, 3 * k);
      }
      for (let k = 0; k < around.length; ++k) {
        const own = a.fromArray(facets, 3 * Math.floor(k / 3)), sum = b.set(0, 0, 0);
        for (const other of around[k]) {
          c.fromArray(facets, 3 * other);
          if (own.dot(c) > CREASE) sum.add(c);
        }
        (sum.lengthSq() > 0 ? sum : own).normalize().toArray(normals, 3 * k);
      }
      this.normal.needsUpdate = true;
    }

    extend(box, frame) {
      for (let axis = 0; axis < 3; ++axis)
        for (const x of this.range(frame, axis)) {
          box.add(axis, x);
          if (axis === 1 && this.data.mirrored) box.add(axis, -x);
        }
    }
  }

  // ---- one run ----------------------------------------------------------------------------------

  class Run {
    static async read(data, shared) {
      const run = new Run();
      run.label = data.label;
      run.times = data.times;
      run.scene = new THREE.Scene();
      run.scene.background = new THREE.Color(0xf4f6f8);
      run.root = new THREE.Group();
      run.scene.add(run.root);
      run.bodies = [];
      for (const one of data.bodies) run.bodies.push(await Body.read(one, shared));
      run.clouds = [];
      for (const one of data.clouds) run.clouds.push(await Cloud.read(one, shared));
      for (const part of [...run.bodies, ...run.clouds]) run.root.add(part.group);
      for (const body of run.bodies)
        body.nearer.value = Math.max(0, ...run.clouds.map((cloud) => cloud.largest));
      run.scale = new THREE.Mesh(
        new THREE.BoxGeometry(1, 1, 1), new THREE.MeshBasicMaterial({ color: 0x222222 }));
      run.scene.add(run.scale);
      return run;
    }

    // The last frame that is no later than this
    frameAt(time) {
      let frame = 0;
      while (frame + 1 < this.times.length && this.times[frame + 1] <= time * (1 + 1e-12)) ++frame;
      return frame;
    }

    show(time, quantity, follow) {
      const frame = this.frameAt(time);
      for (const cloud of this.clouds) cloud.show(frame, quantity);
      for (const body of this.bodies) body.show(frame);
      const [first] = this.bodies;
      if (first) this.root.position.x = follow ? -first.centre(frame, 0) : 0;
      this.frame = frame;
      return this.times[frame];
    }

    // Boxes of all that is shown
    boxes() {
      return [...this.bodies, ...this.clouds].map((part) => {
        const box = new Box();
        part.extend(box, this.frame);
        box.low[0] += this.root.position.x;
        box.high[0] += this.root.position.x;
        return box;
      });
    }
  }

  // ---- the page -----------------------------------------------------------------------------------

  class View {
    constructor(place, data, runs, shared) {
      Object.assign(this, { place, data, runs, shared });
      this.find = (name) => place.querySelector(`.furrow-${name}`);
      this.canvas = this.find("canvas");
      this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: true });
      this.renderer.setPixelRatio(window.devicePixelRatio || 1);
      this.renderer.setScissorTest(true);
      this.camera = new THREE.PerspectiveCamera(30, 1, 0.01, 100);
      this.camera.up.set(0, 0, 1);
      this.controls = new THREE.OrbitControls(this.camera, this.canvas);
      this.controls.enableKeys = false;
      this.controls.addEventListener("change", () => this.draw());
      this.times = [...new Set(runs.flatMap((run) => run.times))].sort((a, b) => a - b);
      this.moment = this.times.length - 1; // in this.times
      this.prepareInput();
      this.resize();
      this.update();
      this.look("oblique");
      this.draw();
      window.addEventListener("resize", () => { this.resize(); this.look(this.from); this.draw(); });
    }

    prepareInput() {
      const { data, shared } = this;
      this.slider = this.find("time");
      this.slider.max = this.moment;
      this.slider.value = this.moment;
      this.slider.disabled = this.times.length < 2;
      this.find("play").disabled = this.times.length < 2;
      this.slider.addEventListener("input", () => {
        this.moment = Number(this.slider.value);
        this.update();
      });
      const select = this.find("quantity");
      data.quantities.forEach((one, k) => select.add(new Option(one.name, k)));
      select.addEventListener("change", () => this.update());
      this.find("follow").addEventListener("change", () => this.update());
      this.find("body").addEventListener("change", () => this.update());
      const cut = this.find("cut");
      [cut.min, cut.max] = data.cut;
      cut.step = (cut.max - cut.min) / 200;
      cut.value = cut.min;
      cut.addEventListener("input", () => {
        const y = Number(cut.value), all = y < Number(cut.min) + 0.5 * cut.step;
        shared.cut.value = all ? -1e9 : y;
        this.find("cut-text").textContent = all ? "none" : `y > ${(y || 0).toFixed(3)} m`;
        this.draw();
      });
      for (const button of this.place.querySelectorAll("[data-look]"))
        button.addEventListener("click", () => { this.look(button.dataset.look); this.draw(); });
      this.find("play").addEventListener("click", () => this.play(!this.playing));
      this.canvas.tabIndex = 0;
      this.canvas.addEventListener("keydown", (event) => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
        if (event.key === " ") this.play(!this.playing);
        else if (step) this.step(step);
        else return;
        event.preventDefault();
      });
    }

    step(by) {
      this.moment = Math.min(Math.max(this.moment + by, 0), this.times.length - 1);
      this.slider.value = this.moment;
      this.update();
    }

    play(on) {
      this.playing = on;
      this.find("play").textContent = on ? "pause" : "play";
      if (!on) return;
      if (this.moment === this.times.length - 1) this.moment = 0;
      const first = this.times[0], whole = this.times[this.times.length - 1] - first;
      const from = this.times[this.moment], start = performance.now();
      const tick = (now) => {
        if (!this.playing) return;
        const speed = Number(this.find("speed").value);
        const time = from + whole * speed * (now - start) / (1000 * PLAY_SECONDS);
        let moment = this.moment;
        while (moment + 1 < this.times.length && this.times[moment + 1] <= time) ++moment;
        if (moment !== this.moment) this.step(moment - this.moment);
        if (moment === this.times.length - 1) this.play(false);
        else requestAnimationFrame(tick);
      };
      requestAnimationFrame(tick);
    }

    // Places the camera so that all of every run is in view, with a scale
    look(from) {
      this.from = from;
      const boxes = this.runs.flatMap((run) => run.boxes()), whole = new Box();
      for (const box of boxes)
        for (const end of [box.low, box.high]) end.forEach((x, axis) => whole.add(axis, x));
      const size = Math.hypot(...whole.high.map((x, axis) => x - whole.low[axis]));
      boxes.push(this.placeScale(whole, size, from));
      const towards = new THREE.Vector3(...TOWARDS[from]).normalize();
      const right = new THREE.Vector3(0, 0, 1).cross(towards).normalize();
      const up = towards.clone().cross(right);
      const corners = boxes.flatMap((box) => box.corners());
      const target = new THREE.Vector3(...whole.low).add(new THREE.Vector3(...whole.high)).multiplyScalar(0.5);
      const high = Math.tan((0.5 * this.camera.fov * Math.PI) / 180) / MARGIN;
      const wide = (high * this.canvas.clientWidth) / this.runs.length / this.canvas.clientHeight;
      let distance = 10 * size;
      for (let pass = 0; pass < 6; ++pass) {  // to the middle of the picture, then as near as fits
        const seen = corners.map((corner) => {
          const x = corner.clone().sub(target), depth = x.dot(towards);
          return { depth, x: x.dot(right), y: x.dot(up), scale: distance / (distance - depth) };
        });
        for (const [axis, name] of [[right, "x"], [up, "y"]]) {
          const places = seen.map((one) => one[name] * one.scale);
          const middle = 0.5 * (Math.min(...places) + Math.max(...places));
          target.addScaledVector(axis, middle);
          for (const one of seen) one[name] -= middle;
        }
        distance = Math.max(...seen.map(({ depth, x, y }) =>
          depth + Math.max(Math.abs(x) / wide, Math.abs(y) / high)));
      }
      this.controls.target.copy(target);
      this.camera.position.copy(towards).multiplyScalar(distance).add(target);
      this.camera.near = 0.01 * size;
      this.camera.far = 20 * size;
      this.controls.update();
    }

    // A bar along the ground's near edge, of a round length. Returns its box, with its label
    placeScale(box, size, from) {
      const axis = from === "front" ? 1 : 0, side = axis === 0 ? 1 : 0, near = axis === 0 ? "low" : "high";
      const most = 0.4 * (box.high[axis] - box.low[axis]);
      const power = 10 ** Math.floor(Math.log10(most));
      this.length = power * [5, 2, 1].find((step) => step * power <= most);
      const thick = 0.006 * size, gap = (near === "low" ? -1 : 1) * 0.03 * size;
      const centre = [0, 0, box.low[2]], extent = [thick, thick, thick];
      centre[axis] = box.low[axis] + 0.5 * this.length;
      centre[side] = box[near][side] + gap;
      extent[axis] = this.length;
      for (const run of this.runs) {
        run.scale.position.set(...centre);
        run.scale.scale.set(...extent);
      }
      const bar = new Box();
      [0, 1, 2].forEach((of) => {
        bar.add(of, centre[of] - 0.5 * extent[of] - (of === 2 ? 0.05 * size : 0));
        bar.add(of, centre[of] + 0.5 * extent[of]);
      });
      return bar;
    }

    // The length of the bar, written behind its right end in the picture of each run
    writeScale(width, height) {
      const { length, camera } = this;
      const text = length < 1 ? `${Math.round(1000 * length)} mm` : `${length} m`;
      this.place.querySelectorAll(".furrow-scale").forEach((label, k) => {
        const { scale } = this.runs[k], axis = scale.scale.x > scale.scale.y ? "x" : "y";
        const place = [-0.5, 0.5].map((end) => {
          const at = scale.position.clone();
          at[axis] += end * length;
          return at.project(camera);
        }).reduce((left, other) => (other.x > left.x ? other : left));
        label.textContent = text;
        label.style.left = `${(k + 0.5 + 0.5 * place.x) * width}px`;
        label.style.top = `${(0.5 - 0.5 * place.y) * height}px`;
      });
    }

    resize() {
      const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
      this.renderer.setSize(width, height, false);
    }

    update() {
      const quantity = this.data.quantities[Number(this.find("quantity").value)];
      const time = this.times[this.moment];
      const shown = this.runs.map((run) => {
        for (const body of run.bodies) body.group.visible = this.find("body").checked;
        return run.show(time, quantity ? quantity.key : "", this.find("follow").checked);
      });
      this.find("clock").textContent = `t = ${time.toFixed(3)} s`;
      this.place.querySelectorAll(".furrow-name").forEach((label, k) => {
        const ended = time > shown[k] && shown[k] === this.runs[k].times[this.runs[k].times.length - 1];
        label.textContent = this.runs[k].label + (ended ? ` (ended at ${shown[k].toFixed(3)} s)` : "");
      });
      this.legend(quantity);
      this.draw();
    }

    legend(quantity) {
      this.find("legend").hidden = !quantity;
      if (!quantity) return;
      const stops = [];
      for (let k = 0; k <= 16; ++k) {
        const at = 3 * Math.round(k * 255 / 16);
        stops.push(`rgb(${[0, 1, 2].map((c) => this.data.colours[at + c]).join(",")})`);
      }
      this.find("bar").style.background = `linear-gradient(to right, ${stops.join(",")})`;
      const ticks = [0, 0.25, 0.5, 0.75, 1].map(
        (share) => quantity.low + share * (quantity.high - quantity.low));
      this.find("ticks").innerHTML = ticks.map(
        (tick) => `<span>${Number(tick.toPrecision(3))}</span>`).join("");
      this.find("unit").textContent = `${quantity.name} [${quantity.unit}]`;
    }

    draw() {
      const { renderer, camera, canvas, runs, shared } = this;
      const width = canvas.clientWidth / runs.length, height = canvas.clientHeight;
      camera.aspect = width / height;
      camera.updateProjectionMatrix();
      const ratio = renderer.getPixelRatio();
      shared.pixels.value = 0.5 * height * ratio * camera.projectionMatrix.elements[5];
      camera.updateMatrixWorld();
      shared.sun.value.set(-0.35, -0.75, 0.9).normalize().transformDirection(camera.matrixWorldInverse);
      runs.forEach((run, k) => {
        renderer.setViewport(k * width, 0, width, height);
        renderer.setScissor(k * width, 0, width + 1, height);  // + 1: no gap where it is rounded
        renderer.render(run.scene, camera);
      });
      this.writeScale(width, height);
    }
  }

  async function start(place) {
    const message = place.querySelector(".furrow-message");
    try {
      const data = JSON.parse(place.querySelector("script[type='application/json']").textContent);
      data.colours = bytesOf(data.colours);
      const colours = new THREE.DataTexture(data.colours, 256, 1, THREE.RGBFormat);
      colours.needsUpdate = true;
      const shared = {
        colours: { value: colours }, none: { value: new THREE.Vector3(...GREY) },
        sun: { value: new THREE.Vector3() }, cut: { value: -1e9 }, pixels: { value: 1 },
      };
      const runs = [];
      for (const one of data.runs) runs.push(await Run.read(one, shared));
      place.view = new View(place, data, runs, shared);  // for scripts of a reader
      message.hidden = true;
      place.dataset.ready = "yes";
    } catch (error) {
      message.textContent = "This picture in 3D needs a browser of 2023 or later with WebGL " +
        `(${error.message}).`;
      throw error;
    }
  }

  document.querySelectorAll(".furrow-view").forEach(start);
})();
