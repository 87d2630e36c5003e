// What is being asked: the state of each tab, what was changed by hand, and one request at a time for the newest of it.
//
// A drag says where a handle is to be, whatever was before: the next place of the same handle does not wait for the
// answer to the last one. So an answer comes for every frame even where its way takes longer than a frame.

/**
 * @typedef {import("./types.js").State} State
 * @typedef {import("./types.js").Shown} Shown
 * @typedef {import("./types.js").Reply} Reply
 * @typedef {{handle: string, to: number[]}} Drag
 * @typedef {{handle: string, by: number[]}} Nudge
 * @typedef {{edits: State, live: boolean, changed?: string, drag?: Drag, nudge?: Nudge}} Wish
 */

const REST = 150; // [ms] without a change until the hand rests

export class Desk {
  /**
   * @param {import("./connection.js").Connection} connection
   * @param {object} watch
   * @param {(shown: Shown) => void} watch.shown An answer has come.
   * @param {(sentence: string, state: State | undefined) => void} watch.refused What was wished cannot be.
   * @param {() => void} watch.rested The hand rests on a state worth remembering.
   */
  constructor(connection, watch) {
    this.connection = connection;
    this.watch = watch;
    this.tab = "";
    /** @type {Map<string, State>} */
    this.states = new Map();
    /** @type {Wish | undefined} */
    this.wish = undefined;
    this.busy = 0; // requests that are not answered yet
    this.dragged = ""; // the handle of the one in flight, if it is a drag and nothing else
    this.partial = false; // the last answer left something out
    this.answers = 0;
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
  }

  /** The state of the open tab; empty until the first answer. */
  get state() {
    return this.states.get(this.tab) ?? {};
  }

  /**
   * Open a tab, in the state that is given, or as it was left.
   * @param {string} tab
   * @param {State} [state]
   */
  open(tab, state) {
    this.tab = tab;
    if (state) this.states.set(tab, state);
    this.wish = { edits: {}, live: false };
    this.pump();
  }

  /**
   * Set one key by hand.
   * @param {string} key
   * @param {any} value
   * @param {boolean} live Whether the hand is still moving.
   */
  edit(key, value, live) {
    this.#add({ edits: { [key]: value }, live, changed: key });
  }

  /**
   * Set several keys at once.
   * @param {State} edits
   */
  set(edits) {
    this.#add({ edits, live: false });
  }

  /** @param {Drag} drag */
  drag(drag) {
    this.#add({ edits: {}, live: true, drag });
  }

  /** @param {Nudge} nudge */
  nudge(nudge) {
    const before = this.wish?.nudge;
    const [right, up] = before?.handle === nudge.handle ? before.by : [0, 0];
    this.#add({ edits: {}, live: true, nudge: { ...nudge, by: [right + nudge.by[0], up + nudge.by[1]] } });
  }

  /** The hand lets go. */
  leave() {
    this.#restart(true);
  }

  /** @param {Wish} wish */
  #add(wish) {
    const edits = { ...this.wish?.edits, ...wish.edits };
    this.wish = { ...this.wish, ...wish, edits };
    if (wish.drag) this.wish.nudge = undefined;
    if (wish.nudge) this.wish.drag = undefined;
    this.#restart(wish.live);
    this.pump();
  }

  /** Send the newest wish, if nothing is under way. */
  async pump() {
    if (!this.wish || !this.tab) return;
    const { tab, wish } = this;
    const { edits, ...rest } = wish;
    const edited = Object.keys(edits).length > 0;
    const dragged = wish.drag && !edited ? `${tab} ${wish.drag.handle}` : "";
    const onward = this.busy === 1 && dragged !== "" && dragged === this.dragged;
    if (onward ? !this.connection.freeToReplace : this.busy > 0 || !this.connection.free) return;
    const state = this.states.has(tab) || edited ? { ...this.states.get(tab), ...edits } : {};
    const request = { do: "show", tab, state, ...rest };
    this.wish = undefined;
    this.busy += 1;
    this.dragged = dragged;
    try {
      const reply = await (onward ? this.connection.replace(request) : this.connection.ask(request));
      if (reply) this.#take(tab, reply, state);
    } catch {
      this.wish ??= { ...wish, live: false };
    }
    this.busy -= 1;
    this.pump();
  }

  /**
   * @param {string} tab
   * @param {Reply} reply
   * @param {State} sent
   */
  #take(tab, reply, sent) {
    this.answers += 1;
    if (!reply.ok) {
      if (tab === this.tab) this.watch.refused(reply.error?.sentence ?? "", sent);
      return;
    }
    const shown = /** @type {Shown} */ (reply);
    this.states.set(tab, shown.state);
    if (tab !== this.tab) return;
    this.partial = !shown.complete;
    this.watch.shown(shown);
    if (this.partial && !this.timer) this.#restart(true);
  }

  /**
   * Wait for the hand to rest; then ask for what was left out, and remember.
   * @param {boolean} live
   */
  #restart(live) {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.#rest(), live ? REST : 0);
  }

  #rest() {
    this.timer = undefined;
    if (this.partial && !this.wish && !this.busy) {
      this.wish = { edits: {}, live: false };
      this.partial = false;
      this.pump();
    }
    if (this.busy || this.wish) this.#restart(true);
    else this.watch.rested();
  }
}
