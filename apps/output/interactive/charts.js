"use strict";
// Figures of class "live": the picture is replaced by a chart of dygraphs over the data beside it.
(function () {
  const dashes = [null, [7, 3], [2, 3], [9, 3, 2, 3], [4, 2], [12, 4, 2, 4, 2, 4]];

  /** Rows [x, y, ...] over the abscissae of all curves; null: the curve has none there. */
  function rows(data) {
    const ys = data.curves.map((curve) => gestell.floats(curve.y));
    if (data.x) {
      const x = gestell.floats(data.x);
      return Array.from(x, (at, i) => [at, ...ys.map((y) => y[i])]);
    }
    const found = new Map();
    data.curves.forEach((curve, j) =>
      gestell.floats(curve.x).forEach((at, i) => {
        if (!found.has(at)) found.set(at, [at, ...data.curves.map(() => null)]);
        found.get(at)[j + 1] = ys[j][i];
      }));
    return [...found.values()].sort((a, b) => a[0] - b[0]);
  }

  function element(kind, properties, ...children) {
    const made = Object.assign(document.createElement(kind), properties);
    made.append(...children);
    return made;
  }

  class LiveChart {
    constructor(figure) {
      this.figure = figure;
      this.data = JSON.parse(figure.querySelector("script").textContent);
      this.rows = rows(this.data);
      this.colours = this.read_colours();
      this.build_frame();
      figure.classList.add("drawn");
      this.build_graph();
      this.build_legend();
      this.listen_to_keys();
      if (this.data.link) gestell.time.listen((this.show = (t) => this.show_at(t)));
    }

    read_colours() {
      const style = getComputedStyle(this.figure.querySelector("svg") || document.querySelector("figure.live svg"));
      const colour = (name) => style.getPropertyValue("--" + name).trim();
      return {
        series: this.data.curves.map((curve) => colour("s" + (curve.colour % 7))),
        mark: (i) => colour("s" + (i % 7)), ink: colour("ink"), grid: colour("grid"),
      };
    }

    build_frame() {
      const reset = element("button", { type: "button", className: "page-button", textContent: "reset",
        title: "show the whole range (key 0)", onclick: () => this.reset() });
      this.legend = element("div", { className: "chart-legend" });
      this.plot = element("div", { className: "plot", tabIndex: 0 });
      this.plot.style.height = this.data.height + "px";
      this.plot.setAttribute("role", "application");
      this.plot.setAttribute("aria-label", this.data.title +
        ": arrows move the cursor, with Shift the window; plus and minus zoom, 0 shows all");
      this.cursor = element("div", { className: "plot-cursor" });
      const head = element("div", { className: "chart-head" }, element("strong", { textContent: this.data.title }),
        element("span", { className: "soft", textContent: this.data.note }), reset);
      this.figure.prepend(element("div", { className: "chart" }, head, this.legend, this.plot));
    }

    options() {
      const [x_log, y_log] = this.data.logarithmic, [low, high] = this.data.y_window;
      const axis = { axisLabelFontSize: 12, gridLineColor: this.colours.grid, axisLineColor: this.colours.ink };
      const [begin, end] = this.data.x_window;
      const first = this.rows[0][0], last = this.rows[this.rows.length - 1][0];
      return {
        labels: ["x", ...this.data.curves.map((_, i) => String(i))],
        colors: this.colours.series,
        series: Object.fromEntries(this.data.curves.map((curve, i) => [String(i), {
          strokePattern: dashes[Math.max(curve.line, 0)], strokeWidth: curve.line < 0 ? 0 : 1.4,
          drawPoints: curve.points, pointSize: 3,
        }])),
        axes: {
          x: { ...axis, logscale: x_log, valueFormatter: (value) => gestell.number(value, 6),
               axisLabelFormatter: (value, step) => gestell.number(value, 6) },
          y: { ...axis, axisLabelWidth: 62, axisLabelFormatter: (value) => gestell.number(value, 5) },
        },
        logscale: y_log, legend: "never", connectSeparatedPoints: !this.data.x,
        xlabel: this.data.x_label, ylabel: this.data.y_label, xLabelHeight: 17, yLabelWidth: 17,
        dateWindow: begin === null && end === null ? null : [begin === null ? first : begin, end === null ? last : end],
        valueRange: low === null && high === null ? null : [low, high],
        highlightCircleSize: 3,
        underlayCallback: (canvas, area, graph) => this.draw_marks(canvas, area, graph),
        drawCallback: () => this.place_cursor(),
        highlightCallback: (event, x) => this.point_at(x),
      };
    }

    build_graph() {
      this.graph = new Dygraph(this.plot, this.rows, this.options());
      this.plot.append(this.cursor);
    }

    draw_marks(canvas, area, graph) {
      canvas.save();
      canvas.strokeStyle = canvas.fillStyle = this.colours.ink;
      canvas.globalAlpha = 0.5;
      canvas.font = "10.5px system-ui, sans-serif";
      canvas.textAlign = "center";
      canvas.setLineDash([2, 3]);
      let free = area.x, last_line = -Infinity; // lines closer than 8 are ticks, so that many events hide no curve
      for (const [at, , number] of this.data.marks) {
        const x = graph.toDomXCoord(at), half = 3.2 * String(number).length;
        if (x < area.x || x > area.x + area.w) continue;
        canvas.beginPath();
        canvas.moveTo(x, number > 0 ? area.y : area.y + area.h - 14);
        canvas.lineTo(x, number > 0 && x < last_line + 8 ? area.y + 7 : area.y + area.h);
        canvas.stroke();
        if (number > 0 && x >= last_line + 8) last_line = x;
        if (number > 0 && x - half >= free) {
          canvas.fillText(number, x, area.y + 10);
          free = x + half + 2;
        }
      }
      canvas.textAlign = "right";
      for (const [level, name] of this.data.levels) {
        const y = graph.toDomYCoord(level);
        if (y < area.y || y > area.y + area.h) continue;
        canvas.beginPath();
        canvas.moveTo(area.x, y);
        canvas.lineTo(area.x + area.w, y);
        canvas.stroke();
        canvas.fillText(name, area.x + area.w - 4, y - 3);
      }
      canvas.restore();
    }

    build_legend() {
      this.at = element("span", { className: "at" });
      this.entries = this.data.curves.map((curve, i) => {
        const line = element("i", {}), value = element("span", {});
        line.style.borderColor = this.colours.series[i];
        line.style.borderTopStyle = curve.line < 0 || curve.line === 2 ? "dotted" : curve.line === 0 ? "solid" : "dashed";
        const button = element("button", { type: "button", title: "show or hide the curve" }, line, curve.name, value);
        button.setAttribute("aria-pressed", "true");
        button.onclick = () => this.toggle(i, button);
        if (curve.name) this.legend.append(button);
        return value;
      });
      this.legend.append(this.at);
    }

    toggle(i, button) {
      const shown = !this.graph.visibility()[i];
      this.graph.setVisibility(i, shown);
      button.setAttribute("aria-pressed", String(shown));
    }

    /** The cursor moved here; others follow. */
    point_at(x) {
      this.show_at(x);
      if (this.data.link) gestell.time.tell(x, this.show);
    }

    show_at(x) {
      this.x = x;
      this.place_cursor();
      const k = this.row_before(x);
      this.entries.forEach((value, i) => {
        const y = this.value_at(x, k, i + 1);
        value.textContent = y === null ? "" : " " + gestell.number(y);
      });
      const name = this.data.x_label.replace(/ *\[(.*)\]/, ""), unit = (this.data.x_label.match(/\[(.*)\]/) || ["", ""])[1];
      this.at.textContent = "at " + name + " = " + gestell.number(x, 6) + " " + unit + this.mark_text(x);
    }

    mark_text(x) {
      const [begin, end] = this.graph.xAxisRange(), reach = (end - begin) / 150;
      const near = this.data.marks.filter((mark) => Math.abs(mark[0] - x) < reach);
      if (near.length === 0) return "";
      const [, text, number] = near.reduce((a, b) => (Math.abs(a[0] - x) < Math.abs(b[0] - x) ? a : b));
      return "; " + (number > 0 ? number + ": " : "") + text;
    }

    row_before(x) {
      let low = 0, high = this.rows.length - 1;
      while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (this.rows[middle][0] <= x) low = middle;
        else high = middle;
      }
      return low;
    }

    /** On the line between row k and the next; of the nearer one where the other has no value; beyond the ends the last. */
    value_at(x, k, column) {
      const row = this.rows[k], next = this.rows[Math.min(k + 1, this.rows.length - 1)], length = next[0] - row[0];
      const share = length > 0 ? Math.min(1, Math.max(0, (x - row[0]) / length)) : 0;
      if (row[column] === null || next[column] === null) return (share < 0.5 ? row : next)[column];
      return share === 0 ? row[column] : row[column] + share * (next[column] - row[column]);
    }

    place_cursor() {
      if (!this.graph || this.x === undefined) return;
      const area = this.graph.getArea(), x = this.graph.toDomXCoord(this.x);
      const seen = x >= area.x && x <= area.x + area.w;
      Object.assign(this.cursor.style, { display: seen ? "block" : "none", left: x + "px", top: area.y + "px",
        height: area.h + "px" });
    }

    reset() {
      const [begin, end] = this.data.x_window, [low, high] = this.data.y_window;
      this.graph.updateOptions({
        dateWindow: begin === null && end === null ? null : this.options().dateWindow,
        valueRange: low === null && high === null ? null : [low, high],
      });
    }

    zoom(factor) {
      const [begin, end] = this.graph.xAxisRange();
      const middle = this.x > begin && this.x < end ? this.x : (begin + end) / 2;
      this.window(middle - (middle - begin) * factor, middle + (end - middle) * factor);
    }

    window(begin, end) {
      const [first, last] = this.graph.xAxisExtremes();
      this.graph.updateOptions({ dateWindow: [Math.max(begin, first), Math.min(end, last)] });
    }

    step(direction, pans) {
      const [begin, end] = this.graph.xAxisRange(), way = ((end - begin) / (pans ? 10 : 100)) * direction;
      const [first, last] = this.graph.xAxisExtremes();
      if (!pans) this.point_at(Math.min(end, Math.max(begin, (this.x === undefined ? begin : this.x) + way)));
      else if (begin + way >= first && end + way <= last) this.window(begin + way, end + way);
    }

    listen_to_keys() {
      const actions = {
        ArrowLeft: (event) => this.step(-1, event.shiftKey), ArrowRight: (event) => this.step(1, event.shiftKey),
        "+": () => this.zoom(0.5), "-": () => this.zoom(2), 0: () => this.reset(),
      };
      this.plot.addEventListener("keydown", (event) => {
        if (!actions[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        actions[event.key](event);
      });
      this.plot.addEventListener("wheel", (event) => {
        if (!event.ctrlKey) return; // the page scrolls
        event.preventDefault();
        this.zoom(event.deltaY > 0 ? 1.25 : 0.8);
      }, { passive: false });
    }
  }

  // A chart is as wide as its place, which has no width while it is folded.
  const folded = [...document.querySelectorAll("details:not([open])")], unfold = (is) => folded.forEach((e) => (e.open = is));
  unfold(true);
  for (const figure of document.querySelectorAll("figure.live")) gestell.charts.push(new LiveChart(figure));
  unfold(false);
  document.addEventListener("toggle", (event) => gestell.charts.forEach((chart) =>
    event.target.open && event.target.contains(chart.figure) && chart.graph.resize()), true);
  const over_time = gestell.charts.filter((chart) => chart.data.link === "time");
  if (over_time.length > 1)
    Dygraph.synchronize(over_time.map((chart) => chart.graph), { selection: false, zoom: true, range: false });
})();
