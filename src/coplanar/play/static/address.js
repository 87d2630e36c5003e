// The state in the address: #tab, or #tab=state as base64url of JSON.

/** @typedef {import("./types.js").State} State */

const LONGEST = 40000; // characters: more is no link of ours

/**
 * @param {string} tab
 * @param {State | undefined} state
 */
export function hashOf(tab, state) {
  if (!state) return `#${tab}`;
  const bytes = new TextEncoder().encode(JSON.stringify(state));
  const text = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  return `#${tab}=${btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")}`;
}

/**
 * The tab and state of an address; an error says why it cannot be read.
 * @param {string} hash
 * @param {string[]} tabs
 * @returns {{tab: string, state?: State, error?: string}}
 */
export function readHash(hash, tabs) {
  if (hash.length < 2) return { tab: tabs[0] };
  const [tab, code] = hash.slice(1).split("=", 2);
  if (!tabs.includes(tab)) return { tab: tabs[0], error: "This link names no tab of the playground." };
  if (code === undefined) return { tab };
  const state = decoded(code);
  return state ? { tab, state } : { tab, error: "This link is damaged: its state cannot be read." };
}

/**
 * @param {string} code
 * @returns {State | undefined}
 */
function decoded(code) {
  if (code.length > LONGEST) return undefined;
  try {
    const text = atob(code.replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(text, (character) => character.charCodeAt(0));
    const state = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytes));
    return state !== null && typeof state === "object" && !Array.isArray(state) ? state : undefined;
  } catch {
    return undefined;
  }
}
