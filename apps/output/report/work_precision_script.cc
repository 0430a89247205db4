#include "apps/output/report/work_precision_script.h"

namespace gestell::apps
{

const char *const work_precision_style = R"css(
:root { --s0: #0072b2; --s1: #d55e00; --s2: #009e73; --s3: #b0508f; --s4: #b07a00; --s5: #3a3f45; --s6: #3f9fd6; }
@media screen and (prefers-color-scheme: dark) {
  :root { --s0: #4fb0ea; --s1: #ff8a3d; --s2: #2fc79b; --s3: #e58cc3; --s4: #f0b429; --s5: #d5d9de; --s6: #8fd0f5; }
}
#chart .tools { display: flex; flex-wrap: wrap; gap: .4rem 1.2rem; align-items: center; margin: 1rem 0 .5rem; font-size: .92rem; }
#chart select, #chart button { font: inherit; color: inherit; background: var(--band); border: 1px solid var(--rule);
                               border-radius: 4px; padding: .15rem .5rem; }
#chart .board { display: flex; flex-wrap: wrap; gap: .6rem 1.4rem; align-items: flex-start; position: relative; }
#chart .plot { flex: 1 1 34rem; min-width: 20rem; }
#chart .plot svg { width: 100%; height: auto; display: block; touch-action: manipulation; }
#chart .methods { flex: 0 1 17rem; font-size: .88rem; columns: auto; }
#chart .methods label { display: block; line-height: 1.5; cursor: pointer; }
#chart .methods svg { margin: 0 .4em 0 .2em; vertical-align: -1px; }
#chart .methods .family { margin-top: .5rem; font-weight: 600; cursor: pointer; }
#chart .tip { position: absolute; pointer-events: none; background: var(--paper); border: 1px solid var(--rule);
              box-shadow: 0 2px 10px rgba(0,0,0,.18); border-radius: 5px; padding: .5rem .7rem; font-size: .84rem;
              max-width: 19rem; z-index: 2; line-height: 1.4; }
#chart .tip table { margin: .3rem 0 0; font-size: inherit; } #chart .tip td { padding: 0 .7rem 0 0; border: 0; }
#chart text { fill: var(--ink); font-size: 13px; } #chart .soft-line { stroke: var(--rule); stroke-width: 1; }
#chart .chosen { min-height: 1.6rem; }
@media print { #chart .tools, #chart .methods input { display: none; } }
)css";

const char *const work_precision_script = R"js(
(function () {
  'use strict';
  const box = document.getElementById('chart'), name = 'http://www.w3.org/2000/svg';
  const measures = { cpu: 'CPU time of stepping', total: 'CPU time with set-up', steps: 'steps', newton: 'Newton iterations',
                     factorisations: 'factorisations', solves: 'linear solves', evaluations: 'force evaluations' };
  const state = { model: work.models.length - 1, measure: 'cpu', events: 'both', hidden: new Set(), front: true };
  work.points.forEach(p => { p.total = p.cpu + p.setup; });
  const methods = [];
  work.points.forEach(p => { if (!methods.some(m => m.method === p.method)) methods.push({ method: p.method, family: p.family, colour: p.colour,
    style: methods.filter(m => m.family === p.family).length }); });

  function make(tag, attributes, parent, text) {
    const svg = ['svg', 'path', 'circle', 'line', 'text', 'rect', 'g'].includes(tag);
    const e = svg ? document.createElementNS(name, tag) : document.createElement(tag);
    for (const key in attributes) e.setAttribute(key, attributes[key]);
    if (text !== undefined) e.textContent = text;
    if (parent) parent.appendChild(e);
    return e;
  }
  function choice(parent, label, options, value, change) {
    const l = make('label', {}, parent, label + ' '), s = make('select', {}, l);
    for (const [key, text] of options) { const o = make('option', { value: key }, s, text); if (key === String(value)) o.selected = true; }
    s.addEventListener('change', () => { change(s.value); draw(); });
  }

  const tools = make('div', { class: 'tools' }, box);
  if (work.models.length > 1)
    choice(tools, 'model', work.models.map((m, i) => [String(i), m.coordinates + ' DOFs, ' + m.modes + ' modes']), state.model, v => { state.model = +v; });
  choice(tools, 'work measured by', Object.entries(measures), state.measure, v => { state.measure = v; });
  choice(tools, 'events', [['both', 'located and not located'], ['yes', 'located'], ['no', 'not located']], 'both', v => { state.events = v; });
  const frontLabel = make('label', {}, tools), frontBox = make('input', { type: 'checkbox', checked: '' }, frontLabel);
  frontLabel.append(' Pareto front');
  frontBox.addEventListener('change', () => { state.front = frontBox.checked; draw(); });
  const button = (text, act) => make('button', { type: 'button' }, tools, text).addEventListener('click', () => { act(); boxes(); draw(); });
  button('all', () => state.hidden.clear());
  button('none', () => methods.forEach(m => state.hidden.add(m.method)));
  button('Pareto front only', () => {
    const best = new Set(front().map(p => p.method));
    state.hidden.clear();
    methods.forEach(m => { if (!best.has(m.method)) state.hidden.add(m.method); });
  });

  const board = make('div', { class: 'board' }, box), plot = make('div', { class: 'plot' }, board);
  const list = make('div', { class: 'methods' }, board), tip = make('div', { class: 'tip', hidden: '' }, board);
  const chosen = make('div', { class: 'chosen' }, box);
  make('p', { class: 'soft' }, chosen, 'Solid lines: events located; dashed: events not located. Click a Gestell run to see its [run] settings.');

  function boxes() {
    list.textContent = '';
    let family = '';
    for (const m of methods) {
      if (m.family !== family) {
        family = m.family;
        const head = make('div', { class: 'family' }, list, family), own = methods.filter(x => x.family === m.family);
        head.title = 'show or hide this family';
        head.addEventListener('click', () => {
          const any = own.some(x => !state.hidden.has(x.method));
          own.forEach(x => any ? state.hidden.add(x.method) : state.hidden.delete(x.method));
          boxes(); draw();
        });
      }
      const l = make('label', {}, list), c = make('input', { type: 'checkbox' }, l);
      c.checked = !state.hidden.has(m.method);
      const s = make('svg', { viewBox: '-6 -6 12 12', width: 12, height: 12 }, l);
      make('path', { d: shapes[m.style % 4](0, 0), fill: 'var(--s' + m.colour + ')' }, s);
      l.append(m.method);
      c.addEventListener('change', () => { c.checked ? state.hidden.delete(m.method) : state.hidden.add(m.method); draw(); });
      l.addEventListener('mouseenter', () => emphasise(m.method));
      l.addEventListener('mouseleave', () => emphasise(null));
    }
  }

  const work_of = p => p[state.measure];
  const inModel = p => p.model === state.model && p.error > 0 && p.error <= 3 && work_of(p) > 0 &&
                       (state.events === 'both' || p.events === (state.events === 'yes'));
  function front() {
    let best = Infinity;
    return work.points.filter(p => inModel(p) && p.resolved).sort((a, b) => work_of(a) - work_of(b))
      .filter(p => p.error < best ? (best = p.error, true) : false);
  }
  function emphasise(method) {
    plot.querySelectorAll('g[data-method]').forEach(g => { g.style.opacity = method === null || g.dataset.method === method ? 1 : .15; });
  }
  const raised = n => '10' + String(n).replace('-', '⁻').replace(/\d/g, d => '⁰¹²³⁴⁵⁶⁷⁸⁹'[+d]);

  const time = t => t < .99e-3 ? +(1e6 * t).toPrecision(3) + ' µs' : t < .99 ? +(1e3 * t).toPrecision(3) + ' ms' : +t.toPrecision(3) + ' s';
  // Disc, square, triangle, diamond: the methods of a family in turn.
  const shapes = [
    (x, y) => 'M' + (x - 3.6) + ' ' + y + 'a3.6 3.6 0 1 0 7.2 0a3.6 3.6 0 1 0 -7.2 0Z',
    (x, y) => 'M' + (x - 3.2) + ' ' + (y - 3.2) + 'h6.4v6.4h-6.4Z',
    (x, y) => 'M' + x + ' ' + (y - 4.2) + 'l4 7h-8Z',
    (x, y) => 'M' + x + ' ' + (y - 4.6) + 'l4.2 4.6l-4.2 4.6l-4.2 -4.6Z'];
  function draw() {
    const W = 760, H = 560, L = 66, R = 745, T = 14, B = 505;
    plot.textContent = '';
    tip.hidden = true;
    const svg = make('svg', { viewBox: '0 0 ' + W + ' ' + H, role: 'img', 'aria-label': 'error against work' }, plot);
    const shown = work.points.filter(p => inModel(p) && !state.hidden.has(p.method));
    if (!shown.length) { make('text', { x: W / 2, y: H / 2, 'text-anchor': 'middle' }, svg, 'no runs to show'); return; }
    const lx = shown.map(p => Math.log10(work_of(p))), ly = shown.map(p => Math.log10(p.error));
    const x0 = Math.min(...lx) - .12, x1 = Math.max(...lx) + .12, y0 = Math.floor(Math.min(...ly) - .1), y1 = Math.ceil(Math.max(...ly) + .1);
    const px = x => L + (Math.log10(x) - x0) / (x1 - x0) * (R - L), py = y => B - (Math.log10(y) - y0) / (y1 - y0) * (B - T);
    const times = x1 - x0 < 2.5 ? [1, 2, 5] : [1], seconds = state.measure === 'cpu' || state.measure === 'total';
    for (let n = Math.floor(x0); n <= x1; ++n)
      for (const m of times) {
        const v = m * 10 ** n;
        if (Math.log10(v) < x0 || Math.log10(v) > x1) continue;
        make('line', { class: 'soft-line', x1: px(v), x2: px(v), y1: T, y2: B }, svg);
        make('text', { x: px(v), y: B + 20, 'text-anchor': 'middle' }, svg, seconds ? time(v) : m === 1 ? raised(n) : m + '·' + raised(n));
      }
    for (let n = y0; n <= y1; ++n) {
      make('line', { class: 'soft-line', x1: L, x2: R, y1: py(10 ** n), y2: py(10 ** n) }, svg);
      make('text', { x: L - 8, y: py(10 ** n) + 4, 'text-anchor': 'end' }, svg, raised(n));
    }
    make('text', { x: (L + R) / 2, y: B + 45, 'text-anchor': 'middle' }, svg, measures[state.measure]);
    make('text', { transform: 'translate(16 ' + (T + B) / 2 + ') rotate(-90)', 'text-anchor': 'middle' }, svg, 'error');
    const limit = 10 * work.models[state.model].reference;
    if (limit > 10 ** y0) {
      const y = Math.max(T, py(limit));
      make('rect', { x: L, y: y, width: R - L, height: Math.max(0, B - y), fill: 'var(--ink)', opacity: .07 }, svg);
      make('text', { x: R - 6, y: Math.max(T, py(limit)) + 16, 'text-anchor': 'end', opacity: .6 }, svg, 'not resolved by the reference');
    }
    if (state.front) {
      const f = front();
      make('path', { d: f.map((p, i) => (i ? 'L' : 'M') + px(work_of(p)) + ' ' + py(p.error)).join(''), fill: 'none', stroke: 'var(--ink)',
                     'stroke-width': 9, 'stroke-linejoin': 'round', 'stroke-linecap': 'round', opacity: .13 }, svg);
    }
    for (const m of methods)
      for (const events of [true, false]) {
        const line = shown.filter(p => p.method === m.method && p.events === events).sort((a, b) => b.value - a.value);
        if (!line.length) continue;
        const g = make('g', { 'data-method': m.method }, svg), c = 'var(--s' + m.colour + ')';
        make('path', { d: line.map((p, i) => (i ? 'L' : 'M') + px(work_of(p)) + ' ' + py(p.error)).join(''), fill: 'none', stroke: c,
                       'stroke-width': 1.6, 'stroke-dasharray': events ? 'none' : '5 4' }, g);
        for (const p of line)
          make('path', { d: shapes[m.style % 4](px(work_of(p)), py(p.error)), stroke: c, 'stroke-width': 1.3,
                         fill: p.resolved ? c : 'var(--paper)' }, g);
      }
    const ring = make('circle', { r: 7.5, fill: 'none', stroke: 'var(--ink)', 'stroke-width': 1.5, visibility: 'hidden' }, svg);
    const nearest = event => {
      const r = svg.getBoundingClientRect(), x = (event.clientX - r.left) * W / r.width, y = (event.clientY - r.top) * H / r.height;
      let best = null, d = 26 * 26;
      for (const p of shown) {
        const dd = (px(work_of(p)) - x) ** 2 + (py(p.error) - y) ** 2;
        if (dd < d) { d = dd; best = p; }
      }
      return best;
    };
    svg.addEventListener('mousemove', event => {
      const p = nearest(event);
      emphasise(p ? p.method : null);
      ring.setAttribute('visibility', p ? 'visible' : 'hidden');
      tip.hidden = !p;
      if (!p) return;
      ring.setAttribute('cx', px(work_of(p)));
      ring.setAttribute('cy', py(p.error));
      tell(p);
      const b = board.getBoundingClientRect(), x = event.clientX - b.left, left = x + 18 + tip.offsetWidth > b.width ? x - tip.offsetWidth - 14 : x + 18;
      tip.style.left = Math.max(0, left) + 'px';
      tip.style.top = event.clientY - b.top + 14 + 'px';
    });
    svg.addEventListener('mouseleave', () => { tip.hidden = true; ring.setAttribute('visibility', 'hidden'); emphasise(null); });
    svg.addEventListener('click', event => { const p = nearest(event); if (p) show(p); });
  }
  const short = x => x >= 1e-3 && x < 1e5 ? +x.toPrecision(4) + '' : x.toExponential(2);
  function rows(p, table) {
    const r = (a, b) => { const t = make('tr', {}, table); make('td', {}, t, a); make('td', {}, t, b); };
    r('error', short(p.error) + (p.resolved ? '' : ' (not resolved)'));
    r('CPU time', short(1e3 * p.cpu) + ' ms, set-up ' + short(1e3 * p.setup) + ' ms');
    r('steps', p.steps + (p.rejected ? ', ' + p.rejected + ' rejected' : ''));
    r('Newton', p.newton); r('solves', p.solves); r('factorisations', p.factorisations); r('evaluations', p.evaluations);
    r('events', p.located + (p.events ? ' located' : ' not located'));
  }
  function tell(p) {
    tip.textContent = '';
    make('strong', {}, tip, p.method);
    make('div', {}, tip, p.setting + (p.front ? ' · on the Pareto front' : ''));
    rows(p, make('table', {}, tip));
  }
  function show(p) {
    chosen.textContent = '';
    make('p', {}, chosen, p.method + ', ' + p.setting + ': error ' + short(p.error) + ' in ' + short(1e3 * p.cpu) + ' ms');
    if (p.lines) make('pre', {}, chosen, '[run]\n' + p.lines);
  }
  boxes();
  draw();
})();
)js";

} // namespace gestell::apps
