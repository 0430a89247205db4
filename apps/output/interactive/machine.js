"use strict";
// The machine in three.js: it turns, moves as computed, in its modes and under stress.  Elements of class "machine" hold the data.
(function () {
  const loop_seconds = 8, mode_seconds = 2;
  const slow = 1 / 34, coarsest = 0.4; // seconds between pictures at which they get fewer pixels, and the fewest

  function element(kind, properties, ...children) {
    const made = Object.assign(document.createElement(kind), properties);
    made.append(...children);
    return made;
  }
  const from = new THREE.Vector3(0.55, -0.75, 0.36).normalize(); // where the eye is at first: front, right and above
  const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);

  /** A motion in short form: whole shapes with weights over instants. */
  class Field {
    constructor(data) {
      this.shapes = data.shapes.map((text) => new Int16Array(gestell.bytes(text)));
      this.weights = gestell.floats(data.weights);
    }
    /** Adds factor times the motion at instant k + share. */
    add(values, k, share, factor) {
      const n = this.shapes.length;
      this.shapes.forEach((shape, r) => {
        const now = this.weights[k * n + r], next = share > 0 ? this.weights[(k + 1) * n + r] : now;
        const weight = factor * (now + share * (next - now));
        for (let i = 0; i < values.length; ++i) values[i] += weight * shape[i];
      });
    }
  }

  /** Faces that are turned to the eye, the nearest first: glass then hides what of itself lies behind. */
  class Part {
    constructor(data, colour, glass) {
      this.name = data.name;
      this.colour = colour;
      this.rest = gestell.floats(data.points);
      this.moved = new Float32Array(this.rest.length);
      this.at = new Float32Array(this.rest);
      this.paints = new Float32Array(this.rest.length);
      this.corners = new Uint32Array(gestell.bytes(data.triangles));
      this.n_faces = this.corners.length / 3;
      this.keys = new Float64Array(this.n_faces);
      this.lights = new Float32Array(this.n_faces);
      this.positions = new THREE.BufferAttribute(new Float32Array(3 * this.corners.length), 3);
      this.colours = new THREE.BufferAttribute(new Uint8Array(3 * this.corners.length), 3, true);
      const faces = new THREE.BufferGeometry(), lines = new THREE.BufferGeometry();
      faces.setAttribute("position", this.positions);
      faces.setAttribute("color", this.colours);
      this.points = new THREE.BufferAttribute(this.at, 3);
      lines.setAttribute("position", this.points);
      lines.setIndex(new THREE.BufferAttribute(new Uint32Array(gestell.bytes(data.edges)), 1));
      this.faces = new THREE.Mesh(faces, new THREE.MeshBasicMaterial({ vertexColors: THREE.VertexColors,
        polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
      this.lines = new THREE.LineSegments(lines, new THREE.LineBasicMaterial({ color: 0x20262e, transparent: true, opacity: 0.45 }));
      this.faces.renderOrder = this.lines.renderOrder = glass ? 1 : 0; // over what it lets be seen
      this.faces.frustumCulled = this.lines.frustumCulled = false;
      this.paint_plain();
    }
    see_through(share) {
      Object.assign(this.faces.material, { transparent: share > 0, opacity: 1 - share });
    }
    paint_plain() {
      for (let i = 0; i < this.paints.length; ++i) this.paints[i] = this.colour[i % 3];
    }
    /** Colours of the table by place(point) in [0, 1]. */
    paint(table, place) {
      for (let i = 0; i < this.paints.length / 3; ++i) {
        const colour = table[Math.min(table.length - 1, Math.max(0, Math.floor(place(i) * table.length)))];
        this.paints[3 * i] = colour[0];
        this.paints[3 * i + 1] = colour[1];
        this.paints[3 * i + 2] = colour[2];
      }
    }
    /** Where it is: ideal motion, and displacement enlarged. */
    place(fields, k, share, enlarge, swing) {
      const at = this.at;
      at.set(this.rest);
      if (fields.ideal) fields.ideal.add(at, k, share, 1);
      this.moved.fill(0);
      if (fields.moved) fields.moved.add(this.moved, k, share, swing);
      for (let i = 0; i < at.length; ++i) at[i] += enlarge * this.moved[i];
      this.points.needsUpdate = true;
    }
    /** Light and distance of the faces that the eye sees; their numbers, the nearest first. */
    seen_faces(eye, lamp) {
      const { at, corners, keys } = this;
      let n = 0;
      for (let f = 0; f < this.n_faces; ++f) {
        const a = 3 * corners[3 * f], b = 3 * corners[3 * f + 1], c = 3 * corners[3 * f + 2];
        const ux = at[b] - at[a], uy = at[b + 1] - at[a + 1], uz = at[b + 2] - at[a + 2];
        const vx = at[c] - at[a], vy = at[c + 1] - at[a + 1], vz = at[c + 2] - at[a + 2];
        const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        const ex = eye.x - at[a], ey = eye.y - at[a + 1], ez = eye.z - at[a + 2];
        if (nx * ex + ny * ey + nz * ez <= 0) continue;
        const size = Math.sqrt(nx * nx + ny * ny + nz * nz);
        this.lights[f] = 0.66 + 0.42 * Math.max(0, (nx * lamp.x + ny * lamp.y + nz * lamp.z) / size);
        const mx = ex - (ux + vx) / 3, my = ey - (uy + vy) / 3, mz = ez - (uz + vz) / 3;
        // Distance in whole micrometres, then the number: plain numbers are sorted at once.
        keys[n++] = Math.floor(1e6 * Math.sqrt(mx * mx + my * my + mz * mz)) * this.n_faces + f;
      }
      return keys.subarray(0, n).sort().map((key) => key % this.n_faces);
    }
    /** Hands the faces in sight to three.js. */
    show_faces(eye, lamp) {
      const to = this.positions.array, colours = this.colours.array;
      let n = 0;
      for (const f of this.seen_faces(eye, lamp)) {
        const light = 255 * this.lights[f];
        for (let corner = 0; corner < 3; ++corner) {
          const from = 3 * this.corners[3 * f + corner];
          for (let i = 0; i < 3; ++i, ++n) {
            to[n] = this.at[from + i];
            colours[n] = Math.min(255, light * this.paints[from + i]);
          }
        }
      }
      this.faces.geometry.setDrawRange(0, n / 3);
      this.positions.needsUpdate = this.colours.needsUpdate = true;
    }
    displacement(i) {
      return Math.hypot(this.moved[3 * i], this.moved[3 * i + 1], this.moved[3 * i + 2]);
    }
    largest_displacement() {
      let most = 0;
      for (let i = 0; i < this.moved.length / 3; ++i) most = Math.max(most, this.displacement(i));
      return most;
    }
  }

  class Show {
    constructor(data) {
      Object.assign(this, data);
      this.times = data.times ? gestell.floats(data.times) : null;
      this.paints = data.colours ? new Uint8Array(gestell.bytes(data.colours)) : null;
      this.fields = null; // made when it is first seen
    }
    prepare() {
      const field = (data) => (data ? new Field(data) : null);
      this.fields = this.fields || this.parts.map((part) => ({ ideal: field(part.ideal), moved: field(part.moved) }));
    }
    /** Instant before t and the share of the way to the next. */
    instant(t) {
      if (!this.times) return [0, 0];
      let k = 0;
      while (k + 2 < this.times.length && this.times[k + 1] <= t) ++k;
      if (this.times.length < 2) return [0, 0];
      const step = this.times[k + 1] - this.times[k]; // none where single precision tells no difference
      const share = step > 0 ? Math.min(1, Math.max(0, (t - this.times[k]) / step)) : 1;
      return this.smooth ? [k, share] : [share < 0.5 ? k : k + 1, 0];
    }
  }

  const lamp_of = (camera) => new THREE.Vector3(-0.4, 0.55, 0.75).normalize().applyQuaternion(camera.quaternion);

  /** The axes as a camera sees them, about (x, y). */
  function draw_axes(paper, camera, x, y) {
    const turn = camera.quaternion.clone().inverse();
    paper.font = "13px system-ui, sans-serif";
    paper.lineWidth = 2;
    const axes = [["x", "#d03030"], ["y", "#209040"], ["z", "#3060d0"]].map(([name, colour], i) =>
      [name, colour, new THREE.Vector3(i === 0, i === 1, i === 2).applyQuaternion(turn)]);
    for (const [name, colour, way] of axes.sort((a, b) => a[2].z - b[2].z)) {
      paper.strokeStyle = paper.fillStyle = colour;
      paper.beginPath();
      paper.moveTo(x, y);
      paper.lineTo(x + 30 * way.x, y - 30 * way.y);
      paper.stroke();
      paper.fillText(name, x + 38 * way.x - 4, y - 38 * way.y + 4);
    }
  }

  class View {
    constructor(box) {
      this.box = box;
      this.data = JSON.parse(box.querySelector("script").textContent);
      this.table = this.data.colours.map(rgb);
      this.parts = this.data.parts.map((part, i) => new Part(part, this.colour_of(i), this.data.has_frame && i === 0));
      this.shows = this.data.shows.map((show) => new Show(show));
      this.frames = 0;
      this.t = 0;
      this.phase = 0;
      this.build_scene();
      this.build_bars();
      box.classList.add("drawn");
      this.choose(0);
      this.fit();
      gestell.time.listen((this.follow = (t) => this.go_to(t)));
      new ResizeObserver(() => this.resize()).observe(this.space);
      requestAnimationFrame((now) => this.tick(now));
    }

    colour_of(i) {
      if (this.data.has_frame && i === 0) return rgb(this.data.frame_colour);
      const { body_colours } = this.data;
      return rgb(body_colours[(i - (this.data.has_frame ? 1 : 0)) % body_colours.length]);
    }

    build_scene() {
      this.renderer = new THREE.WebGLRenderer({ antialias: false, alpha: true });
      this.pixels = Math.max(1.5, Math.min(2, window.devicePixelRatio)); // at rest: finer than seen, for smooth edges
      this.scene = new THREE.Scene();
      this.camera = new THREE.PerspectiveCamera(28, 1, this.data.size / 100, this.data.size * 100);
      this.camera.up.set(0, 0, 1);
      for (const part of this.parts) this.scene.add(part.faces, part.lines);
      this.space = element("div", { className: "machine-canvas", tabIndex: 0 });
      this.space.setAttribute("aria-label", "3-D view of the machine; drag to rotate, Shift+drag to move, wheel to zoom after a click");
      this.triad = element("canvas", { className: "over", width: 90, height: 90 });
      Object.assign(this.triad.style, { left: "4px", bottom: "4px" });
      this.space.append(this.renderer.domElement, this.triad);
      this.controls = new THREE.OrbitControls(this.camera, this.renderer.domElement);
      this.controls.enableKeys = false;
      this.controls.enableZoom = false;
      this.controls.addEventListener("change", () => (this.stale = true));
      this.space.addEventListener("pointerdown", () => this.space.focus({ preventScroll: true }));
      this.space.addEventListener("focus", () => (this.controls.enableZoom = true));
      this.space.addEventListener("blur", () => (this.controls.enableZoom = false));
    }

    build_bars() {
      this.play = element("button", { type: "button", className: "page-button", onclick: () => this.set_playing(!this.playing) });
      this.list = element("select", { onchange: () => this.choose(this.list.selectedIndex) },
        ...this.shows.map((show) => element("option", { textContent: show.name })));
      this.slider = element("input", { type: "range", className: "long", min: 0, max: 1000, step: "any",
        oninput: () => this.slide(Number(this.slider.value)) });
      this.now = element("span", {});
      this.scale = element("input", { type: "range", min: -2, max: 1, step: "any", oninput: () => this.rescale() });
      this.scale_text = element("span", {});
      this.paint = element("select", { onchange: () => this.repaint() }, element("option", { textContent: "displacement" }),
        element("option", { textContent: "part" }));
      this.bar = element("span", { className: "machine-scale" });
      this.bar.style.background = "linear-gradient(90deg," + this.data.colours.join(",") + ")";
      this.bar_text = element("span", {});
      this.legend = element("span", {}, this.bar, " ", this.bar_text);
      this.time_label = element("label", {}, "t", this.slider, this.now);
      this.paint_label = element("label", {}, "colour by", this.paint);
      this.glass = element("input", { type: "checkbox", checked: this.parts.length > 1, onchange: () => this.repaint() });
      this.glass_label = element("label", {}, this.glass, "transparent frame");
      this.glass_label.style.display = this.data.has_frame && this.parts.length > 1 ? "" : "none";
      const whole = element("button", { type: "button", className: "page-button", textContent: "fit", onclick: () => this.fit() });
      const names = element("div", { className: "machine-names" }, ...this.parts.map((part) => this.name_of(part)));
      this.box.append(
        element("div", { className: "machine-bar" }, element("label", {}, "show", this.list), this.play, this.time_label, whole),
        this.space,
        element("div", { className: "machine-bar" }, element("label", {}, "displacements", this.scale, this.scale_text),
          this.paint_label, this.legend, this.glass_label),
        names,
        element("p", { className: "soft", textContent: "Drag to rotate, Shift+drag to move, wheel to zoom after a click. " +
          "Only displacements are enlarged, not the ideal motion of the mechanism." }));
    }

    name_of(part, can_hide = true) {
      const square = element("i", {}), box = element("input", { type: "checkbox", checked: true });
      square.style.background = "rgb(" + part.colour.map((x) => Math.round(255 * x)).join(",") + ")";
      if (!can_hide) return element("span", {}, square, part.name);
      box.onchange = () => {
        part.faces.visible = part.lines.visible = box.checked;
        this.stale = true;
      };
      return element("label", {}, box, square, part.name);
    }

    choose(i) {
      this.show = this.shows[i];
      this.show.prepare();
      this.list.selectedIndex = i;
      const motion = this.show.kind === "motion";
      this.time_label.style.display = motion ? "" : "none";
      this.play.style.display = motion || this.show.kind === "mode" ? "" : "none";
      this.paint_label.style.display = motion || this.show.kind === "mode" ? "" : "none";
      this.phase = 0.25;
      if (motion) this.t = this.show.times[0];
      this.scale.value = 0;
      this.set_playing(this.show.kind === "mode");
      if (this.show.kind === "stress") gestell.time.tell(this.show.t, this.follow);
      this.rescale();
    }

    rescale() {
      const middle = this.show.enlarge, share = Number(this.scale.value);
      this.enlarge = middle * 10 ** share;
      if (share <= -1.99) this.enlarge = this.show.kind === "mode" ? 0 : 1;
      this.scale_text.textContent = this.show.kind === "mode" ? Math.round(100 * 10 ** share) + " %"
        : "× " + gestell.number(this.enlarge, 2);
      this.repaint();
    }

    repaint() {
      if (this.data.has_frame) this.parts[0].see_through(this.glass.checked ? 0.5 : 0);
      const by_displacement = this.paint.selectedIndex === 0 && this.show.kind !== "rest";
      this.legend.style.visibility = this.show.paints || by_displacement ? "" : "hidden";
      this.bar_text.textContent = this.show.scale || (this.show.kind === "mode" ? "displacement relative to the largest"
        : "displacement 0 to " + gestell.number(1000 * this.show.top, 3) + " mm");
      this.stale = true;
    }

    slide(value) {
      const { times } = this.show;
      this.set_playing(false);
      this.go_to(times[0] + (value / 1000) * (times[times.length - 1] - times[0]));
      gestell.time.tell(this.t, this.follow);
    }

    go_to(t) {
      if (this.show.kind !== "motion") return;
      const { times } = this.show;
      this.t = Math.min(times[times.length - 1], Math.max(times[0], t));
      this.stale = true;
    }

    set_playing(playing) {
      this.playing = playing;
      this.measured = null;
      this.set_pixels(playing ? Math.min(1, this.moving_pixels || 1) : this.pixels);
      this.play.textContent = playing ? "pause" : "play";
    }

    advance(seconds) {
      this.stale = true;
      if (this.show.kind === "mode") {
        this.phase = (this.phase + seconds / mode_seconds) % 1;
        return;
      }
      const { times } = this.show, first = times[0], span = times[times.length - 1] - first;
      this.t = span > 0 ? first + ((this.t - first + (span * seconds) / loop_seconds) % span) : first;
      gestell.time.tell(this.t, this.follow);
    }

    set_pixels(ratio) {
      if (this.renderer.getPixelRatio() !== ratio) this.renderer.setPixelRatio(ratio);
      this.stale = true;
    }

    /** A motion that stutters gets fewer pixels, then no edges, until it stops: the mean of twelve pictures decides. */
    keep_pace(now) {
      this.measured = this.measured || { begin: now, count: 0 };
      if (++this.measured.count < 12) return;
      const seconds = (now - this.measured.begin) / 11000, ratio = this.renderer.getPixelRatio();
      this.measured = null;
      if (seconds <= slow || ratio <= coarsest) return;
      this.moving_pixels = Math.max(coarsest, ratio * (seconds > 2 * slow ? 0.6 : 0.8));
      this.set_pixels(this.moving_pixels);
    }

    tick(now) {
      requestAnimationFrame((next) => this.tick(next));
      if (this.playing) this.keep_pace(now);
      const seconds = Math.min(0.1, (now - (this.last || now)) / 1000);
      this.last = now;
      if (this.playing) this.advance(seconds);
      if (!this.stale) return;
      this.stale = false;
      this.draw();
    }

    draw() {
      const mode = this.show.kind === "mode", swing = mode ? Math.sin(2 * Math.PI * this.phase) : 1;
      const top = this.show.kind === "rest" || this.paint.selectedIndex === 1 ? 0 : this.show.top;
      this.pose(this.show, { t: this.t, enlarge: this.enlarge, swing, top, bodies: mode });
      if (this.show.times) {
        const { times } = this.show, span = times[times.length - 1] - times[0];
        this.slider.value = span > 0 ? (1000 * (this.t - times[0])) / span : 0;
        this.now.textContent = gestell.number(this.t, 4) + " s";
      }
      const stutters = this.playing && this.moving_pixels < 0.7;
      for (const part of this.parts) {
        part.lines.visible = part.faces.visible && !stutters;
        if (part.faces.visible) part.show_faces(this.camera.position, lamp_of(this.camera));
      }
      this.renderer.render(this.scene, this.camera);
      const paper = this.triad.getContext("2d");
      paper.clearRect(0, 0, 90, 90);
      draw_axes(paper, this.camera, 45, 45);
      ++this.frames;
    }

    /**
     * Puts the parts where a show has them and colours the frame, with `bodies` all parts, by displacement, of which
     * `top` has the last colour, or by the show's stress; with 0 each part in its own colour.
     */
    pose(show, { t, enlarge, swing = 1, top, bodies = false }) {
      show.prepare();
      const [k, share] = show.instant(t);
      this.parts.forEach((part, i) => {
        const is_frame = this.data.has_frame && i === 0;
        part.place(show.fields[i], k, share, enlarge, swing);
        if (is_frame && show.paints) part.paint(this.table, (point) => show.paints[point] / 255);
        else if (!show.paints && top > 0 && (is_frame || bodies)) part.paint(this.table, (point) => part.displacement(point) / top);
        else part.paint_plain();
      });
    }

    /** All parts in sight. */
    fit() {
      const box = new THREE.Box3();
      for (const part of this.parts) box.union(new THREE.Box3().setFromArray(part.rest));
      const ball = box.getBoundingSphere(new THREE.Sphere()), wide = Math.min(1, this.camera.aspect);
      const away = (1.05 * ball.radius) / Math.sin((this.camera.fov * Math.PI) / 360) / wide;
      this.controls.target.copy(ball.center);
      this.camera.position.copy(ball.center).add(from.clone().multiplyScalar(away));
      this.controls.update();
      this.stale = true;
    }

    resize() {
      const { clientWidth: width, clientHeight: height } = this.space, first = !this.sized;
      this.renderer.setPixelRatio(this.pixels);
      this.renderer.setSize(width, height);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      this.sized = true;
      if (first) this.fit();
      this.stale = true;
    }
  }

  function build(box) {
    try {
      gestell.machine = new View(box);
      gestell.draw_pictures(gestell.machine);
    } catch (problem) {
      box.textContent = "This browser draws no three-dimensional view: " + problem.message;
      box.style.display = "block";
    }
  }
  Object.assign(gestell, { element, lamp_of, draw_axes, from });
  // The page is read while the view is made.
  window.addEventListener("load", () => setTimeout(() => document.querySelectorAll(".machine").forEach(build), 0));
})();
