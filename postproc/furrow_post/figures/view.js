// SPDX-License-Identifier: GPL-2.0-or-later
// Runs in 3D: what furrow-post view puts into a page behind three.js and its OrbitControls.
// Data: the JSON that furrow_post/figures/view.py writes; lengths in m, times in s.
"use strict";

(function () {
  const NONE = 255; // colour level of a point whose quantity is not known
  const ABSENT = 65535; // position level of a point that is not there in this frame
  const SPIN_SECTORS = 12; // lighter and darker parts of a wheel, which show that it turns
  const PLAY_SECONDS = 8; // of a whole run, at speed 1
  const GREY = [0.62, 0.62, 0.6];

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
  }

  // ---- the wheel, tyre or plate: triangles ----------------------------------------------------

  const BODY_VERTEX = `
    precision highp float;
    uniform mat4 modelViewMatrix, projectionMatrix;
    uniform float side;
    attribute vec3 position;
    attribute vec2 start;  // (x, z) from the axle in the first frame
    varying vec3 seen;
    varying vec2 marked;
    void main() {
      vec4 x = modelViewMatrix * vec4(position.x, side * position.y, position.z, 1.0);
      seen = x.xyz;
      marked = start;
      gl_Position = projectionMatrix * x;
    }`;
  const BODY_FRAGMENT = `
    #extension GL_OES_standard_derivatives : enable
    precision highp float;
    uniform vec3 sun;
    varying vec3 seen;
    varying vec2 marked;
    void main() {
      vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));  // towards the viewer
      float turn = atan(marked.y, marked.x) / 6.2831853 + 1.0;
      float grey = mod(floor(turn * ${SPIN_SECTORS}.0), 2.0) > 0.5 ? 0.42 : 0.54;
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
      body.group = new THREE.Group();
      for (const side of data.mirrored ? [1, -1] : [1]) {
        const mesh = new THREE.Mesh(geometry, new THREE.RawShaderMaterial({
          vertexShader: BODY_VERTEX,
          fragmentShader: BODY_FRAGMENT,
          extensions: { derivatives: true },
          side: THREE.DoubleSide,
          uniforms: { side: { value: side }, sun: shared.sun },
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

    show(frame) {
      for (let k = 0; k < this.triangles.length; ++k)
        for (let axis = 0; axis < 3; ++axis)
          this.corners[3 * k + axis] = this.node(frame, this.triangles[k], axis);
      this.attribute.needsUpdate = true;
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
      return this.times[frame];
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
      this.moment = 0; // in this.times
      this.prepareInput();
      this.resize();
      this.look("oblique");
      this.update();
      window.addEventListener("resize", () => { this.resize(); this.draw(); });
    }

    prepareInput() {
      const { data, shared } = this;
      this.slider = this.find("time");
      this.slider.max = this.times.length - 1;
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

    // What the camera looks at, and from where: the same for all runs
    look(from) {
      const { centre, size } = this.data;
      const towards = {
        oblique: [0.62, -1.25, 0.62], side: [0, -1, 0.02], front: [1, 0, 0.05], above: [0, -0.02, 1],
      }[from];
      const target = new THREE.Vector3(...centre);
      if (this.find("follow").checked) target.x = 0;
      const width = this.canvas.clientWidth / this.runs.length;
      const distance = size * Math.max(1.25, 1.8 * this.canvas.clientHeight / width);
      this.controls.target.copy(target);
      this.camera.position.set(...towards).normalize().multiplyScalar(distance).add(target);
      this.camera.near = 0.01 * size;
      this.camera.far = 20 * size;
      this.controls.update();
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
      this.place.querySelectorAll(".furrow-label").forEach((label, k) => {
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
