// The playground's page: what is asked, what is shown, and the address in step with both.

import { hashOf, readHash } from "./address.js";
import { Charts } from "./charts.js";
import { Connection } from "./connection.js";
import { matters, Panel } from "./controls.js";
import { Copier } from "./copying.js";
import { Desk } from "./desk.js";
import { byId, write } from "./elements.js";
import { Pace } from "./pace.js";
import { Clock } from "./player.js";
import { Readings } from "./readings.js";
import { toggleTheme } from "./shade.js";
import { Stage } from "./stage.js";
import { Tabs } from "./tabs.js";
import { Transport } from "./transport.js";

/**
 * @typedef {import("./types.js").Tab} Tab
 * @typedef {import("./types.js").Shown} Shown
 * @typedef {import("./types.js").State} State
 */

const BESIDE = 30; // [ms] from one writing of the numbers and curves to the next, while a hand moves the picture
const GONE = 6000; // [ms] until a notice that needs nothing done goes away

class App {
  constructor() {
    /** @type {Tab[]} */
    this.tabs = [];
    /** @type {Map<string, string>} First states, as text. */
    this.defaults = new Map();
    this.linked = false; // the state under way comes from a link
    this.built = "";
    this.notice = byId("notice", HTMLElement);
    /** @type {ReturnType<typeof setTimeout> | undefined} */
    this.timer = undefined;
    const panel = byId("panel", HTMLElement);
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    this.clock = new Clock(() => this.tick());
    this.transport = new Transport(this.clock);
    this.charts = new Charts(byId("series", HTMLElement), this.clock);
    this.beside = new Pace(BESIDE);
    this.copier = new Copier();
    this.bar = new Tabs(byId("tabs", HTMLElement), panel, (name) => this.choose(name));
    this.panel = new Panel(byId("controls", HTMLElement), (key, value, live) => this.edit(key, value, live));
    this.readings = new Readings(
      byId("sentences", HTMLElement),
      byId("readouts", HTMLElement),
      byId("spoken", HTMLElement),
    );
    this.stage = new Stage(
      byId("stage", HTMLElement),
      byId("extras", HTMLElement),
      {
        drag: (handle, to) => this.desk.drag({ handle, to }),
        nudge: (handle, by) => this.desk.nudge({ handle, by }),
        leave: () => this.desk.leave(),
      },
      () => this.clock.time,
    );
    this.connection = new Connection(`${scheme}//${location.host}/session`, (state, reason) =>
      this.link(state, reason),
    );
    this.desk = new Desk(this.connection, {
      shown: (shown) => this.show(shown),
      refused: (sentence, state) => this.refused(sentence, state),
      rested: () => this.rest(),
    });
    this.listen();
  }

  listen() {
    addEventListener("popstate", () => this.restore());
    byId("copy-python", HTMLElement).addEventListener("click", () => this.copy("python", "Python"));
    byId("copy-yaml", HTMLElement).addEventListener("click", () => this.copy("yaml", "Scenario file"));
    byId("share", HTMLElement).addEventListener("click", () => this.share());
    byId("theme", HTMLElement).addEventListener("click", () => this.theme());
    byId("skip", HTMLElement).addEventListener("click", (event) => {
      event.preventDefault();
      byId("panel", HTMLElement).focus();
    });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.recolour());
    document.addEventListener("visibilitychange", () => document.hidden || this.connection.wake());
  }

  /**
   * The connection has changed.
   * @param {"open" | "lost" | "full" | "idle"} state
   * @param {string} reason
   */
  async link(state, reason) {
    document.documentElement.dataset.connection = state;
    if (state === "open") {
      this.tell("");
      if (this.tabs.length === 0) await this.begin();
      else this.desk.pump();
      return;
    }
    const words = {
      lost: "The connection to the server is lost; trying again. What you set is kept.",
      full: `The server takes no more pages: ${reason}.`,
      idle: "The connection rested; it comes back with your next change.",
    };
    this.tell(words[state], true);
  }

  async begin() {
    const reply = await this.connection.ask({ do: "describe" });
    this.tabs = reply.tabs ?? [];
    this.bar.build(this.tabs);
    this.restore();
  }

  /** Go where the address points. */
  restore() {
    const found = readHash(
      location.hash,
      this.tabs.map((tab) => tab.name),
    );
    if (found.error) this.tell(`${found.error} These are the defaults.`);
    this.linked = found.state !== undefined;
    this.open(found.tab, found.state ?? JSON.parse(this.defaults.get(found.tab) ?? "{}"));
  }

  /** @param {string} name */
  choose(name) {
    if (name === this.desk.tab) return;
    this.tell("");
    this.open(name, this.desk.states.get(name));
    this.remember();
  }

  /**
   * @param {string} name
   * @param {State | undefined} state
   */
  open(name, state) {
    if (name !== this.desk.tab) this.clock.pause();
    this.bar.select(name);
    this.desk.open(name, state);
  }

  /** @param {Shown} shown */
  show(shown) {
    const tab = this.tabs.find(({ name }) => name === shown.tab);
    if (!tab) return;
    const fresh = this.built !== tab.name;
    if (!this.defaults.has(tab.name) && !this.linked) this.defaults.set(tab.name, JSON.stringify(shown.state));
    this.linked = false;
    if (fresh) this.build(tab);
    const held = !fresh && this.stage.held();
    this.panel.update(shown.state, held);
    this.clock.span(longest(shown));
    if (fresh) this.clock.time = this.clock.end;
    this.stage.show(shown, `${tab.title}: ${shown.sentences.map((sentence) => sentence.text).join("; ")}`);
    const beside = () => {
      this.readings.say(shown.sentences);
      this.readings.read(shown.readouts);
      this.charts.show(shown.series);
    };
    if (held) this.beside.soon(beside);
    else this.beside.now(beside);
    this.transport.show();
    this.ink(tab, shown.state);
    document.documentElement.dataset.tab = tab.name;
  }

  /** @param {Tab} tab */
  build(tab) {
    this.built = tab.name;
    this.stage.clear();
    document.title = `${tab.title} \u00b7 Coplanar playground`;
    write(byId("about", HTMLElement), tab.about);
    this.panel.build(tab.controls, () => this.open(tab.name, {}));
  }

  /**
   * Where a line is to be drawn by hand, the picture waits for it.
   * @param {Tab} tab
   * @param {State} state
   */
  ink(tab, state) {
    const control = tab.controls.find(({ kind }) => kind === "stroke");
    if (!control) return;
    const { key, most = 400, reach = 20, picture = "main" } = control;
    const wanted = matters(control, state) && (state[key].length === 0 || this.inking);
    const done = (/** @type {number[][]} */ points, /** @type {boolean} */ byKeys) => {
      this.inking = false;
      if (byKeys) byId(`control-${key}`, HTMLElement).focus({ preventScroll: true });
      this.desk.edit(key, points, false);
    };
    this.stage.draw(picture, wanted ? { most, reach, eager: this.eager, done } : undefined);
    this.eager = false;
  }

  inking = false; // a new line is waited for
  eager = false; // and its pen has not been given the focus yet

  /**
   * @param {string} key
   * @param {any} value
   * @param {boolean} live
   */
  edit(key, value, live) {
    this.inking = this.eager = value === "draw";
    if (this.inking) this.desk.edit(key, [], false);
    else this.desk.edit(key, value, live);
  }

  /**
   * @param {string} sentence
   * @param {State | undefined} state
   */
  refused(sentence, state) {
    const known = this.built === this.desk.tab;
    if (this.linked || !known) {
      this.linked = false;
      this.tell(`This link cannot be shown: ${sentence}. These are the defaults.`);
      if (state && Object.keys(state).length > 0) this.open(this.desk.tab, {});
      return;
    }
    this.tell(`${sentence}.`);
    this.panel.update(this.desk.state, false);
  }

  /** Time passes, or the playing starts or stops. */
  tick() {
    this.transport.show();
    this.stage.redraw();
    this.charts.follow();
  }

  rest() {
    this.stage.rest();
    if (!this.stage.held()) this.remember();
  }

  /** Put the state into the address, as a place to come back to. */
  remember() {
    const { tab, state } = this.desk;
    const text = JSON.stringify(state);
    const plain = text === "{}" || text === this.defaults.get(tab);
    const hash = hashOf(tab, plain ? undefined : state);
    if (hash !== location.hash && (location.hash || !plain)) history.pushState(null, "", hash);
  }

  /**
   * @param {"python" | "yaml"} form
   * @param {string} title
   */
  async copy(form, title) {
    const { tab, state } = this.desk;
    try {
      const reply = await this.connection.ask({ do: "copy", as: form, tab, state });
      if (reply.ok) await this.copier.offer(title, reply.text ?? "");
      else this.tell(`${reply.error?.sentence}.`);
    } catch (error) {
      this.tell(String(error));
    }
  }

  share() {
    const { tab, state } = this.desk;
    return this.copier.offer("Link to this state", `${location.origin}${location.pathname}${hashOf(tab, state)}`);
  }

  theme() {
    toggleTheme();
    this.recolour();
  }

  recolour() {
    this.stage.redraw();
    this.charts.recolour();
  }

  /**
   * A line for the user; empty to take it away.
   * @param {string} text
   * @param {boolean} [stays] Until something else is told.
   */
  tell(text, stays = false) {
    clearTimeout(this.timer);
    write(this.notice, text);
    this.notice.hidden = text === "";
    if (text && !stays) this.timer = setTimeout(() => this.tell(""), GONE);
  }
}

/** @param {Shown} shown The times of its picture that moves most. */
function longest(shown) {
  const all = Object.values(shown.pictures).map(({ times }) => times);
  return all.reduce((most, times) => (times.length > most.length ? times : most));
}

const app = new App();
Object.assign(globalThis, { playground: app }); // for a look from the console
