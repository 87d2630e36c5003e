// A dialog that shows a text and puts it on the clipboard, or lets it be copied by hand where that is not allowed.

import { byId, write } from "./elements.js";

export class Copier {
  constructor() {
    this.dialog = byId("copied", HTMLDialogElement);
    this.title = byId("copied-title", HTMLElement);
    this.status = byId("copied-status", HTMLElement);
    this.text = byId("copied-text", HTMLTextAreaElement);
    byId("copied-again", HTMLButtonElement).addEventListener("click", () => this.#copy());
  }

  /**
   * @param {string} title
   * @param {string} text
   */
  offer(title, text) {
    write(this.title, title);
    write(this.status, "");
    this.text.value = text;
    this.text.rows = Math.min(24, text.split("\n").length + 1);
    this.dialog.showModal();
    return this.#copy();
  }

  async #copy() {
    try {
      await navigator.clipboard.writeText(this.text.value);
      write(this.status, "Copied to the clipboard.");
    } catch {
      this.text.focus();
      this.text.select();
      write(this.status, "This browser keeps the clipboard to itself: the text is selected, copy it with Ctrl+C.");
    }
  }
}
