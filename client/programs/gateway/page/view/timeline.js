// Contacts over time: from "not before" to "by then", as far as is known.
import { levelAt, LEVELS } from "../model/world.js";
import { bracket, colorOf, element, fullName, width as widthOf } from "./format.js";

const ROW = 16, TOP = 18, ROWS_MAX = 60;
const SPAN_MIN = 0.02, SPAN_MAX = 1200;

/** Bars of events on a canvas; the wheel zooms, dragging moves, a click chooses. */
export class Timeline {
  /** `onChoose(one)`: an entry of World.events. `onHover(one, t)`: null: nothing. */
  constructor(world, canvas, tip, onChoose, onHover) {
    Object.assign(this, { world, canvas, tip, onChoose, onHover });
    this.span = 30;       // [s] that are shown
    this.shift = -0.65;   // where its begin is, in spans from the time that is shown
    this.bars = [];
    this.chosen = null;
    canvas.addEventListener("wheel", (wheel) => this.zoom(wheel), { passive: false });
    canvas.addEventListener("pointerdown", (down) => this.grab(down));
    canvas.addEventListener("pointermove", (move) => this.move(move));
    canvas.addEventListener("pointerleave", () => this.leave());
    canvas.addEventListener("click", (click) => {
      if (this.hasMoved) return;
      const one = this.at(click);
      if (one) onChoose(one);
    });
  }

  begin() {
    return (this.t ?? 0) + this.shift * this.span;
  }

  xOf(t) {
    return ((t - this.begin()) / this.span) * this.canvas.clientWidth;
  }

  timeAt(x) {
    return this.begin() + (x / this.canvas.clientWidth) * this.span;
  }

  zoom(wheel) {
    wheel.preventDefault();
    const { left } = this.canvas.getBoundingClientRect();
    const fixed = this.timeAt(wheel.clientX - left);
    const part = (wheel.clientX - left) / this.canvas.clientWidth;
    this.span = Math.min(SPAN_MAX, Math.max(SPAN_MIN, this.span * Math.exp(wheel.deltaY / 500)));
    this.shift = (fixed - part * this.span - (this.t ?? 0)) / this.span;
    this.draw(this.t);
  }

  grab(down) {
    this.held = { x: down.clientX, shift: this.shift };
    this.hasMoved = false;
    this.canvas.setPointerCapture(down.pointerId);
    addEventListener("pointerup", () => (this.held = null), { once: true });
  }

  move(move) {
    if (this.held) {
      const way = move.clientX - this.held.x;
      if (Math.abs(way) > 3) this.hasMoved = true;
      this.shift = this.held.shift - way / this.canvas.clientWidth;
      return this.draw(this.t);
    }
    const one = this.at(move);
    const { left, top } = this.canvas.getBoundingClientRect();
    const t = this.timeAt(move.clientX - left);
    this.onHover(one, t);
    this.tip.hidden = !one;
    if (!one) return;
    this.tip.replaceChildren(...describe(one.event, t, this.world.apart(one.event, t)));
    const x = move.clientX - left, y = move.clientY - top;
    this.tip.style.left = `${Math.min(x + 14, this.canvas.clientWidth - 240)}px`;
    this.tip.style.bottom = `${Math.max(4, this.canvas.clientHeight - y + 12)}px`;
  }

  leave() {
    this.tip.hidden = true;
    this.onHover(null, null);
  }

  at({ clientX, clientY }) {
    const { left, top } = this.canvas.getBoundingClientRect();
    const x = clientX - left, y = clientY - top;
    const hit = (bar) => y >= bar.y && y < bar.y + ROW && x >= bar.from - 5 && x <= bar.to + 5;
    return this.bars.findLast(hit)?.one ?? null;
  }

  /** Those that are within what is shown, each in a row that is free there. */
  layOut(from, to) {
    const shown = [...this.world.standing].filter(({ event }) => {
      if (event.status === "possible" && event.expected?.outcome === "pass") return false;
      const begin = beginOf(event, this.t);
      const end = event.end?.latest_s ?? (isOpen(event) ? Infinity : event.begin.latest_s ?? begin);
      return begin <= to && end >= from;
    });
    shown.sort((a, b) => beginOf(a.event, this.t) - beginOf(b.event, this.t));
    const ends = [];
    this.bars = [];
    for (const one of shown) {
      const x = this.xOf(beginOf(one.event, this.t));
      const last = one.event.end?.latest_s ?? one.event.begin.latest_s ?? to;
      const end = Math.max(this.xOf(last), x + 6);
      let row = ends.findIndex((busy) => busy < x - 4);
      if (row < 0) row = ends.length;
      if (row >= ROWS_MAX) continue;
      ends[row] = end + 90;  // its name stands behind it
      this.bars.push({ one, y: TOP + row * ROW, from: x, to: end });
    }
  }

  draw(t) {
    this.t = t;
    const { clientWidth: w, clientHeight: h } = this.canvas;
    if (w === 0 || h === 0 || t == null) return;
    const ratio = devicePixelRatio;
    const [width, height] = [Math.round(w * ratio), Math.round(h * ratio)];
    if (this.canvas.width !== width) this.canvas.width = width;
    if (this.canvas.height !== height) this.canvas.height = height;
    const pen = this.canvas.getContext("2d");
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, w, h);
    pen.font = "11px system-ui, sans-serif";
    this.drawScale(pen, w, h);
    this.layOut(this.begin(), this.begin() + this.span);
    for (const bar of this.bars) this.drawBar(pen, bar, t);
    pen.fillStyle = colorOf("ink");
    pen.fillRect(this.xOf(t), 0, 1.5, h);
  }

  drawScale(pen, w, h) {
    const step = niceStep(this.span / Math.max(2, w / 90));
    pen.strokeStyle = colorOf("line");
    pen.fillStyle = colorOf("faint");
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    for (let tick = Math.ceil(this.begin() / step) * step; tick < this.begin() + this.span;
         tick += step) {
      const x = this.xOf(tick);
      pen.beginPath();
      pen.moveTo(x, 0);
      pen.lineTo(x, h);
      pen.stroke();
      const ahead = tick - this.t;
      pen.fillText(`${ahead >= 0 ? "+" : "−"}${Math.abs(ahead).toFixed(digits)} s`, x + 3, 11);
    }
  }

  drawBar(pen, { one, y, from, to }, t) {
    const { event } = one, level = LEVELS[levelAt(event, t)];
    const isContact = event.status !== "possible" && event.status !== "dismissed" &&
        event.status !== "withdrawn";
    const color = colorOf(level !== "calm" ? level : isContact ? "contact" : "over");
    pen.globalAlpha = levelAt(event, t) === 0 ? 0.55 : 1;
    pen.strokeStyle = pen.fillStyle = color;
    // All that may be: hollow. What is certain: filled.
    pen.strokeRect(from + 0.5, y + 2.5, Math.max(2, to - from - 1), ROW - 6);
    const certainFrom = event.begin.latest_s, certainTo = event.end?.earliest_s ?? (isOpen(event)
      ? t : null);
    if (isContact && certainFrom != null && certainTo != null && certainTo >= certainFrom) {
      pen.fillRect(this.xOf(certainFrom), y + 2, Math.max(2, this.xOf(certainTo) -
        this.xOf(certainFrom)), ROW - 5);
    }
    const expected = event.expected?.outcome === "touch" ? event.expected.begin : null;
    if (event.status === "possible" && expected?.earliest_s != null) {
      pen.fillRect(this.xOf(expected.earliest_s) - 1, y, 3, ROW - 1);
    }
    if (one === this.chosen) {
      pen.strokeStyle = colorOf("ink");
      pen.strokeRect(from - 2.5, y + 0.5, to - from + 5, ROW - 2);
    }
    pen.fillStyle = colorOf("ink");
    pen.fillText(`${event.lower.name ?? "?"} – ${event.higher.name ?? "?"}`,
                 Math.min(to, this.canvas.clientWidth - 80) + 5, y + ROW - 5);
    pen.globalAlpha = 1;
  }
}

/**
 * What is possible has not begun: a forecast is told anew only where what is left of it changes,
 * and then its begin may have passed.
 */
export const beginOf = (event, t) => {
  const begin = event.begin.earliest_s ?? event.now_s;
  return event.status === "possible" ? Math.max(begin, t) : begin;
};

const isOpen = (event) => event.status === "possible" || event.status === "confirmed";

function niceStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((n) => n * power).find((step) => step >= least) ?? 10 * power;
}

/** What the pair is at `t`, for the tip; `apart`: World.apart(). */
function describe(event, t, apart) {
  const lines = [
    element("strong", {}, `${fullName(event.lower)} – ${fullName(event.higher)}`),
    element("div", {}, `${event.status}: begins ${bracket(event.begin)}`),
  ];
  if (event.end?.earliest_s != null) lines.push(element("div", {}, `ends ${bracket(event.end)}`));
  const wide = widthOf(event.begin);
  if (wide != null) lines.push(element("div", {}, `known to within ${wide.toPrecision(3)} s`));
  const near = event.proximity;
  if (near?.separation_m) {
    const { lower, upper } = near.separation_m;
    lines.push(element("div", {}, `gap ${show(lower)} … ${show(upper)} m at ` +
      `${near.at_s.toFixed(3)} s`));
    if (near.normal) {
      lines.push(element("div", {}, `normal (${near.normal.direction.map(show).join(", ")})`));
    }
    lines.push(element("div", {}, `point (${near.point_m.map(show).join(", ")}) m`));
  }
  lines.push(element("div", {}, `here, at ${t.toFixed(3)} s: ` + (apart === null ? "not known"
    : `centres ${show(apart.centres)} m apart, their balls ` +
      (apart.balls < 0 ? "overlap" : `${show(apart.balls)} m`))));
  return lines;
}

const show = (x) => (x == null ? "?" : Number(x.toPrecision(4)).toString());
