// The world as it is now, from the gateway.
import { readItems, splitItems } from "./items.js";

const PROTOCOL = "collision.page.v1";
const SILENCE_MS = 3000;  // A gateway that says nothing for so long is told of.
const AGAIN_MS = 1000;

/** Keeps a WebSocket open, and hands what comes to the model. */
export class LiveSource {
  /** `onLink(text)`: why nothing comes; "": it does. */
  constructor(model, onLink) {
    this.model = model;
    this.onLink = onLink;
    this.heard = performance.now();
    this.messages = 0;
    this.connect();
    setInterval(() => this.lookAtSilence(), 500);
  }

  connect() {
    if (this.isClosed) return;
    const address = new URL("ws", location.href);
    address.protocol = address.protocol.replace("http", "ws");
    address.hash = "";
    this.socket = new WebSocket(address, PROTOCOL);
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = () => {
      this.model.reset();
      this.hasPast = false;
      this.heard = performance.now();
    };
    this.socket.onmessage = (message) => this.take(message.data);
    this.socket.onclose = () => {
      if (this.isClosed) return;
      this.onLink("the gateway is not heard; trying again");
      setTimeout(() => this.connect(), AGAIN_MS);
    };
  }

  take(bytes) {
    this.heard = performance.now();
    ++this.messages;
    this.onLink("");
    try {
      readItems(bytes, this.model);
      this.model.arrived();
      if (!this.hasPast && this.model.agents.size > 0) this.fetchPast();
    } finally {
      // When it is shown: a page that is not drawn is sent no more.
      const socket = this.socket;
      requestAnimationFrame(() => {
        if (socket.readyState === WebSocket.OPEN) socket.send("ack");
      });
    }
  }

  /** The last ten minutes before this page was opened. */
  async fetchPast() {
    this.hasPast = true;
    const socket = this.socket;
    const answer = await fetch("past").catch(() => null);
    if (!answer?.ok) return;
    const past = new Map();
    const takeState = (number, state) => {
      if (!state) return past.delete(number);  // What was before is of another agent.
      if (!past.has(number)) past.set(number, []);
      past.get(number).push(state);
    };
    for (const item of splitItems(await answer.arrayBuffer())) {
      readItems(item, { takeState });
      await new Promise((done) => setTimeout(done));  // The page goes on meanwhile.
    }
    if (socket === this.socket && !this.isClosed) this.model.takePast(past);
  }

  /** A recording takes its place. */
  close() {
    this.isClosed = true;
    this.socket.close();
  }

  /** The recording could not be shown. */
  goOn() {
    if (!this.isClosed) return;
    this.isClosed = false;
    this.connect();
  }

  lookAtSilence() {
    if (this.socket.readyState !== WebSocket.OPEN) return;
    // A world that stands still says nothing new, but its service has a status twice a second.
    if (performance.now() - this.heard > SILENCE_MS) {
      this.onLink("nothing has come from the gateway for " +
                  Math.round((performance.now() - this.heard) / 1000) + " s");
    }
  }
}
