// Bundles the page into the files that the command embeds. With --check it compares instead of writing.
import { build } from "esbuild";
import { gzipSync } from "node:zlib";
import { readFileSync, writeFileSync } from "node:fs";

const OUT = new URL("../cli/assets/", import.meta.url);
const MOST_BYTES = 250_000;
const LIBRARIES = ["@dagrejs/dagre", "@dagrejs/graphlib", "preact", "three"];

const common = { bundle: true, minify: true, write: false, legalComments: "none", logLevel: "warning", charset: "ascii" };
const script = await build({
  ...common,
  entryPoints: ["src/main.jsx"],
  format: "iife",
  target: "es2022",
  jsx: "automatic",
  jsxImportSource: "preact",
});
const style = await build({ ...common, entryPoints: ["src/view.css"] });
const licenses = LIBRARIES.map((name) => {
  const folder = new URL(`node_modules/${name}/`, import.meta.url);
  const { version } = JSON.parse(readFileSync(new URL("package.json", folder), "utf8"));
  return `${name} ${version}\n\n${readFileSync(new URL("LICENSE", folder), "utf8").trim()}\n`;
});
const files = {
  "view.js": script.outputFiles[0].text,
  "view.css": style.outputFiles[0].text,
  "view.licenses.txt": licenses.join("\n\n"),
};

const size = gzipSync(files["view.js"], { level: 9 }).length + gzipSync(files["view.css"], { level: 9 }).length;
console.log(`${size} bytes compressed`);
if (size > MOST_BYTES) {
  console.error(`the bundle may have ${MOST_BYTES} bytes`);
  process.exit(1);
}
for (const [name, text] of Object.entries(files)) {
  const path = new URL(name, OUT);
  if (!process.argv.includes("--check")) {
    writeFileSync(path, text);
  } else if (readFileSync(path, "utf8") !== text) {
    console.error(`cli/assets/${name} is not what the sources give: run \`npm run build\` in view/`);
    process.exit(1);
  }
}
