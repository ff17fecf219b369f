// Prints the Khronos validator's report on the .glb files named: [{"errors": 0, "warnings": 0, "messages": [...]}, ...].
const { readFileSync } = require("node:fs");
const { validateBytes } = require("gltf-validator");

Promise.all(process.argv.slice(2).map((name) => validateBytes(new Uint8Array(readFileSync(name))))).then((reports) => {
  const issues = reports.map(({ issues }) => ({
    errors: issues.numErrors,
    warnings: issues.numWarnings,
    infos: issues.numInfos,
    messages: issues.messages,
  }));
  console.log(JSON.stringify(issues));
});
