// Reads the mesh of a USD file with TinyUSDZ, for tools/check_exports: node check_usd.mjs FILE prints it as JSON.
import fs from "node:fs";

const folder = process.env.DRAPE_NODE_MODULES + "/tinyusdz/", path = process.argv[2], node = process;
// The package is built for browsers and looks for one.
globalThis.window = globalThis;
globalThis.location = { href: "file:///" };
globalThis.document = { currentScript: null };
globalThis.process = undefined;
const { default: load } = await import(folder + "tinyusdz.js");
const library = await load({ wasmBinary: fs.readFileSync(folder + "tinyusdz.wasm") });
globalThis.process = node;

const file = new library.TinyUSDZLoaderNative();
if (!file.loadFromBinary(new Uint8Array(fs.readFileSync(path)), path)) throw new Error(file.error());
const mesh = file.getMesh(0);
console.log(JSON.stringify({
    points: Array.from(mesh.points), faces: Array.from(mesh.faceVertexIndices), texcoords: Array.from(mesh.texcoords),
}));
