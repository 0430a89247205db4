#include "apps/output/faces/faces_script.h"

namespace gestell::apps
{

const char *const faces_style = R"css(
body { max-width: 84rem; }
#board { display: flex; flex-wrap: wrap; gap: 1rem 1.6rem; align-items: flex-start; }
#board .view { flex: 1 1 34rem; min-width: 18rem; position: relative; }
#board canvas { width: 100%; height: auto; display: block; background: var(--band); border: 1px solid var(--rule);
                border-radius: 4px; touch-action: none; cursor: crosshair; }
#board .tools { display: flex; flex-wrap: wrap; gap: .4rem; margin: 0 0 .5rem; font-size: .9rem; align-items: center; }
button, input[type=text], input[type=search] { font: inherit; color: inherit; background: var(--band);
         border: 1px solid var(--rule); border-radius: 4px; padding: .15rem .55rem; }
button { cursor: pointer; }
#board .card { flex: 1 1 24rem; min-width: 18rem; }
#choices { display: flex; flex-wrap: wrap; gap: .4rem; }
#choices button[aria-pressed=true] { background: #ffe27a; color: #22272e; }
#board .card h2 { margin: 0 0 .3rem; border: 0; padding: 0; }
#board .card pre { white-space: pre-wrap; overflow-wrap: anywhere; user-select: all; }
#board .card td, #board .card th { padding: .15rem .8rem .15rem 0; }
#tip { position: absolute; pointer-events: none; background: var(--paper); border: 1px solid var(--rule);
       border-radius: 4px; padding: .1rem .5rem; font-size: .85rem; display: none; white-space: nowrap; }
.sides { display: grid; grid-template-columns: repeat(auto-fill, minmax(17rem, 1fr)); gap: 1rem; }
.sides figure { margin: 0; } .sides canvas { max-width: 100%; height: auto; display: block; cursor: pointer; }
#faces tr { cursor: pointer; } #faces tr.chosen td { background: #ffe27a; color: #22272e; }
#faces tr.under td { background: var(--band); }
#faces .patch { display: inline-block; width: .9em; height: .9em; border-radius: 2px; vertical-align: -1px; }
#faces .scroll { max-height: 32rem; }
@media print { #board, .filter { display: none; } }
)css";

const char *const faces_script = R"js(
(function () {
'use strict';
const decoded = (text, Kind) => { const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0)); return new Kind(bytes.buffer); };
const quantised = decoded(frame.points, Uint16Array), corners = decoded(frame.triangles, Uint32Array),
      faceOf = decoded(frame.face, Uint32Array), count = faceOf.length, n = quantised.length / 3;
const points = new Float32Array(3 * n);
let span = 0;
for (let d = 0; d < 3; ++d) span = Math.max(span, frame.max[d] - frame.min[d]);
for (let i = 0; i < 3 * n; ++i) { // middle of the box at 0, its longest edge 1
  const d = i % 3, wide = frame.max[d] - frame.min[d];
  points[i] = (quantised[i] / 65535 - .5) * wide / span;
}
const sides = { 'from front, right and above': [36, 21], 'from behind, left and below': [216, -21], 'front, seen along y': [0, 0],
  'right, seen against x': [90, 0], 'rear, seen against y': [180, 0], 'left, seen along x': [270, 0], 'top, seen against z': [0, 90],
  'bottom, seen along z': [180, -90] };
const views = { front: [0, 0], right: [90, 0], rear: [180, 0], left: [270, 0], top: [0, 90], bottom: [0, -90], 'from above': [36, 21] };
let chosen = -1, under = -1, choice = 0; // choice: of the surfaces that the chosen face belongs to
const isChosen = f => f === chosen || (chosen >= 0 && frame.list[chosen].choices[choice].faces.includes(f));

// The frame on a canvas: a raster of depths with the face at each pixel: exact picking, edges and numbers where faces are seen.
const screen = new Float32Array(3 * n), light = new Float32Array(count);
const leastRoom = 160, side = 400; // [pixels]: of a face for its number; of a picture from one side
class Sight {
  /** @param fine  pixels of the canvas to one of the page */
  constructor(canvas, [turn, tilt], fine = 1) {
    Object.assign(this, { canvas, turn, tilt, fine, wide: canvas.width, high: canvas.height, zoom: 1, shift: [0, 0], pending: false, held: null });
    this.unit = .74 * Math.min(this.wide, this.high); // [pixels] of the frame's longest edge
    if (fine > 1) this.fit();
    this.paper = canvas.getContext('2d');
    this.image = this.paper.createImageData(this.wide, this.high);
    this.pixel = new Uint32Array(this.image.data.buffer);
    this.depth = new Float32Array(this.wide * this.high);
    this.seen = new Int32Array(this.wide * this.high);
    canvas.addEventListener('pointermove', e => { if (!this.held) point(e, this.faceAt(e)); });
    canvas.addEventListener('pointerleave', e => point(e, -1));
  }
  /** As large as the frame is seen, with room for the axes below. */
  fit() {
    const { canvas, fine } = this, low = [1e9, 1e9], high = [-1e9, -1e9], margin = 8 * fine, foot = 84 * fine;
    this.project();
    for (let i = 0; i < n; ++i)
      for (let d = 0; d < 2; ++d) { low[d] = Math.min(low[d], screen[3 * i + d]); high[d] = Math.max(high[d], screen[3 * i + d]); }
    const grown = (side * fine - 2 * margin) / Math.max(high[0] - low[0], high[1] - low[1]);
    const middle = [0, 1].map(d => grown * ((low[d] + high[d]) / 2 - (d ? this.high : this.wide) / 2));
    this.unit *= grown;
    this.wide = canvas.width = Math.ceil(Math.max(grown * (high[0] - low[0]), 180 * fine) + 2 * margin);
    this.high = canvas.height = Math.ceil(grown * (high[1] - low[1]) + 2 * margin + foot);
    this.shift = [-middle[0], -middle[1] - foot / 2];
    canvas.style.width = this.wide / fine + 'px';
  }
  scale() { return this.zoom * this.unit; }
  project() {
    const a = this.turn * Math.PI / 180, e = this.tilt * Math.PI / 180, s = this.scale(), x0 = this.wide / 2 + this.shift[0], y0 = this.high / 2 + this.shift[1];
    const ca = Math.cos(a), sa = Math.sin(a), ce = Math.cos(e), se = Math.sin(e);
    for (let i = 0; i < n; ++i) {
      const x = points[3 * i], y = points[3 * i + 1], z = points[3 * i + 2];
      const right = ca * x + sa * y, ahead = sa * x - ca * y; // ahead: towards the viewer
      screen[3 * i] = x0 + s * right;
      screen[3 * i + 1] = y0 - s * (ce * z - se * ahead);
      screen[3 * i + 2] = ce * ahead + se * z;
    }
    return [[ca, se * sa], [sa, -se * ca], [0, -ce]]; // the axes in the picture, to the right and down
  }
  fill() {
    const { wide, high, depth, seen } = this, scale = this.scale();
    depth.fill(-1e9); seen.fill(-1);
    for (let t = 0; t < count; ++t) {
      const i = 3 * corners[3 * t], j = 3 * corners[3 * t + 1], k = 3 * corners[3 * t + 2];
      const x0 = screen[i], y0 = screen[i + 1], x1 = screen[j], y1 = screen[j + 1], x2 = screen[k], y2 = screen[k + 1];
      const area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0);
      if (area >= 0) continue; // seen from behind; y points down
      const z0 = screen[i + 2], z1 = screen[j + 2], z2 = screen[k + 2];
      const zx = ((z1 - z0) * (y2 - y0) - (z2 - z0) * (y1 - y0)) / area, zy = ((x1 - x0) * (z2 - z0) - (x2 - x0) * (z1 - z0)) / area;
      const nx = -zx * scale, ny = zy * scale, len = Math.hypot(nx, ny, 1);
      light[t] = .55 + .45 * Math.max(0, (.35 * nx + .45 * ny + .82) / len);
      const top = Math.max(0, Math.ceil(Math.min(y0, y1, y2))), bottom = Math.min(high - 1, Math.floor(Math.max(y0, y1, y2)));
      for (let y = top; y <= bottom; ++y) {
        let from = 1e9, to = -1e9;
        const cut = (xa, ya, xb, yb) => { // of the row with an edge
          if ((ya <= y) === (yb <= y)) return;
          const x = xa + (y - ya) / (yb - ya) * (xb - xa);
          if (x < from) from = x; if (x > to) to = x;
        };
        cut(x0, y0, x1, y1); cut(x1, y1, x2, y2); cut(x2, y2, x0, y0);
        from = Math.max(0, Math.ceil(from - .01)); to = Math.min(wide - 1, Math.floor(to + .01));
        let z = z0 + zx * (from - x0) + zy * (y - y0), at = y * wide + from;
        for (let x = from; x <= to; ++x, ++at, z += zx)
          if (z > depth[at]) { depth[at] = z; seen[at] = t; }
      }
    }
  }
  paint() {
    const { wide, high, seen, pixel } = this, marks = frame.list.map((_, f) => isChosen(f));
    for (let at = 0; at < wide * high; ++at) {
      const t = seen[at];
      if (t < 0) { pixel[at] = 0; continue; }
      const f = faceOf[t], marked = marks[f], c = marked ? [255, 214, 0] : frame.list[f].rgb;
      let l = light[t] * (f === under && !marked ? 1.25 : 1);
      const beside = at + 1 < wide * high ? seen[at + 1] : -1, below = at + wide < wide * high ? seen[at + wide] : -1;
      if (beside < 0 || below < 0 || faceOf[beside] !== f || faceOf[below] !== f) l = marked ? .1 : .3;
      pixel[at] = 0xff000000 | Math.min(255, l * c[2]) << 16 | Math.min(255, l * c[1]) << 8 | Math.min(255, l * c[0]);
    }
    this.paper.putImageData(this.image, 0, 0);
  }
  /** Where numbers stand: of each face with room the pixel nearest to the middle of what is seen; none upon another. */
  places() {
    const { wide, high, seen, fine } = this, sums = frame.list.map(() => [0, 0, 0]), best = frame.list.map(() => [Infinity, 0, 0]);
    const each = visit => {
      for (let y = 0, at = 0; y < high; ++y)
        for (let x = 0; x < wide; ++x, ++at) if (seen[at] >= 0) visit(faceOf[seen[at]], x, y);
    };
    each((f, x, y) => { const sum = sums[f]; ++sum[0]; sum[1] += x; sum[2] += y; });
    each((f, x, y) => {
      const [m, sx, sy] = sums[f], far = Math.hypot(x - sx / m, y - sy / m);
      if (far < best[f][0]) best[f] = [far, x, y];
    });
    const taken = [];
    best.forEach(([, x, y], f) => {
      const free = ({ x: a, y: b }) => Math.abs(a - x) > 22 * fine || Math.abs(b - y) > 13 * fine;
      if (sums[f][0] >= leastRoom * fine * fine && taken.every(free)) taken.push({ f, x, y });
    });
    return taken;
  }
  /** Numbers, axes and a bar of a round length; in pixels of the page. */
  write(axes) {
    const { paper, fine } = this, wide = this.wide / fine, high = this.high / fine;
    paper.save();
    paper.scale(fine, fine);
    paper.textAlign = 'center'; paper.lineJoin = 'round'; paper.lineWidth = 3;
    paper.font = '600 12px sans-serif'; paper.strokeStyle = '#fff'; paper.fillStyle = '#10151a';
    for (const { f, x, y } of this.places())
      for (const draws of ['strokeText', 'fillText']) paper[draws](frame.list[f].tag, x / fine, y / fine + 4);
    paper.font = '15px sans-serif'; paper.lineWidth = 2; paper.textAlign = 'left';
    const arm = fine > 1 ? 24 : 40, x0 = arm + 20, y0 = high - arm - 12;
    axes.forEach((e, d) => {
      if (Math.hypot(...e) < .1) return;
      paper.strokeStyle = paper.fillStyle = ['#d03030', '#208a40', '#2860d0'][d];
      paper.beginPath(); paper.moveTo(x0, y0); paper.lineTo(x0 + arm * e[0], y0 + arm * e[1]); paper.stroke();
      paper.fillText('xyz'[d], x0 - 4 + (arm + 12) * e[0], y0 + 5 + (arm + 12) * e[1]);
    });
    const per = this.scale() / fine / (span / frame.unit); // pixels per unit of the file
    const room = Math.min(200, .4 * wide), steps = Math.pow(10, Math.floor(Math.log10(room / per))), bar = [5, 2, 1].find(k => k * steps * per <= room) * steps;
    paper.strokeStyle = paper.fillStyle = getComputedStyle(document.body).color;
    paper.beginPath(); paper.moveTo(wide - 20 - bar * per, high - 20); paper.lineTo(wide - 20, high - 20); paper.stroke();
    paper.textAlign = 'right'; paper.fillText(+bar.toPrecision(6) + ' ' + frame.unitName, wide - 20, high - 28);
    paper.restore();
  }
  draw() {
    this.pending = false;
    const axes = this.project();
    this.fill(); this.paint(); this.write(axes);
  }
  redraw() { if (!this.pending) { this.pending = true; requestAnimationFrame(() => this.draw()); } }
  faceAt(event) {
    const { wide, high } = this, box = this.canvas.getBoundingClientRect();
    const x = Math.floor((event.clientX - box.left) * wide / box.width), y = Math.floor((event.clientY - box.top) * high / box.height);
    const t = x >= 0 && y >= 0 && x < wide && y < high ? this.seen[y * wide + x] : -1;
    return t < 0 ? -1 : faceOf[t];
  }
}
const canvas = document.getElementById('turn'), board = new Sight(canvas, [36, 21]);
const sights = Object.keys(sides).map(caption => {
  const figure = document.querySelector('.sides').appendChild(document.createElement('figure'));
  const sight = new Sight(document.createElement('canvas'), sides[caption], 2);
  figure.append(sight.canvas, Object.assign(document.createElement('figcaption'), { textContent: caption }));
  sight.canvas.addEventListener('click', e => choose(sight.faceAt(e), true));
  return sight;
});

const rows = Array.from(document.querySelectorAll('#faces tr')).slice(1);
rows.forEach((row, f) => { row.dataset.f = f; });
function mark() {
  rows.forEach((row, f) => { row.classList.toggle('chosen', isChosen(f)); row.classList.toggle('under', f === under); });
  board.redraw();
}
function show() { mark(); sights.forEach(sight => sight.redraw()); }
/** Face f lies under the pointer. */
function point(event, f) {
  tip(event, event.target === canvas ? f : -1);
  if (f !== under) { under = f; mark(); }
}
const by = id => document.getElementById(id);
function entry(f) {
  const name = by('name').value || 'face ' + frame.list[f].tag;
  return '[frame.surface.' + (/^[A-Za-z0-9_-]+$/.test(name) ? name : JSON.stringify(name)) + ']\n' + frame.list[f].choices[choice].selector;
}
/** Of the surfaces that face f belongs to the entry is for number i. */
function take(f, i) {
  choice = i;
  by('name').value = (i > 0 ? 'bore ' : 'face ') + frame.list[f].tag;
  by('entry').textContent = entry(f);
  Array.from(by('choices').children).forEach((button, k) => button.setAttribute('aria-pressed', k === i));
  show();
}
/** A button for each of them. */
function offer(f) {
  const { choices } = frame.list[f];
  by('choices').replaceChildren(...(choices.length < 2 ? [] : choices.map(({ name }, i) => {
    const button = document.createElement('button');
    button.textContent = name || 'this face alone';
    button.addEventListener('click', () => take(f, i));
    return button;
  })));
}
function choose(f, scrolls) {
  chosen = f;
  choice = 0;
  if (f >= 0) {
    const face = frame.list[f];
    by('head').textContent = 'Face ' + face.tag + (face.name ? ', "' + face.name + '"' : '');
    by('facts').innerHTML = '';
    face.facts.forEach(([word, value]) => {
      const row = by('facts').insertRow(), head = document.createElement('th');
      head.textContent = word; row.appendChild(head); row.insertCell().textContent = value;
    });
    by('others').textContent = face.others;
    offer(f);
    take(f, 0);
    by('card').hidden = false; by('hint').hidden = true;
    if (scrolls && rows[f]) { const box = rows[f].closest('.scroll'); box.scrollTop = rows[f].offsetTop - box.clientHeight / 2; }
    if (location.hash !== '#face-' + face.tag) history.replaceState(null, '', '#face-' + face.tag);
  } else show();
}
by('name').addEventListener('input', () => { if (chosen >= 0) by('entry').textContent = entry(chosen); });
by('copy').addEventListener('click', () => {
  const done = () => { by('copy').textContent = 'copied'; setTimeout(() => { by('copy').textContent = 'copy'; }, 1200); };
  const byHand = () => {
    const range = document.createRange(); range.selectNodeContents(by('entry'));
    const selection = getSelection(); selection.removeAllRanges(); selection.addRange(range);
    if (document.execCommand('copy')) done();
  };
  navigator.clipboard ? navigator.clipboard.writeText(by('entry').textContent).then(done, byHand) : byHand();
});
function tip(event, f) {
  const box = canvas.parentNode.getBoundingClientRect();
  by('tip').style.display = f < 0 ? 'none' : 'block';
  if (f < 0) return;
  by('tip').textContent = 'face ' + frame.list[f].tag + ': ' + frame.list[f].facts[0][1];
  by('tip').style.left = event.clientX - box.left + 14 + 'px'; by('tip').style.top = event.clientY - box.top + 14 + 'px';
}
canvas.addEventListener('pointerdown', e => { board.held = { x: e.clientX, y: e.clientY, moved: false, pans: e.shiftKey || e.button === 1 }; canvas.setPointerCapture(e.pointerId); });
canvas.addEventListener('pointermove', e => {
  const { held } = board;
  if (!held) return;
  const dx = e.clientX - held.x, dy = e.clientY - held.y;
  if (!held.moved && Math.hypot(dx, dy) < 4) return;
  held.moved = true; held.x = e.clientX; held.y = e.clientY; by('tip').style.display = 'none';
  if (held.pans) { board.shift[0] += dx * board.wide / canvas.clientWidth; board.shift[1] += dy * board.wide / canvas.clientWidth; }
  else { board.turn -= .4 * dx; board.tilt = Math.max(-90, Math.min(90, board.tilt + .4 * dy)); }
  board.redraw();
});
canvas.addEventListener('pointerup', e => { if (board.held && !board.held.moved) choose(board.faceAt(e), true); board.held = null; });
canvas.addEventListener('wheel', e => { e.preventDefault(); board.zoom = Math.max(.3, Math.min(60, board.zoom * Math.exp(-.0015 * e.deltaY))); board.redraw(); }, { passive: false });
Object.keys(views).forEach(name => {
  const button = document.createElement('button'); button.textContent = name;
  button.addEventListener('click', () => { [board.turn, board.tilt] = views[name]; board.zoom = 1; board.shift = [0, 0]; board.redraw(); });
  by('views').appendChild(button);
});
const ofRow = event => { const row = event.target.closest('tr[data-f]'); return row ? +row.dataset.f : -1; };
by('faces').addEventListener('click', e => { if (ofRow(e) >= 0) choose(ofRow(e), false); });
by('faces').addEventListener('mouseover', e => point(e, ofRow(e)));
by('faces').addEventListener('mouseleave', e => point(e, -1));
by('filter').addEventListener('input', () => {
  const words = by('filter').value.toLowerCase().split(/\s+/);
  rows.forEach(row => { row.hidden = !words.every(word => row.textContent.toLowerCase().includes(word)); });
});
const asked = frame.list.findIndex(face => location.hash === '#face-' + face.tag);
choose(asked, true);
})();
)js";

} // namespace gestell::apps
