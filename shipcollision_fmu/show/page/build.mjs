// Bundles src/ into bundle/page.js and .css, the replay page, and live.js and .css, the live pages:
// `npm ci && npm run build`.
// What is bundled is under the MIT licence, which wants its text in every copy: it leads the bundle as a comment.
import { readFileSync } from "node:fs";
import { build } from "esbuild";

const read = (path) => readFileSync(new URL(path, import.meta.url), "utf8");
const notices = ["three", "uplot"].map((name) => {
  const { version } = JSON.parse(read(`node_modules/${name}/package.json`));
  return `${name} ${version}\n\n${read(`node_modules/${name}/LICENSE`).trim()}`;
});

await build({
  entryPoints: { page: "src/main.js", live: "src/live/main.js" },
  outdir: "bundle",
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  charset: "utf8",
  legalComments: "none",
  banner: { js: `/*\n${notices.join("\n\n----\n\n")}\n*/` },
  logLevel: "warning",
});
