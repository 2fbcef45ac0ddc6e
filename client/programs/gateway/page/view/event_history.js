// How the bracket of an event became narrower, as states arrived.
import uPlot from "uplot";
import { colorOf, element, width } from "./format.js";

const WIDTH_LEAST = 1e-10;  // On a logarithmic scale nothing is 0.

/** Width of the bracket of its begin over the time at which it was known. */
export function drawHistory(one) {
  const known = one.revisions.filter(({ begin }) => width(begin) != null);
  const place = element("div", { class: "plot" });
  if (known.length < 2) {
    place.append(element("p", { class: "empty" }, known.length === 0
      ? "Its begin is open." : `Told once, to within ${width(known[0].begin).toPrecision(3)} s.`));
    return place;
  }
  const times = known.map(({ now_s: now }) => now);
  const widths = known.map(({ begin }) => Math.max(WIDTH_LEAST, width(begin)));
  const axis = { stroke: colorOf("faint"), grid: { stroke: colorOf("line") } };
  new uPlot({
    width: 340,
    height: 170,
    scales: { x: { time: false }, y: { distr: 3 } },
    axes: [{ ...axis, label: "told at [s]" }, { ...axis, label: "width [s]", size: 70,
      values: (_, ticks) => ticks.map((tick) => tick?.toExponential(0) ?? "") }],
    series: [{ label: "told at [s]" }, {
      label: "width [s]", stroke: colorOf("contact"), width: 2, paths: uPlot.paths.stepped({
        align: 1 }), points: { show: true } }],
    legend: { show: false },
  }, [times, widths], place);
  return place;
}
