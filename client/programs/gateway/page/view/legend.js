// What the colours and marks mean.
import { element, mark } from "./format.js";

const MEANING = [
  ["calm", "nothing is near in time"],
  ["possible", "a contact is possible"],
  ["soon", "it may begin within 2 s"],
  ["contact", "they touch for certain"],
];

export function drawLegend(list) {
  list.replaceChildren(...MEANING.map(([level, meaning]) =>
    element("li", {}, mark(level), meaning)),
    element("li", {}, "rings: all of the agent is inside, now and ahead"));
}
