// Lays the built page where the Python package looks for it.
import { copyFileSync } from "node:fs";

const root = new URL("./", import.meta.url);
copyFileSync(new URL("dist/index.html", root), new URL("../src/myograph/view/page/template.html", root));
