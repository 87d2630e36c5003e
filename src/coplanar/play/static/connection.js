// One WebSocket that comes back, with one request in flight.

/** @typedef {import("./types.js").Reply} Reply */

const FULL = 1013;
const IDLE = 4000;
const SLOWEST = 4000; // [ms] between attempts

/** @typedef {{request: Record<string, any>, resolve: (reply: Reply) => void, reject: (reason: Error) => void}} Asked */

export class Connection {
  /**
   * @param {string} address
   * @param {(state: "open" | "lost" | "full" | "idle", reason: string) => void} changed
   */
  constructor(address, changed) {
    this.address = address;
    this.changed = changed;
    this.attempts = 0;
    this.count = 0;
    /** @type {WebSocket | undefined} */
    this.socket = undefined;
    /** @type {Asked | undefined} */
    this.inFlight = undefined;
    /** @type {Asked[]} */
    this.queue = [];
    this.connect();
  }

  /** Whether a request would be sent at once. */
  get free() {
    return this.socket?.readyState === WebSocket.OPEN && !this.inFlight && this.queue.length === 0;
  }

  connect() {
    const socket = new WebSocket(this.address);
    this.socket = socket;
    socket.addEventListener("open", () => {
      this.attempts = 0;
      this.changed("open", "");
      this.send();
    });
    socket.addEventListener("message", (event) => this.receive(event.data));
    socket.addEventListener("close", (event) => this.closed(event));
  }

  /** @param {CloseEvent} event */
  closed(event) {
    this.socket = undefined;
    const lost = this.inFlight;
    this.inFlight = undefined;
    lost?.reject(new Error("The connection was lost."));
    if (event.code === IDLE) {
      this.changed("idle", event.reason);
      return;
    }
    this.changed(event.code === FULL ? "full" : "lost", event.reason);
    const pause = event.code === FULL ? SLOWEST : Math.min(SLOWEST, 250 * 2 ** this.attempts);
    this.attempts += 1;
    setTimeout(() => this.wake(), pause);
  }

  /** Connect again after a pause, if that has not happened yet. */
  wake() {
    if (!this.socket) this.connect();
  }

  /**
   * Send a request when those before it are answered.
   * @param {Record<string, any>} request
   * @returns {Promise<Reply>}
   */
  ask(request) {
    return new Promise((resolve, reject) => {
      this.queue.push({ request, resolve, reject });
      this.wake();
      this.send();
    });
  }

  send() {
    if (this.inFlight || this.socket?.readyState !== WebSocket.OPEN) return;
    this.inFlight = this.queue.shift();
    if (!this.inFlight) return;
    this.count += 1;
    this.socket.send(JSON.stringify({ id: this.count, ...this.inFlight.request }));
  }

  /** @param {string} text */
  receive(text) {
    const reply = /** @type {Reply} */ (JSON.parse(text));
    const asked = this.inFlight;
    if (!asked || (reply.id !== null && reply.id !== this.count)) return;
    this.inFlight = undefined;
    asked.resolve(reply);
    this.send();
  }
}
