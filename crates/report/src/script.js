// Zoom and values under the pointer for the figures over time. A figure holds its picture as SVG and, as JSON, the numbers of its
// panels; what is shown zoomed is drawn anew over the picture.
(() => {
  "use strict";
  const FINE = 16; // units of the picture in one of its pixels
  const numbers = text => new Float32Array(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
  const escape = text => text.replace(/[&<>]/g, c => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;" })[c]);

  function add(parent, name, attributes, text) {
    const child = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) child.setAttribute(key, value);
    if (text !== undefined) child.textContent = text;
    parent.append(child);
    return child;
  }

  // Round values between low and high, so many at most, each with its label.
  function ticks(low, high, most, logarithmic) {
    const out = [];
    if (logarithmic) {
      const every = Math.max(1, Math.ceil(Math.log10(high / low) / most));
      for (let e = Math.ceil(Math.log10(low)); e <= Math.log10(high); e++)
        if (e % every === 0) out.push([10 ** e, "1e" + e]);
      return out;
    }
    const raw = (high - low) / most, decade = 10 ** Math.floor(Math.log10(raw));
    const step = decade * [1, 2, 5, 10].find(s => s * decade >= raw * (1 - 1e-9));
    const decimals = Math.max(0, -Math.floor(Math.log10(step * (1 + 1e-9))));
    for (let i = Math.ceil(low / step); i <= high / step; i++) {
      const label = (i * step).toFixed(decimals);
      out.push([i * step, (Number(label) === 0 ? label.replace("-", "") : label).replace("-", "\u2212")]);
    }
    return out;
  }

  // Index of the last value that is not above x.
  function below(values, x) {
    let low = 0, high = values.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (values[middle] <= x) low = middle; else high = middle - 1;
    }
    return low;
  }

  class Figure {
    constructor(figure) {
      this.figure = figure;
      this.svg = figure.querySelector("svg.sheet");
      this.width = this.svg.viewBox.baseVal.width / FINE;
      this.height = this.svg.viewBox.baseVal.height / FINE;
      this.panels = JSON.parse(figure.querySelector("script").textContent);
      for (const panel of this.panels) {
        panel.t = numbers(panel.t);
        for (const curve of panel.curves) curve.values = numbers(curve.values);
        for (const row of panel.marks) row.times = numbers(row.times);
        panel.unit = (/\[(.*)\]/.exec(panel.label) || ["", ""])[1];
      }
      this.whole = this.panels[0].x;
      const top = { transform: `scale(${FINE})`, "font-family": "DejaVu Sans, Verdana, sans-serif", fill: "#222" };
      this.cover = add(this.svg, "g", { ...top, class: "zoomed" });
      this.pointer = add(this.svg, "g", { ...top, class: "pointer" });
      this.tip = document.createElement("div");
      this.tip.className = "tip";
      this.tip.hidden = true;
      figure.append(this.tip);
      this.tools();
      this.show(...this.whole);
      this.svg.addEventListener("pointermove", event => this.move(event));
      this.svg.addEventListener("pointerleave", () => this.leave());
      this.svg.addEventListener("pointerdown", event => this.press(event));
      this.svg.addEventListener("pointerup", event => this.release(event));
      this.svg.addEventListener("dblclick", () => this.show(...this.whole));
      this.svg.addEventListener("wheel", event => this.wheel(event), { passive: false });
    }

    tools() {
      const bar = document.createElement("div");
      bar.className = "tools";
      bar.innerHTML = "<span>Drag over a stretch of time to zoom; double-click shows all.</span>";
      for (const [label, title, action] of [
        ["\u2212", "Zoom out", () => this.zoom(2)], ["+", "Zoom in", () => this.zoom(0.5)],
        ["\u25c2", "Earlier", () => this.shift(-0.4)], ["\u25b8", "Later", () => this.shift(0.4)],
        ["All", "Show all", () => this.show(...this.whole)],
      ]) {
        const button = document.createElement("button");
        button.type = "button";
        button.textContent = label;
        button.title = title;
        button.setAttribute("aria-label", title);
        button.addEventListener("click", action);
        bar.append(button);
      }
      this.figure.prepend(bar);
    }

    // Where the pointer is, in pixels of the picture, and its time.
    at(event) {
      const box = this.svg.getBoundingClientRect();
      const x = (event.clientX - box.left) / box.width * this.width;
      const [left, , right] = this.panels[0].frame;
      const share = Math.min(1, Math.max(0, (x - left) / (right - left)));
      return { x: left + share * (right - left), time: this.from + share * (this.to - this.from), box };
    }

    zoom(factor, time = (this.from + this.to) / 2) {
      this.show(time - (time - this.from) * factor, time + (this.to - time) * factor);
    }

    shift(share) {
      const length = this.to - this.from, [first, last] = this.whole;
      const from = Math.min(Math.max(this.from + share * length, first), last - length);
      this.show(from, from + length);
    }

    show(from, to) {
      const [first, last] = this.whole;
      const shortest = (last - first) * 1e-4;
      if (!(to - from > shortest)) [from, to] = [(from + to - shortest) / 2, (from + to + shortest) / 2];
      this.from = Math.max(first, from);
      this.to = Math.min(last, to);
      this.figure.dataset.from = this.from;
      this.figure.dataset.to = this.to;
      this.cover.replaceChildren();
      this.pointer.replaceChildren();
      if (this.from === first && this.to === last) {
        for (const panel of this.panels) panel.shown = panel.y;
        return;
      }
      const top = this.panels[0].frame[1] - 27; // the legend ends above
      add(this.cover, "rect", { x: 0, y: top, width: this.width, height: this.height - top, fill: "#fff" });
      this.panels.forEach((panel, i) => this.panel(panel, i === this.panels.length - 1));
    }

    // The values between from and to decide what the vertical axis shows.
    range(panel) {
      if (panel.logarithmic) return panel.y;
      const first = below(panel.t, this.from), last = below(panel.t, this.to) + 1;
      let low = Infinity, high = -Infinity;
      for (const { values } of panel.curves) {
        if (values.length === 1) continue;
        for (let i = first; i <= Math.min(last, values.length - 1); i++) {
          low = Math.min(low, values[i]);
          high = Math.max(high, values[i]);
        }
      }
      if (!(high >= low)) return panel.y;
      const room = high > low ? 0.08 * (high - low) : 0.5 * Math.abs(high) || 1;
      return [low - room * (panel.marks.length ? 2 : 1), high + room];
    }

    place(panel, t, value) {
      const [left, top, right, bottom] = panel.frame, [low, high] = panel.shown;
      const share = panel.logarithmic
        ? Math.log(Math.max(value, 1e-300) / low) / Math.log(high / low) : (value - low) / (high - low);
      const y = bottom - Math.min(50, Math.max(-50, share)) * (bottom - top);
      return [left + (t - this.from) / (this.to - this.from) * (right - left), y];
    }

    panel(panel, last) {
      const [left, top, right, bottom] = panel.frame, g = this.cover;
      panel.shown = this.range(panel);
      const line = (x1, y1, x2, y2, colour, width) =>
        add(g, "line", { x1, y1, x2, y2, stroke: colour, "stroke-width": width });
      const text = (x, y, words, size, anchor) => add(g, "text", { x, y, "font-size": size, "text-anchor": anchor }, words);
      for (const [t, label] of ticks(this.from, this.to, 12, false)) {
        const [x] = this.place(panel, t, 0);
        line(x, top, x, bottom, "#e4e4e4", 1.5);
        line(x, bottom, x, bottom + 8, "#505050", 2);
        if (last) text(x, bottom + 36, label, 25, "middle");
      }
      for (const [value, label] of ticks(...panel.shown, (bottom - top) / 60, panel.logarithmic)) {
        const [, y] = this.place(panel, this.from, value);
        line(left, y, right, y, "#e4e4e4", 1.5);
        line(left - 8, y, left, y, "#505050", 2);
        text(left - 14, y + 9, label, 25, "end");
      }
      line(left, top, left, bottom, "#505050", 2);
      line(left, bottom, right, bottom, "#505050", 2);
      const middle = (top + bottom) / 2;
      text(28, middle, panel.label, 27, "middle").setAttribute("transform", `rotate(-90 28 ${middle})`);
      if (last) text((left + right) / 2, bottom + 77, "time [s]", 27, "middle");
      const [width, height] = [right - left, bottom - top];
      const inside = add(g, "svg", { x: left, y: top, width, height, viewBox: `${left} ${top} ${width} ${height}` });
      for (const curve of panel.curves) this.curve(inside, panel, curve);
      panel.events.forEach(([t, words], row) => {
        if (t < this.from || t > this.to) return;
        const [x] = this.place(panel, t, 0), after = x < (left + right) / 2;
        add(inside, "line", { x1: x, x2: x, y1: top, y2: bottom, stroke: "#222", "stroke-width": 2, "stroke-dasharray": "10 7" });
        const at = { x: x + (after ? 10 : -10), y: top + 30 + 36 * row };
        add(inside, "text", { ...at, "font-size": 25, "text-anchor": after ? "start" : "end" }, words);
      });
      panel.marks.forEach(({ times, colour }, row) => {
        const y = bottom - 13 - 25 * row;
        let before = -Infinity;
        for (const time of times) {
          const [x] = this.place(panel, time, 0);
          if (time < this.from || time > this.to || x - before < 2) continue;
          add(inside, "path", { d: x - before < 15 ? `M${x} ${y - 9}v15h2v-15z` : `M${x} ${y - 10}l9 15h-18z`, fill: colour });
          before = x;
        }
      });
    }

    curve(inside, panel, { values, colour, width, dashed }) {
      const points = [];
      if (values.length === 1) {
        points.push(this.place(panel, this.from, values[0]), this.place(panel, this.to, values[0]));
      } else {
        const last = Math.min(below(panel.t, this.to) + 1, values.length - 1);
        for (let i = below(panel.t, this.from); i <= last; i++) points.push(this.place(panel, panel.t[i], values[i]));
      }
      const style = { fill: "none", stroke: colour, "stroke-width": width };
      if (dashed) style["stroke-dasharray"] = `${5 * width} ${3.5 * width}`;
      add(inside, "polyline", { ...style, points: points.map(p => p[0].toFixed(2) + "," + p[1].toFixed(2)).join(" ") });
    }

    move(event) {
      const { x, time, box } = this.at(event);
      this.pointer.replaceChildren();
      const top = this.panels[0].frame[1], bottom = this.panels[this.panels.length - 1].frame[3];
      if (this.start) {
        const from = Math.min(x, this.start.x), width = Math.abs(x - this.start.x);
        add(this.pointer, "rect", { x: from, y: top, width, height: bottom - top, fill: "#56b4e9", opacity: 0.25 });
      }
      add(this.pointer, "line", { x1: x, x2: x, y1: top, y2: bottom, stroke: "#666", "stroke-width": 1.5 });
      let words = `<em>t = ${time.toFixed(3)} s</em>`;
      for (const panel of this.panels) {
        const i = below(panel.t, time), nearest = panel.t[i + 1] - time < time - panel.t[i] ? i + 1 : i;
        words += `<em>${escape(panel.label)}</em>`;
        for (const { name, colour, values } of panel.curves) {
          const value = values.length === 1 ? values[0] : values[nearest];
          words += `<i style="background:${colour}"></i>${escape(name)} `;
          words += `<b>${value === undefined ? "\u2013" : value.toPrecision(4).replace("-", "\u2212")}</b> ${escape(panel.unit)}<br>`;
          if (value === undefined || values.length === 1) continue;
          const [cx, cy] = this.place(panel, panel.t[nearest], value);
          if (cy >= panel.frame[1] && cy <= panel.frame[3] && cx >= panel.frame[0] && cx <= panel.frame[2])
            add(this.pointer, "circle", { cx, cy, r: 7, fill: colour, stroke: "#fff", "stroke-width": 2 });
        }
      }
      this.tip.innerHTML = words;
      this.tip.hidden = false;
      const outer = this.figure.getBoundingClientRect(), place = event.clientX - outer.left;
      const left = place + 18 + this.tip.offsetWidth > outer.width ? place - 18 - this.tip.offsetWidth : place + 18;
      const lowest = box.bottom - outer.top - this.tip.offsetHeight;
      this.tip.style.left = Math.max(0, left) + "px";
      this.tip.style.top = Math.max(0, Math.min(event.clientY - outer.top - 30, lowest)) + "px";
    }

    leave() {
      this.start = undefined;
      this.pointer.replaceChildren();
      this.tip.hidden = true;
    }

    press(event) {
      if (event.button !== 0) return;
      this.start = this.at(event);
      event.preventDefault();
    }

    release(event) {
      const start = this.start, end = this.at(event);
      this.start = undefined;
      if (start && Math.abs(end.x - start.x) > 8) this.show(Math.min(start.time, end.time), Math.max(start.time, end.time));
    }

    // The wheel alone scrolls the page.
    wheel(event) {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      this.zoom(event.deltaY > 0 ? 1.25 : 0.8, this.at(event).time);
    }
  }

  for (const figure of document.querySelectorAll("figure.live")) new Figure(figure);
  addEventListener("beforeprint", () => document.querySelectorAll("details").forEach(details => { details.open = true; }));
})();
