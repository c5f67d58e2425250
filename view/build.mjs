// Bundles the page into the files that the command embeds. With --check it compares instead of writing. With --playground FOLDER it
// writes the page of the playground beside the module in that folder.
import { build } from "esbuild";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { copyFileSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const OUT = new URL("../cli/assets/", import.meta.url);
const ROOT = fileURLToPath(new URL("../", import.meta.url));
const MOST_BYTES = 250_000;
/** Most bytes of the playground as a server compresses it. */
const MOST_PLAYGROUND_BYTES = 1_800_000;
const LIBRARIES = ["@dagrejs/dagre", "@dagrejs/graphlib", "preact", "three"];

const common = { absWorkingDir: fileURLToPath(new URL(".", import.meta.url)), bundle: true, minify: true, write: false, legalComments: "none", logLevel: "warning", charset: "ascii" };
const bundle = async (entry) => {
  const built = await build({ ...common, entryPoints: [entry], format: "iife", target: "es2022", jsx: "automatic", jsxImportSource: "preact" });
  return built.outputFiles[0].text;
};
const style = (await build({ ...common, entryPoints: ["src/view.css"] })).outputFiles[0].text;
const licenses = LIBRARIES.map((name) => {
  const folder = new URL(`node_modules/${name}/`, import.meta.url);
  const { version } = JSON.parse(readFileSync(new URL("package.json", folder), "utf8"));
  return `${name} ${version}\n\n${readFileSync(new URL("LICENSE", folder), "utf8").trim()}\n`;
});
const licensed = licenses.join("\n\n");

const asked = process.argv.indexOf("--playground");
if (asked > 0) {
  await playground(process.argv[asked + 1]);
} else {
  const files = { "view.js": await bundle("src/main.jsx"), "view.css": style, "view.licenses.txt": licensed };
  within(MOST_BYTES, gzipSync(files["view.js"], { level: 9 }).length + gzipSync(style, { level: 9 }).length);
  for (const [name, text] of Object.entries(files)) {
    const path = new URL(name, OUT);
    if (!process.argv.includes("--check")) {
      writeFileSync(path, text);
    } else if (readFileSync(path, "utf8") !== text) {
      console.error(`cli/assets/${name} is not what the sources give: run \`npm run build\` in view/`);
      process.exit(1);
    }
  }
}

function within(most, size) {
  console.log(`${size} bytes compressed`);
  if (size > most) {
    console.error(`there may be ${most} bytes`);
    process.exit(1);
  }
}

/** Page of the playground: its policy admits its own files and the module, and nothing from elsewhere. */
async function playground(out) {
  const folder = join(ROOT, "examples");
  const examples = readdirSync(folder)
    .filter((name) => name.endsWith(".motet"))
    .map((name) => {
      const text = readFileSync(join(folder, name), "utf8");
      const [, robot, scene] = /Robot ([a-z0-9_]+), scene ([a-z0-9_]+)\./.exec(text);
      return { name: name.replace(".motet", ""), robot, scene, text };
    });
  // The first one is what a newcomer sees.
  examples.sort((a, b) => (b.name === "fetch_mug") - (a.name === "fetch_mug"));
  const policy =
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; connect-src 'self'; style-src 'self'; " +
    "img-src data:; base-uri 'none'; form-action 'none'";
  const html = readFileSync(new URL("view.html", OUT), "utf8")
    .replace("<!-- policy -->", `<meta http-equiv="Content-Security-Policy" content="${policy}">`)
    .replace("<!-- items -->", () => `<script type="application/json" id="examples">${JSON.stringify(examples).replaceAll("<", "\\u003c")}</script>`);
  const files = { "index.html": html, "view.js": await bundle("src/playground.jsx"), "view.css": style, "licenses.txt": licensed };
  for (const [name, text] of Object.entries(files)) writeFileSync(join(out, name), text);
  copyFileSync(new URL("src/worker.js", import.meta.url), join(out, "worker.js"));
  const packed = (bytes) => brotliCompressSync(bytes).length;
  const module = packed(readFileSync(join(out, "motet.wasm")));
  console.log(`the module has ${module} bytes compressed`);
  within(MOST_PLAYGROUND_BYTES, Object.values(files).reduce((sum, text) => sum + packed(text), module));
}
