// node single_page.mjs PAGE OUTPUT
// The page of the folder PAGE as one file: its modules as text, which a few lines give to the
// browser as blobs, since a page that is opened from a disk may not import files. A recorded world
// takes the place of the comment "recorded".
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join, normalize } from "node:path";
import { gzipSync } from "node:zlib";

const [page, output] = process.argv.slice(2);
const read = (path) => readFileSync(join(page, path), "utf8");
const index = read("index.html");
const BARE = "collision/";  // Before the path of a module of ours: what is relative has no base.
const { imports } = JSON.parse(/<script type="importmap">(.*?)<\/script>/s.exec(index)[1]);

const modules = {};

/** The name by which a module is known, whoever imports it. */
function nameOf(specifier, importer) {
  if (specifier.startsWith(".")) return BARE + normalize(join(dirname(importer), specifier));
  const [prefix, path] = Object.entries(imports).find(([name]) =>
    name === specifier || (name.endsWith("/") && specifier.startsWith(name))) ?? [];
  if (prefix === undefined) throw new Error(`${importer} imports ${specifier}`);
  return BARE + normalize(path + specifier.slice(prefix.length));
}

/** All that a page from a disk needs: what only reads dropped files is loaded when they come. */
function add(path) {
  if (BARE + path in modules) return;
  modules[BARE + path] = "";
  const wanted = [];
  modules[BARE + path] = read(path).replace(
    /(^\s*(?:import|export)\b(?:[^;"']*?\bfrom)?\s*)(["'])([^"'\n]+)\2/gm, (_, word, quote, specifier) => {
      const name = nameOf(specifier, path);
      wanted.push(name.slice(BARE.length));
      return `${word}${quote}${name}${quote}`;
    });
  wanted.forEach(add);
}
add("main.js");

const packed = gzipSync(JSON.stringify(modules), { level: 9 }).toString("base64");
const style = [...index.matchAll(/<link rel="stylesheet" href="([^"]+)">/g)]
  .map(([, path]) => read(path)).join("\n");
const loader = `
const bytes = Uint8Array.from(atob(document.getElementById("modules").textContent),
                              (c) => c.charCodeAt(0));
const plain = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
new Response(plain).json().then((modules) => {
  const imports = {};
  for (const [name, text] of Object.entries(modules)) {
    imports[name] = URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
  }
  const map = document.createElement("script");
  map.type = "importmap";
  map.textContent = JSON.stringify({ imports });
  document.head.append(map);
  return import("${BARE}main.js");
}).catch((error) => document.getElementById("verdict").textContent =
  "this browser cannot show the page: " + error.message);
`;
const policy = "default-src 'none'; script-src 'unsafe-inline' blob:; " +
  "style-src 'unsafe-inline'; img-src data: blob:";
const licences = readdirSync(join(page, "lib"), { recursive: true })
  .filter((path) => /LICENSE/.test(path)).filter((path) => /three|uPlot/.test(path))
  .map((path) => readFileSync(join(page, "lib", path), "utf8")).join("\n")
  .replaceAll("--", "- -");

const single = index
  .replace(/\s*<link rel="stylesheet"[^>]*>/g, "")
  .replace(/<script type="importmap">.*?<\/script>/s, () => `<style>${style}</style>`)
  .replace('<meta name="viewport"',
           (meta) => `<meta http-equiv="Content-Security-Policy" content="${policy}">\n  ${meta}`)
  .replace(/\s*<script type="module"[^>]*><\/script>/, "")
  .replace("</body>", () => `<script type="text/plain" id="modules">${packed}</script>
<!-- recorded -->
<script>${loader}</script>
<!--
${licences}
-->
</body>`);
writeFileSync(output, single);
