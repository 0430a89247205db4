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
#board .card h2 { margin: 0 0 .3rem; border: 0; padding: 0; }
#board .card pre { white-space: pre-wrap; overflow-wrap: anywhere; user-select: all; }
#board .card td, #board .card th { padding: .15rem .8rem .15rem 0; }
#tip { position: absolute; pointer-events: none; background: var(--paper); border: 1px solid var(--rule);
       border-radius: 4px; padding: .1rem .5rem; font-size: .85rem; display: none; white-space: nowrap; }
.sides { display: grid; grid-template-columns: repeat(auto-fill, minmax(17rem, 1fr)); gap: 1rem; }
.sides path[data-f] { cursor: pointer; }
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
const canvas = document.getElementById('turn'), paper = canvas.getContext('2d'), wide = canvas.width, high = canvas.height;
const image = paper.createImageData(wide, high), pixel = new Uint32Array(image.data.buffer);
const depth = new Float32Array(wide * high), seen = new Int32Array(wide * high);
const views = { front: [0, 0], right: [90, 0], rear: [180, 0], left: [270, 0], top: [0, 90], bottom: [0, -90], 'from above': [36, 21] };
let turn = 36, tilt = 21, zoom = 1, shift = [0, 0], chosen = -1, under = -1, pending = false;

// A raster of depths with the face at each pixel: exact picking, and edges where faces meet.
const screen = new Float32Array(3 * n);
function project() {
  const a = turn * Math.PI / 180, e = tilt * Math.PI / 180, ca = Math.cos(a), sa = Math.sin(a), ce = Math.cos(e), se = Math.sin(e);
  const s = zoom * .74 * Math.min(wide, high);
  for (let i = 0; i < n; ++i) {
    const x = points[3 * i], y = points[3 * i + 1], z = points[3 * i + 2];
    const right = ca * x + sa * y, ahead = sa * x - ca * y; // ahead: towards the viewer
    screen[3 * i] = wide / 2 + shift[0] + s * right;
    screen[3 * i + 1] = high / 2 + shift[1] - s * (ce * z - se * ahead);
    screen[3 * i + 2] = ce * ahead + se * z;
  }
  return [ca, sa, ce, se, s];
}
const light = new Float32Array(count);
function fill() {
  depth.fill(-1e9); seen.fill(-1);
  for (let t = 0; t < count; ++t) {
    const i = 3 * corners[3 * t], j = 3 * corners[3 * t + 1], k = 3 * corners[3 * t + 2];
    const x0 = screen[i], y0 = screen[i + 1], x1 = screen[j], y1 = screen[j + 1], x2 = screen[k], y2 = screen[k + 1];
    const area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0);
    if (area >= 0) continue; // seen from behind; y points down
    const z0 = screen[i + 2], z1 = screen[j + 2], z2 = screen[k + 2];
    const zx = ((z1 - z0) * (y2 - y0) - (z2 - z0) * (y1 - y0)) / area, zy = ((x1 - x0) * (z2 - z0) - (x2 - x0) * (z1 - z0)) / area;
    const scale = zoom * .74 * Math.min(wide, high), nx = -zx * scale, ny = zy * scale, len = Math.hypot(nx, ny, 1);
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
function draw() {
  pending = false;
  const [ca, sa, ce, se] = project();
  fill();
  for (let at = 0; at < wide * high; ++at) {
    const t = seen[at];
    if (t < 0) { pixel[at] = 0; continue; }
    const f = faceOf[t], c = f === chosen ? [255, 214, 0] : frame.list[f].rgb;
    let l = light[t] * (f === under && f !== chosen ? 1.25 : 1);
    const beside = at + 1 < wide * high ? seen[at + 1] : -1, below = at + wide < wide * high ? seen[at + wide] : -1;
    if (beside < 0 || below < 0 || faceOf[beside] !== f || faceOf[below] !== f) l = f === chosen ? .1 : .3;
    pixel[at] = 0xff000000 | Math.min(255, l * c[2]) << 16 | Math.min(255, l * c[1]) << 8 | Math.min(255, l * c[0]);
  }
  paper.putImageData(image, 0, 0);
  paper.font = '15px sans-serif'; paper.lineWidth = 2;
  const axes = [[ca, se * sa], [sa, -se * ca], [0, -ce]];
  axes.forEach((e, d) => { // of the projection, to the right and down
    paper.strokeStyle = paper.fillStyle = ['#d03030', '#208a40', '#2860d0'][d];
    paper.beginPath(); paper.moveTo(60, high - 60); paper.lineTo(60 + 40 * e[0], high - 60 + 40 * e[1]); paper.stroke();
    paper.fillText('xyz'[d], 56 + 52 * e[0], high - 55 + 52 * e[1]);
  });
  const per = zoom * .74 * Math.min(wide, high) / (span / frame.unit); // pixels per unit of the file
  const steps = Math.pow(10, Math.floor(Math.log10(200 / per))), bar = [5, 2, 1].find(k => k * steps * per <= 200) * steps;
  paper.strokeStyle = paper.fillStyle = getComputedStyle(document.body).color;
  paper.beginPath(); paper.moveTo(wide - 30 - bar * per, high - 30); paper.lineTo(wide - 30, high - 30); paper.stroke();
  paper.textAlign = 'right'; paper.fillText(+bar.toPrecision(6) + ' ' + frame.unitName, wide - 30, high - 38); paper.textAlign = 'left';
}
function redraw() { if (!pending) { pending = true; requestAnimationFrame(draw); } }

const glow = document.head.appendChild(document.createElement('style'));
const rows = Array.from(document.querySelectorAll('#faces tr')).slice(1);
rows.forEach((row, f) => { row.dataset.f = f; });
function mark() {
  glow.textContent = (chosen >= 0 ? '.gst .faces path[data-f="' + chosen + '"]{color:#ffd600!important}' : '') +
    (under >= 0 && under !== chosen ? '.gst .faces path[data-f="' + under + '"]{filter:brightness(1.25)}' : '');
  rows.forEach((row, f) => { row.classList.toggle('chosen', f === chosen); row.classList.toggle('under', f === under); });
  redraw();
}
const by = id => document.getElementById(id);
function entry(f) {
  const name = by('name').value || 'face ' + frame.list[f].tag;
  return '[frame.surface.' + (/^[A-Za-z0-9_-]+$/.test(name) ? name : JSON.stringify(name)) + ']\n' + frame.list[f].selector;
}
function choose(f, scrolls) {
  chosen = f;
  if (f >= 0) {
    const face = frame.list[f];
    by('name').value = 'face ' + face.tag;
    by('head').textContent = 'Face ' + face.tag + (face.name ? ', "' + face.name + '"' : '');
    by('facts').innerHTML = '';
    face.facts.forEach(([word, value]) => {
      const row = by('facts').insertRow(), head = document.createElement('th');
      head.textContent = word; row.appendChild(head); row.insertCell().textContent = value;
    });
    by('others').textContent = face.others;
    by('entry').textContent = entry(f);
    by('card').hidden = false; by('hint').hidden = true;
    if (scrolls && rows[f]) { const box = rows[f].closest('.scroll'); box.scrollTop = rows[f].offsetTop - box.clientHeight / 2; }
    if (location.hash !== '#face-' + face.tag) history.replaceState(null, '', '#face-' + face.tag);
  }
  mark();
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
function faceAt(event) {
  const box = canvas.getBoundingClientRect();
  const x = Math.floor((event.clientX - box.left) * wide / box.width), y = Math.floor((event.clientY - box.top) * high / box.height);
  const t = x >= 0 && y >= 0 && x < wide && y < high ? seen[y * wide + x] : -1;
  return t < 0 ? -1 : faceOf[t];
}
function tip(event, f) {
  const box = canvas.parentNode.getBoundingClientRect();
  by('tip').style.display = f < 0 ? 'none' : 'block';
  if (f < 0) return;
  by('tip').textContent = 'face ' + frame.list[f].tag + ': ' + frame.list[f].facts[0][1];
  by('tip').style.left = event.clientX - box.left + 14 + 'px'; by('tip').style.top = event.clientY - box.top + 14 + 'px';
}
let held = null;
canvas.addEventListener('pointerdown', e => { held = { x: e.clientX, y: e.clientY, moved: false, pans: e.shiftKey || e.button === 1 }; canvas.setPointerCapture(e.pointerId); });
canvas.addEventListener('pointermove', e => {
  if (!held) {
    const f = faceAt(e);
    tip(e, f);
    if (f !== under) { under = f; mark(); }
    return;
  }
  const dx = e.clientX - held.x, dy = e.clientY - held.y;
  if (!held.moved && Math.hypot(dx, dy) < 4) return;
  held.moved = true; held.x = e.clientX; held.y = e.clientY; by('tip').style.display = 'none';
  if (held.pans) { shift[0] += dx * wide / canvas.clientWidth; shift[1] += dy * wide / canvas.clientWidth; }
  else { turn -= .4 * dx; tilt = Math.max(-90, Math.min(90, tilt + .4 * dy)); }
  redraw();
});
canvas.addEventListener('pointerup', e => { if (held && !held.moved) choose(faceAt(e), true); held = null; });
canvas.addEventListener('pointerleave', () => { under = -1; by('tip').style.display = 'none'; mark(); });
canvas.addEventListener('wheel', e => { e.preventDefault(); zoom = Math.max(.3, Math.min(60, zoom * Math.exp(-.0015 * e.deltaY))); redraw(); }, { passive: false });
Object.keys(views).forEach(name => {
  const button = document.createElement('button'); button.textContent = name;
  button.addEventListener('click', () => { [turn, tilt] = views[name]; zoom = 1; shift = [0, 0]; redraw(); });
  by('views').appendChild(button);
});
document.addEventListener('click', e => { const at = e.target.closest && e.target.closest('[data-f]'); if (at) choose(+at.dataset.f, !at.closest('#faces')); });
document.addEventListener('mouseover', e => {
  const at = e.target.closest && e.target.closest('[data-f]'), f = at ? +at.dataset.f : -1;
  if (e.target !== canvas && f !== under) { under = f; mark(); }
});
by('filter').addEventListener('input', () => {
  const words = by('filter').value.toLowerCase().split(/\s+/);
  rows.forEach(row => { row.hidden = !words.every(word => row.textContent.toLowerCase().includes(word)); });
});
const asked = frame.list.findIndex(face => location.hash === '#face-' + face.tag);
choose(asked, true);
})();
)js";

} // namespace gestell::apps
