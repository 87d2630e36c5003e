// What goes over the wire, as coplanar.play.protocol says it.

/**
 * @typedef {import("./view.js").SceneData} SceneData
 * @typedef {Record<string, any>} State
 */

/**
 * @typedef {object} Control
 * @property {string} key
 * @property {string} label
 * @property {"slider" | "choice" | "switch" | "stroke" | "list"} kind
 * @property {string} group
 * @property {string} help
 * @property {any} default
 * @property {Record<string, any[]>} [only] Values of other controls for which it matters.
 * @property {string} [unit]
 * @property {number} [min]
 * @property {number} [max]
 * @property {number} [step]
 * @property {"linear" | "log"} [scale]
 * @property {{value: string, label: string}[]} [options]
 * @property {number} [most]
 * @property {number} [reach]
 * @property {string} [picture]
 * @property {Control[]} [fields]
 * @property {string} [row]
 * @property {number} [first]
 */

/** @typedef {{name: string, title: string, about: string, controls: Control[]}} Tab */

/**
 * @typedef {object} Handle
 * @property {string} id
 * @property {string} label
 * @property {number[]} at
 * @property {string} picture
 * @property {{step: number, unit: string}} keys
 * @property {string} value
 */

/** @typedef {{key: string, label: string, value: string, unit: string, group: string, number?: number}} Readout */
/** @typedef {{tone: "good" | "note" | "warn" | "no", text: string}} Sentence */

/**
 * @typedef {object} Series
 * @property {string} title
 * @property {string} unit
 * @property {{label: string, values: (number | null)[]}} x
 * @property {{label: string, values: (number | null)[], role: string}[]} lines
 * @property {boolean} [log]
 */

/** @typedef {{label: string, role: string, dashed?: boolean}} Line A line of a picture, as its legend names it. */

/**
 * @typedef {object} Shown The answer to "show".
 * @property {string} tab
 * @property {State} state
 * @property {boolean} complete
 * @property {Record<string, SceneData>} pictures
 * @property {Handle[]} handles
 * @property {Readout[]} readouts
 * @property {Sentence[]} sentences
 * @property {Series[]} series
 * @property {Record<string, Line[]>} legends
 */

/** @typedef {{sentence: string, key: string, given: any, needed: string}} Refusal */
/** @typedef {{id: number | null, ok: boolean, error?: Refusal, tabs?: Tab[], text?: string} & Partial<Shown>} Reply */

export {};
