/** The pages as tabs: one is shown, arrows go from one to the next. */
import { byId, element } from "./dom.js";

/**
 * @param {{name: string, label: string, mount: (root: HTMLElement) => (() => void) | void}[]} pages
 * Each fills its root once, and may return what is done whenever it is shown.
 * @param {string} first
 */
export function showTabs(pages, first) {
  const list = byId("tabs");
  const made = pages.map(({ name, label, mount }) => {
    const tab = element("button", { role: "tab", id: `tab-${name}`, "aria-controls": `page-${name}`, type: "button" }, label);
    const root = element("div", { role: "tabpanel", id: `page-${name}`, "aria-labelledby": `tab-${name}`, hidden: true });
    list.append(tab);
    byId("pages").append(root);
    return { name, tab, root, shown: mount(root) };
  });

  /** @param {string} name */
  function choose(name) {
    const wanted = made.some((page) => page.name === name) ? name : first;
    for (const { name: own, tab, root, shown } of made) {
      const chosen = own === wanted;
      tab.setAttribute("aria-selected", String(chosen));
      tab.tabIndex = chosen ? 0 : -1;
      root.hidden = !chosen;
      if (chosen && shown) shown();
    }
    if (location.hash.slice(1) !== wanted) history.replaceState(null, "", `#${wanted}`);
  }

  made.forEach(({ name, tab }, place) => {
    tab.addEventListener("click", () => choose(name));
    tab.addEventListener("keydown", (event) => {
      const steps = { ArrowRight: place + 1, ArrowLeft: place - 1 + made.length, Home: 0, End: made.length - 1 };
      const to = steps[/** @type {keyof typeof steps} */ (event.key)];
      if (to === undefined) return;
      event.preventDefault();
      const next = made[to % made.length];
      choose(next.name);
      next.tab.focus();
    });
  });
  addEventListener("hashchange", () => choose(location.hash.slice(1)));
  choose(location.hash.slice(1) || first);
}
