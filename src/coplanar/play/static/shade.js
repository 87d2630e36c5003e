// Light or dark, as the reader wants it; theme.js finds it again before the page is drawn.

/** The other one of light and dark, kept where the browser keeps anything. */
export function toggleTheme() {
  const root = document.documentElement;
  const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = dark ? "light" : "dark";
  try {
    localStorage.setItem("coplanar-theme", root.dataset.theme);
  } catch {
    // A browser that keeps nothing: the choice holds until the page is left.
  }
}
