/** Files that the browser keeps. */
import { element } from "./dom.js";

/**
 * Fetch what the server offers.
 * @param {{address: string, name: string}} offered
 */
export function save({ address, name }) {
  const link = element("a", { href: address, download: name, hidden: true });
  document.body.append(link);
  link.click();
  link.remove();
}
