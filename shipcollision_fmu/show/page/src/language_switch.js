// The list of languages.
import { element } from "./dom.js";
import { inWords, language, LANGUAGES, onLanguage, setLanguage } from "./texts.js";

/** A list that chooses the language, each in its own. */
export function makeLanguageSwitch() {
  const options = Object.entries(LANGUAGES).map(([value, text]) => element("option", { value, text, lang: value }));
  const chosen = inWords(element("select", { id: "language", onchange: () => setLanguage(chosen.value) }, ...options), { "aria-label": "language", title: "language" });
  onLanguage(() => (chosen.value = language()));
  return chosen;
}
