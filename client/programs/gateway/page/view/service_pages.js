// The service itself, and why a world is silent.
import { element, list, quantity, seconds, table } from "./format.js";

const BARS = 24;

export function servicePage(world) {
  const status = world.status;
  if (!status) return [element("p", { class: "empty" }, "No service has been heard.")];
  const counters = Object.entries(status.counters).filter(([, value]) => value > 0);
  return [
    element("h2", {}, "Verdict"),
    ...status.verdict.map((line) => element("p", {}, line)),
    list([
      ["World", `${status.world} (${status.clock})`],
      ["Service", status.process],
      ["Version", `${status.version}, ${status.build}`],
      ["Up for", seconds(status.uptime_s, 0)],
      ["Processor time", seconds(status.cpu_s, 1)],
      ["Memory", quantity(status.memory_bytes, "B")],
      ["Agents", status.agents],
      ["Pairs tracked", status.pairs_tracked],
      ["Broad phase", `${status.broad_phase}: ${status.broad_phase_why}`],
      ["Stand-bys", status.standbys.length],
    ]),
    element("h2", {}, "Left out, since this scene does not need it"),
    status.left_out.length === 0 ? element("p", { class: "empty" }, "nothing")
      : element("ul", {}, ...status.left_out.map((line) => element("li", {}, line))),
    ...Object.entries(status.histograms).flatMap(([name, classes]) =>
      [element("h2", {}, name), histogram(classes)]),
    element("h2", {}, "Quotas used"),
    table(["Simulator", "Of what", "Used", "At most"], status.simulators.flatMap((simulator) =>
      Object.entries(simulator.quotas).map(([resource, { used, most }]) => element("tr", {},
        element("td", {}, simulator.name), element("td", {}, resource),
        element("td", { class: "number" }, used), element("td", { class: "number" }, most))))),
    element("h2", {}, "Counters"),
    table(["Name", "Value"], counters.map(([name, value]) => element("tr", {},
      element("td", {}, name), element("td", { class: "number" }, value)))),
  ];
}

/** Bars of counts; a class is named by its upper end. */
function histogram(classes) {
  const last = classes.findLastIndex(({ count }) => count > 0);
  const first = Math.max(0, classes.findIndex(({ count }) => count > 0));
  if (last < 0) return element("p", { class: "empty" }, "nothing yet");
  const shown = classes.slice(first, Math.min(last + 1, first + BARS));
  const most = Math.max(...shown.map(({ count }) => count));
  return table(["Up to", "", "Times"], shown.map(({ up_to: end, count }) => element("tr", {},
    element("td", { class: "number" }, end ?? "more"),
    element("td", {}, element("meter", { min: 0, max: most, value: count,
      "aria-label": `${count} times` })),
    element("td", { class: "number" }, count))));
}

/** What is wrong, from the gateway to the simulators, and what to type. */
export function silencePage(world) {
  const causes = [];
  const add = (what, todo) => causes.push(element("li", {}, what, element("br"),
    element("strong", {}, "→ "), element("code", {}, todo)));
  if (!world.connection) {
    add("The gateway is not heard by this page.", "see whether collision-gateway runs");
  } else if (world.connection.unreadable) {
    add(world.connection.unreadable, "install programs of one version on all hosts");
  } else if (!world.connection.service_alive) {
    add("The gateway hears no service of its world.", "collisionctl doctor, on its host");
  } else {
    for (const line of world.status?.verdict ?? []) {
      if (!line.startsWith("WELL") && !line.startsWith(" ")) add(line, "collisionctl doctor");
    }
    if (world.agents.size === 0) {
      add("No agent has been described.", "start a simulator of this world and domain");
    }
    for (const one of world.status?.simulators ?? []) {
      if (!one.alive) {
        add(`${one.name} is silent.`, `see to it, or: collisionctl evict ${one.name}`);
      } else if (one.refused_now > 0) {
        add(`${one.name}: ${one.refused_now} things are refused: ${one.refused_why}`,
            "collisionctl status --all");
      }
    }
  }
  if (world.connection?.contacts_missed > 0) {
    add(`${world.connection.contacts_missed} contacts were lost on the way here.`,
        "see to the network between service and gateway");
  }
  if (causes.length > 0) return [element("ol", {}, ...causes)];
  const possible = [...world.standing].filter(({ event }) => event.status === "possible");
  return [element("p", {}, "Nothing is in the way: the service is heard, time goes on, and every ",
                  "agent has a state."),
          element("p", {}, possible.length === 0
            ? "No pair can meet within announce_within_s, so there is nothing to tell."
            : `${possible.length} pairs may meet: see Pairs.`)];
}
