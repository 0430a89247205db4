"use strict";
// Pictures of the machine beside the text, on paper too: figures of class "machine-picture" name what of the view they show.
(function () {
  const { element, from, lamp_of, draw_axes } = gestell;
  const longest_side = 400, margin = 12, foot = 74, most_names = 30; // [pixels]; bodies that are named
  const shown_size = 0.05; // of the machine: largest displacement as drawn, as that of modes
  const ink = "#7a828c", edges = { color: 0x20262e, opacity: 0.45 }, outlines = { color: 0x7a828c, opacity: 0.9 }; // seen on light and dark paper
  let renderer = null;

  class Picture {
    constructor(view, figure, show) {
      const { t, later, enlarge } = figure.dataset, number = (text) => (text === undefined ? undefined : Number(text));
      Object.assign(this, { view, figure, show, t: number(t), later: number(later), enlarge: number(enlarge) });
      this.frame_only = /^(frame|stress)/.test(show.id);
      this.enlarge = this.enlarge === undefined ? (show.kind === "mode" ? show.enlarge : (shown_size * view.data.size) / (show.top || 1)) : this.enlarge;
      this.canvas = element("canvas", { width: 2 * longest_side, height: longest_side, title: "open in the 3-D view", onclick: () => this.choose() });
      this.legend = element("div", { className: "machine-names" });
      figure.prepend(this.canvas, this.legend);
      figure.classList.add("drawn"); // now it has a place, where it is seen
    }

    choose() {
      const { view, show, t } = this;
      view.choose(view.shows.indexOf(show));
      if (t !== undefined) view.go_to(t);
      view.box.scrollIntoView({ behavior: "smooth" });
    }

    /** One over the other: the bodies later and the frame at rest in outline, then the machine. */
    layers() {
      const { t, later, enlarge, view } = this, layers = [{ t, enlarge }];
      if (view.data.has_frame && enlarge > 0) layers.unshift({ t, enlarge: 0, outline: (i) => i === 0 });
      if (later !== undefined) layers.unshift({ t: later, enlarge: 0, outline: (i) => i > 0 || !view.data.has_frame });
      return layers;
    }

    pose({ t, enlarge, outline }) {
      const { view, show } = this, frame = view.data.has_frame ? view.parts[0] : null;
      const options = { t: t === undefined ? 0 : t, enlarge };
      view.pose(show, { ...options, top: 0 });
      this.top = enlarge === 0 ? 0 : show.kind === "mode" ? show.top : frame ? frame.largest_displacement() : 0;
      view.pose(show, { ...options, top: this.top, bodies: show.kind === "mode" && !frame });
      view.parts.forEach((part, i) => {
        part.faces.visible = part.lines.visible = (outline ? outline(i) : true) && (i === 0 || !this.frame_only);
        part.faces.material.colorWrite = !outline; // an outline hides what of itself lies behind
        const { color, opacity } = outline ? outlines : edges;
        part.lines.material.color.set(color);
        part.lines.material.opacity = opacity;
      });
    }

    /** Sees all that the layers show, in parallel projection. */
    look() {
      const right = new THREE.Vector3(0, 0, 1).cross(from).normalize(), up = from.clone().cross(right), x = new THREE.Vector3();
      const box = new THREE.Box2(), { size } = this.view.data;
      for (const layer of this.layers()) {
        this.pose(layer);
        for (const part of this.view.parts)
          for (let i = 0; part.faces.visible && i < part.at.length; i += 3)
            box.expandByPoint(new THREE.Vector2(right.dot(x.fromArray(part.at, i)), up.dot(x)));
      }
      const middle = box.getCenter(new THREE.Vector2()), wide = box.max.x - box.min.x, high = box.max.y - box.min.y;
      this.scale = (longest_side - 2 * margin) / Math.max(wide, high, 1e-9);
      this.width = Math.max(Math.ceil(this.scale * wide) + 2 * margin, 240);
      this.height = Math.ceil(this.scale * high) + 2 * margin;
      const half = [this.width, this.height].map((pixels) => pixels / this.scale / 2);
      this.camera = new THREE.OrthographicCamera(-half[0], half[0], half[1], -half[1], 90 * size, 110 * size);
      this.camera.up.set(0, 0, 1);
      this.camera.position.copy(from).multiplyScalar(100 * size).addScaledVector(right, middle.x).addScaledVector(up, middle.y);
      this.camera.lookAt(this.camera.position.clone().sub(from));
      this.camera.updateMatrixWorld();
    }

    draw() {
      const { view } = this, visible = view.parts.map((part) => part.faces.visible);
      this.drawn = true;
      renderer = renderer || new THREE.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
      this.look();
      renderer.setPixelRatio(2);
      renderer.setSize(this.width, this.height);
      Object.assign(this.canvas, { width: 2 * this.width, height: 2 * (this.height + foot) });
      this.canvas.style.width = this.width + "px";
      const paper = this.canvas.getContext("2d");
      paper.scale(2, 2);
      if (view.data.has_frame) view.parts[0].see_through(this.frame_only || view.parts.length === 1 ? 0 : 0.5);
      for (const layer of this.layers()) {
        this.pose(layer);
        for (const part of view.parts) if (part.faces.visible) part.show_faces(this.camera.position, lamp_of(this.camera));
        renderer.render(view.scene, this.camera);
        paper.drawImage(renderer.domElement, 0, 0, this.width, this.height);
      }
      if (this.show.mark !== undefined) this.ring(paper);
      draw_axes(paper, this.camera, 45, this.height + 36);
      this.draw_length(paper, 110, this.height + 54);
      this.write_legend();
      view.parts.forEach((part, i) => Object.assign(part.faces, { visible: visible[i] }));
      view.repaint();
    }

    /** A ring about the place of the largest stress, dashed where it lies behind. */
    ring(paper) {
      const [frame] = this.view.parts, { mark } = this.show, at = new THREE.Vector3().fromArray(frame.at, 3 * mark);
      const ray = new THREE.Ray(at.clone().addScaledVector(from, 0.006 * this.view.data.size), from), hit = new THREE.Vector3();
      const corner = (i) => new THREE.Vector3().fromArray(frame.at, 3 * frame.corners[i]);
      let hidden = false;
      for (let i = 0; i < frame.corners.length && !hidden; i += 3)
        hidden = ray.intersectTriangle(corner(i), corner(i + 1), corner(i + 2), false, hit) !== null;
      const seen = at.project(this.camera);
      paper.strokeStyle = "#d02030";
      paper.lineWidth = 2;
      paper.setLineDash(hidden ? [3, 3] : []);
      paper.beginPath();
      paper.arc((0.5 + seen.x / 2) * this.width, (0.5 - seen.y / 2) * this.height, 9, 0, 2 * Math.PI);
      paper.stroke();
      paper.setLineDash([]);
    }

    /** A bar of a round length. */
    draw_length(paper, x, y) {
      const room = 110 / this.scale, power = 10 ** Math.floor(Math.log10(room)), length = [5, 2, 1].find((k) => k * power <= room) * power;
      paper.strokeStyle = paper.fillStyle = ink;
      paper.lineWidth = 1;
      paper.strokeRect(x, y, this.scale * length, 0);
      for (const end of [x, x + this.scale * length]) paper.strokeRect(end, y - 3, 0, 6);
      paper.textAlign = "center";
      paper.fillText(length < 1 ? gestell.number(1000 * length) + " mm" : gestell.number(length) + " m", x + (this.scale * length) / 2, y - 7);
      paper.textAlign = "left";
    }

    write_legend() {
      const { view, show } = this, bar = element("i", { className: "machine-scale" }), lines = [];
      bar.style.background = view.bar.style.background;
      const words = show.scale || (show.kind === "motion" && this.top > 0 && "frame 0 to " + gestell.number(1000 * this.top, 3) + " mm");
      if (words) lines.push(element("span", {}, bar, words));
      const bodies = this.frame_only ? [] : view.parts.slice(view.data.has_frame ? 1 : 0);
      for (const part of bodies.slice(0, most_names)) lines.push(view.name_of(part, false));
      if (bodies.length > most_names) lines.push("and " + (bodies.length - most_names) + " more");
      this.legend.replaceChildren(...lines);
    }
  }

  gestell.draw_pictures = function (view) {
    const pictures = [];
    for (const figure of document.querySelectorAll(".machine-picture")) {
      const show = view.shows.find((one) => one.id === figure.dataset.show);
      if (show) pictures.push(new Picture(view, figure, show));
    }
    // Where the browser gives no second drawing area the caption stays, and the view above shows the same.
    const draw = (picture) => {
      try {
        if (!picture.drawn) picture.draw();
      } catch (_) {
        picture.figure.classList.remove("drawn");
      }
    };
    const watch = new IntersectionObserver((entries) => entries.filter((entry) => entry.isIntersecting).forEach((entry) =>
      draw(pictures.find((picture) => picture.figure === entry.target))), { rootMargin: "300px" });
    for (const picture of pictures) watch.observe(picture.figure);
    window.addEventListener("beforeprint", () => pictures.forEach(draw));
    gestell.pictures = pictures;
  };
})();
