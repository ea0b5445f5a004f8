// The worker of a page's network: one classic script with onnxruntime-web inside, without its WebAssembly.
import { defineConfig } from "vite";

export default defineConfig({
  build: {
    target: "es2022",
    outDir: "dist/worker",
    emptyOutDir: true,
    lib: { entry: "src/network/worker.ts", formats: ["iife"], name: "myographNetwork", fileName: () => "worker.js" },
  },
});
