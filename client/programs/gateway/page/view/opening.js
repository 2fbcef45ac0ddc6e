// Opening recordings: by dropping a file anywhere, or by the button.
import { converted, load, messagesIn, messagesOf } from "../source/recorded.js";
import { seconds } from "./format.js";

const TOLD_MS = 10000;  // What is wrong with a file; then the state of the service counts again.

/**
 * `tell(text)`: how far it is, or what is wrong. `begin()`: what is live ends. `failed()`: it goes
 * on. `opened(event)`: all is there.
 */
export class Opening {
  constructor(world, button, input, callbacks) {
    Object.assign(this, { world, callbacks, isBusy: false, shown: "" });
    button.addEventListener("click", () => (world.player ? location.reload() : input.click()));
    input.addEventListener("change", () => input.files.length > 0 && this.open(input.files[0]));
    addEventListener("dragover", (drag) => drag.preventDefault());
    addEventListener("drop", (drop) => {
      drop.preventDefault();
      const file = drop.dataTransfer.files[0];
      if (file) this.open(file);
    });
  }

  async open(file) {
    if (this.isBusy) return this.callbacks.tell("another file is being read");
    this.isBusy = true;
    clearTimeout(this.timer);
    const { tell, failed } = this.callbacks;
    try {
      tell(`${file.name}: being read …`);
      const isMcap = (await file.slice(1, 5).text()) === "MCAP";
      if (!isMcap) tell(`${file.name}: the gateway lets collisiond replay it …`);
      const { blob, note } = isMcap ? { blob: file, note: "" } : await converted(file);
      await this.show(messagesOf(blob), file.name);
      if (note) tell(`${this.shown}: ${note}`);
    } catch (error) {
      failed();
      tell(`${file.name} cannot be shown: ${error.message}`);
      this.timer = setTimeout(() => tell(this.shown), TOLD_MS);
    }
    this.isBusy = false;
  }

  /** What this page holds, if it is one that collisionctl export has made. */
  async openOwn(holder) {
    try {
      const { name, event } = holder.dataset;
      await this.show(messagesIn(holder.textContent), name, event);
    } catch (error) {
      this.callbacks.tell(`cannot be shown: ${error.message}`);
    }
  }

  /** `event`: the key of the one that is shown first. */
  async show(messages, name, event) {
    const { tell, begin, opened } = this.callbacks;
    const anew = () => {
      this.shown = "";
      begin();
    };
    await load(this.world, messages, anew, (t) => t !== undefined && tell(`${name}: ${seconds(t)} …`));
    const { player } = this.world;
    this.shown = `${name}: ${seconds(player.end - player.begin)} of its world`;
    tell(this.shown);
    opened(event);
  }
}
