// Names of files and models as people write them. The table, the curves and the files keep them as they are.

/** A title from a scenario's name: "t_bone_90" is T-bone 90, "kvlcc2_crossing" KVLCC2 crossing, "guan2014" Guan 2014. */
export function readTitle(name) {
  if (!/^[a-z0-9]+(_[a-z0-9]+)*$/.test(name)) return name; // somebody has written it for people
  const words = name.replace(/(^|_)([a-z])_(?=[a-z])/g, "$1$2-").split("_").map((word) => {
    if (/^[a-z]{2,}(19|20)\d\d$/.test(word)) return `${word[0].toUpperCase()}${word.slice(1, -4)} ${word.slice(-4)}`;
    return /^[a-z]+\d+$/.test(word) ? word.toUpperCase() : word;
  });
  return words.join(" ").replace(/^./, (first) => first.toUpperCase());
}

/** What a ship is, from its model's name and its kind, without saying one word twice: "Ferry" and "ferry" are a Ferry. */
export function readKind(model, kind) {
  const [a, b] = [model, kind].map((text) => text.trim().toLowerCase());
  if (!a || !b) return capital(model || kind);
  if (a.includes(b)) return capital(model);
  if (b.split(/\W+/).some((word) => word.length > 3 && word.slice(0, 4) === a.slice(0, 4))) return capital(kind); // Bulker, bulk carrier
  return `${capital(model)}, ${kind}`;
}

const capital = (text) => text.replace(/^./, (first) => first.toUpperCase());
