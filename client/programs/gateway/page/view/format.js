// Numbers and times as people read them.

export const seconds = (t, digits = 2) => (t == null ? "–" : `${t.toFixed(digits)} s`);

/**
 * A bracket of instants: "2.10 … 2.11 s", a narrow one as "2.1043 s ± 3.00 µs"; what is open has no
 * end.
 */
export function bracket(range) {
  if (!range || (range.earliest_s == null && range.latest_s == null)) return "–";
  const { earliest_s: from, latest_s: to } = range;
  if (from == null || to == null || to - from >= 0.01) {
    const one = (t) => (t == null ? "?" : t.toFixed(2));
    return `${one(from)} … ${one(to)} s`;
  }
  return `${((from + to) / 2).toFixed(4)} s ± ${quantity((to - from) / 2, "s")}`;
}

export function width(range) {
  if (range?.earliest_s == null || range?.latest_s == null) return null;
  return range.latest_s - range.earliest_s;
}

/** With three digits and a unit that fits: "1.20 ms". */
export function quantity(value, unit) {
  if (value == null || !Number.isFinite(value)) return "–";
  const steps = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"],
    [1e-12, "p"]];
  const size = Math.abs(value);
  const [factor, prefix] = steps.find(([least]) => size >= least) ?? [1, ""];
  return `${size === 0 ? "0" : (value / factor).toPrecision(3)} ${prefix}${unit}`;
}

/**
 * The world's time: with a clock that counts from 1970 the time of day; else seconds, and the time
 * of day where the world says what its instant 0 is.
 */
export function worldTime(t, epochUtc) {
  if (t == null) return "–";
  const utc = (s) => `${new Date(s * 1000).toISOString().slice(11, 22)} UTC`;
  if (t >= 1e9) return utc(t);
  const epoch = Date.parse(epochUtc ?? "") / 1000;
  return `${t.toFixed(2)} s` + (Number.isFinite(epoch) ? ` · ${utc(epoch + t)}` : "");
}

export const fullName = (reference) =>
  reference ? `${reference.name ?? "?"} (${reference.simulator ?? "?"})` : "–";

/** An element with attributes and children; text is never read as HTML. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== undefined && value !== false) made.setAttribute(name, value);
  }
  made.append(...children.filter((child) => child != null).map((child) =>
    child instanceof Node ? child : String(child)));
  return made;
}

const MARKS = { calm: "●", possible: "○", soon: "◆", contact: "✖", over: "▪" };

/** The level by shape and colour, and by a word for those who hear the page. */
export const mark = (level) =>
  element("span", { class: `mark ${level}`, role: "img", "aria-label": level }, MARKS[level]);

export const colorOf = (name) =>
  getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** Names and values; what has none is left out. */
export const list = (rows) => element("dl", {}, ...rows.filter(([, value]) =>
  value != null && value !== "" && value !== false).flatMap(([name, value]) =>
  [element("dt", {}, name), element("dd", {}, value)]));

export const table = (heads, rows) => element("table", {},
  element("thead", {}, element("tr", {}, ...heads.map((head) =>
    element("th", { scope: "col" }, head || element("span", { "aria-label": "Level" }))))),
  element("tbody", {}, ...rows));
