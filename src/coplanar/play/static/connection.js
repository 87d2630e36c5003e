// One WebSocket that comes back, with one request in flight; with two where the second replaces the first.
//
// The server answers in the order in which it is asked. Of a request that waits while another one comes it answers the
// newer one alone, so an answer settles its own request and those before it.

/** @typedef {import("./types.js").Reply} Reply */

const FULL = 1013;
const IDLE = 4000;
const SLOWEST = 4000; // [ms] between attempts

/** @typedef {{id: number, request: Record<string, any>, resolve: (reply: Reply | undefined) => void,
 *   reject: (reason: Error) => void}} Asked */

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
    /** @type {Asked[]} */
    this.inFlight = [];
    /** @type {Asked[]} */
    this.queue = [];
    this.connect();
  }

  /** Whether a request would be sent at once. */
  get free() {
    return this.#room(1);
  }

  /** Whether a request that replaces the one in flight would be sent at once. */
  get freeToReplace() {
    return this.#room(2);
  }

  /** @param {number} most */
  #room(most) {
    return this.socket?.readyState === WebSocket.OPEN && this.inFlight.length < most && this.queue.length === 0;
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
    for (const lost of this.inFlight.splice(0).reverse()) lost.reject(new Error("The connection was lost."));
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
  async ask(request) {
    const reply = await new Promise((resolve, reject) => {
      this.queue.push({ id: 0, request, resolve, reject });
      this.wake();
      this.send();
    });
    return /** @type {Reply} */ (reply);
  }

  /**
   * Send at once a request that replaces the one in flight.
   * @param {Record<string, any>} request
   * @returns {Promise<Reply | undefined>} undefined where it was replaced in its turn.
   */
  replace(request) {
    return new Promise((resolve, reject) => this.#post({ id: 0, request, resolve, reject }));
  }

  send() {
    if (this.inFlight.length > 0 || this.socket?.readyState !== WebSocket.OPEN) return;
    const next = this.queue.shift();
    if (next) this.#post(next);
  }

  /** @param {Asked} asked */
  #post(asked) {
    this.count += 1;
    asked.id = this.count;
    this.inFlight.push(asked);
    this.socket?.send(JSON.stringify({ id: asked.id, ...asked.request }));
  }

  /** @param {string} text */
  receive(text) {
    const reply = /** @type {Reply} */ (JSON.parse(text));
    const place = reply.id === null ? 0 : this.inFlight.findIndex(({ id }) => id === reply.id);
    if (place < 0 || place >= this.inFlight.length) return;
    const settled = this.inFlight.splice(0, place + 1);
    settled.pop()?.resolve(reply);
    for (const replaced of settled) replaced.resolve(undefined);
    this.send();
  }
}
