// Lays the built page where the Python package looks for it, and beside it what a page with a network needs besides:
// the worker as text, and onnxruntime's WebAssembly, packed.
import { copyFileSync, readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { buildSync } from "esbuild";

const root = new URL("./", import.meta.url);
const place = new URL("../src/myograph/view/page/", root);

const worker = buildSync({
  entryPoints: [fileURLToPath(new URL("src/network/worker.ts", root))],
  bundle: true, minify: true, write: false, format: "iife", target: "es2022", charset: "ascii",
  logOverride: { "empty-import-meta": "silent" },
}).outputFiles[0].text;
if (/<\/script|<!--/i.test(worker)) throw new Error("the worker's text would end its element");
const wasm = readFileSync(new URL("node_modules/onnxruntime-web/dist/ort-wasm-simd-threaded.wasm", root));
const packed = gzipSync(wasm, { level: 9 }).toString("base64");
const element = (id, text) => `<script type="text/plain" id="${id}">${text}</script>\n`;

copyFileSync(new URL("dist/index.html", root), new URL("template.html", place));
writeFileSync(new URL("runtime.html", place), element("myograph-worker", worker) + element("myograph-wasm", packed));
