// Reads a USD file with TinyUSDZ, for tools/check_exports: node check_usd.mjs FILE prints its first mesh as JSON, and
// node check_usd.mjs FILE all prints a list of its meshes.
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
const meshOf = number => {
    const mesh = file.getMesh(number);
    return {points: Array.from(mesh.points), faces: Array.from(mesh.faceVertexIndices),
            texcoords: Array.from(mesh.texcoords ?? [])};
};
const all = Array.from({length: file.numMeshes()}, (_, number) => meshOf(number));
console.log(JSON.stringify(process.argv[3] === "all" ? all : all[0]));
