"use strict";
// What the parts of a page share: numbers in short form, and the instant that charts and machine show.
const gestell = { charts: [], machine: null };

gestell.bytes = function (text) {
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
};
gestell.floats = (text) => new Float32Array(gestell.bytes(text));

/** A number with so many significant digits, without needless zeros. */
gestell.number = function (value, digits = 5) {
  if (value === null || Number.isNaN(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(digits - 1).replace(/\.?0+e/, "e");
  return String(Number(value.toPrecision(digits)));
};

gestell.time = {
  t: null,
  listeners: [],
  listen(show) {
    this.listeners.push(show);
  },
  tell(t, source) {
    this.t = t;
    for (const show of this.listeners) if (show !== source) show(t);
  },
};
